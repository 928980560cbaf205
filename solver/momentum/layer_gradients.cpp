#include "solver/momentum/layer_gradients.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

// Weights of values at `n` places in the mean over [-1/2, 1/2] of the polynomial through them (Lagrange; Gauss's rule
// of two points is exact for cubics).
std::array<double, 4> mean_weights(const std::array<double, 4>& places, std::size_t n) {
  const double gauss = 0.5 / std::sqrt(3.0);
  std::array<double, 4> weights{};
  for (const double x : {-gauss, gauss})
    for (std::size_t j = 0; j < n; ++j) {
      double product = 0.5;
      for (std::size_t m = 0; m < n; ++m)
        if (m != j) product *= (x - places[m]) / (places[j] - places[m]);
      weights[j] += product;
    }
  return weights;
}

using FacePair = std::array<Index, 2>;

}  // namespace

class LayerGradients::Maker {
 public:
  Maker(const Mesh& mesh, const Unknowns& unknowns, const std::vector<CubicFaces::Side>& sides,
        const std::vector<momentum_faces::Link>& links, LayerGradients& made)
      : mesh_(mesh), unknowns_(unknowns), links_(links), made_(made), sides_of_(as_size(mesh.n_cells())) {
    for (std::size_t k = 0; k < sides.size(); ++k) sides_of_[as_size(sides[k].cell)].emplace_back(sides[k].face, k);
    made.sound_weights_.assign(links.size(), Tensor::Identity());
    made.counting_ = CellField<double>(as_size(mesh.n_cells()), 1.0);
    made.is_covered_ = CellField<char>(as_size(mesh.n_cells()), 0);
    for (const momentum_faces::Link& link : links) made.cells_of_link_.push_back({link.P, link.N});
    made.is_weighed_.assign(links.size(), 0);
  }

  void add(const BendingCell& in) {
    if (made_.cells_.empty() || made_.cells_.back().cell != in.cell) {
      made_.cells_.push_back({.cell = in.cell, .first_line = made_.lines_.size(), .end_line = 0});
      made_.is_covered_[in.cell] = 1;
      has_line_.clear();
      has_surface_.clear();
    }
    add_line(in.cell, in.across);
    add_line(in.cell, in.along);
    made_.cells_.back().end_line = made_.lines_.size();
    for (const Index face : in.across)
      if (is_free(face) || is_split(face)) add_surface(in.cell, face);
    for (const Index face : in.along) {
      if (is_mirror(face)) add_surface(in.cell, face);
      weigh_jump(in, face);
    }
  }

 private:
  // A cell beyond a face in its line, and that cell's far face; no cell where the face carries a node.
  struct Step {
    Index cell = -1, far = -1;
  };
  Step beyond(Index cell, Index face) const {
    if (!mesh_.is_interior(face) || unknowns_.node_beside(mesh_, cell, face) >= 0) return {};
    const Index other = mesh_.across(face, cell);
    return {.cell = other, .far = opposite_face(mesh_, other, face)};
  }
  double length(Index f, Index g) const { return (mesh_.face_centre[g] - mesh_.face_centre[f]).norm(); }
  Vector place(std::size_t unknown) const { return unknowns_.place(mesh_, static_cast<Index>(unknown)); }
  std::optional<std::size_t> side_of(Index cell, Index face) const {
    for (const auto& [f, side] : sides_of_[as_size(cell)])
      if (f == face) return side;
    return std::nullopt;
  }
  // On the surface of the body: components whose traction is prescribed, in plane meshes of those within the plane.
  Tensor free_part(Index face) const {
    const Index node = unknowns_.node_of_face[face];
    if (mesh_.is_interior(face) || node < 0) return Tensor::Zero();
    return unknowns_.free_within(node);
  }
  bool is_free(Index face) const { return !free_part(face).isZero(); }
  bool is_split(Index face) const { return unknowns_.neighbour_node.size() > 0 && unknowns_.neighbour_node[face] >= 0; }
  bool is_mirror(Index face) const {
    const Vector& across = unknowns_.plane_normal;
    return is_free(face) && !(free_part(face) + across * across.transpose()).isIdentity();
  }

  struct Place {
    std::size_t from, to;  // outwards from the first cell of the line
    double at;             // of the slope from that cell's centre, over its length
  };
  // The slope at the face of a cell of the line: at the distance `x`, the face's distance from the cell's own centre
  // being `half`, over the length of the first one. Nothing where the face carries neither a cell beyond nor a node.
  std::optional<Place> slope_at(Index cell, Index face, double x, double half) const {
    if (const Step next = beyond(cell, face); next.cell >= 0) return Place{as_size(cell), as_size(next.cell), x};
    const Index node = unknowns_.node_beside(mesh_, cell, face);
    if (node < 0) return std::nullopt;
    return Place{as_size(cell), as_size(node), is_free(face) ? x : x - half / 2.0};
  }

  // Slopes through a cell, those towards its first face at negative places, all along the line; empty where its own
  // faces have none.
  std::vector<Place> places_through(Index cell, const FacePair& faces) const {
    const double unit = length(faces[0], faces[1]);
    std::vector<Place> places;
    for (const Index face : faces) {
      const auto add = [&](Place place) {
        if (face == faces[0]) place = {place.to, place.from, -place.at};
        places.push_back(place);
      };
      const std::optional<Place> here = slope_at(cell, face, 0.5, 0.5);
      if (!here) return {};
      add(*here);
      const Step next = beyond(cell, face);
      if (next.cell < 0 || next.far < 0) continue;
      const double width = length(face, next.far) / unit;
      if (const auto there = slope_at(next.cell, next.far, 0.5 + width, width / 2.0)) add(*there);
    }
    return places;
  }

  // Once for each pair of faces, though a plate is long in two directions.
  void add_line(Index cell, const FacePair& faces) {
    if (std::ranges::find(has_line_, faces[0]) != has_line_.end()) return;
    has_line_.push_back(faces[0]);
    const std::vector<Place> places = places_through(cell, faces);
    if (places.empty()) return;
    std::array<double, 4> at{};
    for (std::size_t k = 0; k < places.size(); ++k) at[k] = places[k].at;
    const std::array<double, 4> weights = mean_weights(at, places.size());
    const std::size_t first = made_.slopes_.size();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Vector step = place(places[k].to) - place(places[k].from);
      made_.slopes_.push_back({places[k].from, places[k].to, step, weights[k] / step.norm()});
    }
    const auto neighbour = [&](Index face) {
      const Index next = beyond(cell, face).cell;
      return next < 0 ? cell : next;
    };
    const Index before = neighbour(faces[0]), after = neighbour(faces[1]);
    const double distance = (mesh_.cell_centre[after] - mesh_.cell_centre[before]).norm();
    made_.lines_.push_back(
        {.along = dual_of(cell, faces),
         .first_slope = first,
         .end_slope = made_.slopes_.size(),
         .before = before,
         .after = after,
         .spread = distance > 0.0 ? length(faces[0], faces[1]) / (std::sqrt(12.0) * distance) : 0.0});
  }

  // Takes the derivative along the line to the gradient, those along the faces being kept.
  Vector dual_of(Index cell, const FacePair& faces) const {
    const auto outwards = [&](Index f) -> Vector {
      return (mesh_.owner[f] == cell ? 1.0 : -1.0) * mesh_.face_area[f].normalized();
    };
    const Vector line = (mesh_.face_centre[faces[1]] - mesh_.face_centre[faces[0]]).normalized();
    const Vector normal = (outwards(faces[1]) - outwards(faces[0])).normalized();
    return normal / normal.dot(line);
  }

  void add_surface(Index cell, Index face) {
    const Step next = beyond(cell, opposite_face(mesh_, cell, face));
    const auto side = side_of(cell, face);
    if (next.cell < 0 || !side || std::ranges::find(has_surface_, face) != has_surface_.end()) return;
    has_surface_.push_back(face);
    const Vector& centre = mesh_.cell_centre[cell];
    made_.surfaces_.push_back(
        {.cell = cell,
         .next = next.cell,
         .ratio = (mesh_.face_centre[face] - centre).norm() / (mesh_.cell_centre[next.cell] - centre).norm(),
         .n = mesh_.face_area[face].normalized(),
         .side = *side});
  }

  // Of all cells of the line [m].
  double length_through(Index cell, const FacePair& faces) const {
    double sum = length(faces[0], faces[1]);
    for (Index face : faces)
      for (Step next = beyond(cell, face); next.cell >= 0 && next.far >= 0; next = beyond(next.cell, face)) {
        sum += length(face, next.far);
        face = next.far;
      }
    return sum;
  }

  // Each cell of the face by half.
  void weigh_jump(const BendingCell& in, Index face) {
    constexpr double left = 0.04;
    const auto side = side_of(in.cell, face);
    if (!side || *side >= 2 * links_.size()) return;
    const momentum_faces::Link& link = links_[*side / 2];
    const double distance = (link.d_P - link.d_N).dot(link.n);
    const double layer = length(in.across[0], in.across[1]), all = length_through(in.cell, in.across);
    const double nu = unknowns_.sound[as_size(unknowns_.zone[in.cell])].poisson_ratio();
    const double weight = std::min(1.0, left / (1.0 - nu) * layer * all / (distance * distance));
    const Vector line = mesh_.face_centre[in.across[1]] - mesh_.face_centre[in.across[0]];
    const Vector within = (line - line.dot(link.n) * link.n).normalized();
    made_.sound_weights_[*side / 2] -= 0.5 * (1.0 - weight) * within * within.transpose();
    made_.is_weighed_[*side / 2] = 1;
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  const std::vector<momentum_faces::Link>& links_;
  LayerGradients& made_;
  std::vector<std::vector<std::pair<Index, std::size_t>>> sides_of_;
  std::vector<Index> has_line_, has_surface_;  // faces of the last cell
};

LayerGradients::LayerGradients(const Mesh& mesh, const Unknowns& unknowns, const std::vector<CubicFaces::Side>& sides,
                               const std::vector<momentum_faces::Link>& links, const std::vector<BendingCell>& cells)
    : counts_(!cells.empty()) {
  if (cells.empty()) return;
  Maker maker(mesh, unknowns, sides, links, *this);
  for (const BendingCell& in : cells) maker.add(in);
  weights_ = sound_weights_;
}

// The least stiffness factor over the greatest one on the lines of a cell.
double LayerGradients::least_factor_ratio(const Cell& in, const CellField<double>& g) const {
  double least = g[in.cell], most = least;
  for (std::size_t k = lines_[in.first_line].first_slope; k < lines_[in.end_line - 1].end_slope; ++k)
    for (const std::size_t at : {slopes_[k].from, slopes_[k].to})
      if (at < as_size(g.size())) {
        least = std::min(least, g[static_cast<Index>(at)]);
        most = std::max(most, g[static_cast<Index>(at)]);
      }
  return least / most;
}

void LayerGradients::weigh(const CellField<double>& g) {
  constexpr double steepness = 4.0;
  counts_ = !cells_.empty();
  parallel_for(static_cast<Index>(cells_.size()), [&](Index i) {
    Cell& in = cells_[as_size(i)];
    if (in.first_line == in.end_line) return;
    in.weight = std::max(0.0, 1.0 - steepness * (1.0 - least_factor_ratio(in, g)));
    counting_[in.cell] = in.weight;
  });
  parallel_for(static_cast<Index>(weights_.size()), [&](Index i) {
    const auto& [P, N] = cells_of_link_[as_size(i)];
    if (is_weighed_[as_size(i)] == 0) return;
    const double counts = std::min(counting_[P], counting_[N]);
    weights_[as_size(i)] = counts * sound_weights_[as_size(i)] + (1.0 - counts) * Tensor::Identity();
  });
}

std::vector<std::size_t> LayerGradients::surface_sides() const {
  std::vector<std::size_t> sides;
  for (const Surface& at : surfaces_) sides.push_back(at.side);
  return sides;
}

void LayerGradients::correct(const std::vector<Vector>& u, CellField<Tensor>& gradients,
                             std::vector<Tensor>& changes) const {
  parallel_for(static_cast<Index>(cells_.size()), [&](Index i) {
    const Cell& in = cells_[as_size(i)];
    if (in.weight == 0.0) return;
    Tensor& G = gradients[in.cell];
    const Tensor of_one_ring = G;
    for (std::size_t l = in.first_line; l < in.end_line; ++l) {
      const Line& line = lines_[l];
      Vector change = Vector::Zero();
      for (std::size_t k = line.first_slope; k < line.end_slope; ++k)
        change +=
            slopes_[k].weight_over_length * (u[slopes_[k].to] - u[slopes_[k].from] - of_one_ring * slopes_[k].step);
      G += in.weight * change * line.along.transpose();
    }
  });
  parallel_for(static_cast<Index>(surfaces_.size()), [&](Index i) {
    const Surface& at = surfaces_[as_size(i)];
    const double counts = std::min(counting_[at.cell], counting_[at.next]);
    const Tensor more = counts * at.ratio * (gradients[at.cell] - gradients[at.next]);
    changes[at.side] = more - more * at.n * at.n.transpose();
  });
}

}  // namespace pfdm
