// Construction of the lines of cells of layer_gradients.h.

#include "solver/momentum/bending/layer_gradients.h"

#include "solver/momentum/bending/line_walk.h"
#include "solver/momentum/bending/line_weights.h"
#include "solver/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pfdm {

class LayerGradients::Maker {
  using FacePair = std::array<Index, 2>;

 public:
  Maker(const Mesh& mesh, const Unknowns& unknowns, const std::vector<CubicFaces::Side>& sides,
        const std::vector<momentum_faces::Link>& links, OwnSides own, LayerGradients& made)
      : mesh_(mesh),
        unknowns_(unknowns),
        walk_(mesh, unknowns),
        links_(links),
        has_all_sides_(own == OwnSides::surfaces_ends_and_interfaces),
        made_(made),
        sides_of_(sides_of_cells(mesh, sides)) {
    made.sound_weights_.assign(links.size(), Tensor::Identity());
    made.counting_ = CellField<double>(mesh.n_cells(), 1.0);
    made.is_covered_ = CellField<char>(mesh.n_cells(), 0);
    for (const momentum_faces::Link& link : links) made.cells_of_link_.push_back({link.P, link.N});
    made.is_weighed_.assign(links.size(), 0);
  }

  // All directions in which a cell lies in layers that bend. A side that is across in one of them and along in another
  // is across, whatever their order.
  void add(std::span<const BendingCell> all) {
    const Index cell = all.front().cell;
    made_.cells_.push_back({.cell = cell, .first_line = made_.lines_.size(), .end_line = 0});
    has_line_.clear();
    has_surface_.clear();
    for (const BendingCell& in : all) {
      add_line(cell, in.across);
      add_line(cell, in.along);
    }
    made_.cells_.back().end_line = made_.lines_.size();
    made_.is_covered_[cell] = made_.cells_.back().first_line < made_.lines_.size() ? 1 : 0;
    for (const BendingCell& in : all)
      for (const Index face : in.along)
        if (walk_.is_mirror(face)) add_mirror(cell, face);
    for (const BendingCell& in : all)
      for (const Index face : in.across) {
        if (walk_.is_free(face) || unknowns_.is_split(face)) add_surface(cell, face);
        if (has_all_sides_ && walk_.is_bonded(face)) add_bond(cell, face);
      }
    for (const BendingCell& in : all)
      for (const Index face : in.along) {
        if (const double part = part_of_end(all, face); has_all_sides_ && walk_.is_free(face) && part > 0.0)
          add_surface(cell, face, part);
        weigh_jump(in, face);
      }
  }

 private:
  std::optional<std::size_t> side_of(Index cell, Index face) const {
    for (const auto& [f, side] : sides_of_[cell])
      if (f == face) return side;
    return std::nullopt;
  }
  struct Place {
    std::size_t from, to;  // outwards from the first cell of the line
    double at;             // of the slope from that cell's centre, over its length
    double at_held;        // likewise of the components that are held at a face whose others are free, else `at`
    Index face;            // of these, else -1
  };
  // The slope at the face of a cell of the line: at the distance `x`, the face's distance from the cell's own centre
  // being `half`, over the length of the first one. Nothing where the face carries neither a cell beyond nor a node.
  // Where the layers are sheared (layer_curvature.h) the slope between two centres is that half-way between them.
  std::optional<Place> slope_at(Index cell, Index face, double x, double half) const {
    if (const LineWalk::Step next = walk_.beyond(cell, face); next.cell >= 0) {
      double at = x;
      if (walk_.is_sheared(cell, face)) {
        const double to_next = (mesh_.cell_centre[next.cell] - mesh_.face_centre[face]).norm();
        const double own = (mesh_.cell_centre[cell] - mesh_.face_centre[face]).norm();
        at += 0.5 * half * (to_next / own - 1.0);
      }
      return Place{as_size(cell), as_size(next.cell), at, at, -1};
    }
    const Index node = unknowns_.node_beside(mesh_, cell, face);
    if (node < 0) return std::nullopt;
    const double middle = x - half / 2.0, at = walk_.is_free(face) ? x : middle;
    return walk_.is_mirror(face) ? Place{as_size(cell), as_size(node), at, middle, face}
                                 : Place{as_size(cell), as_size(node), at, at, -1};
  }

  // Slopes through a cell, those towards its first face at negative places, all along the line; empty where its own
  // faces have none.
  std::vector<Place> places_through(Index cell, const FacePair& faces) const {
    const double unit = walk_.length(faces[0], faces[1]);
    std::vector<Place> places;
    for (const Index face : faces) {
      const auto add = [&](Place place) {
        if (face == faces[0]) place = {place.to, place.from, -place.at, -place.at_held, place.face};
        places.push_back(place);
      };
      const std::optional<Place> here = slope_at(cell, face, 0.5, 0.5);
      if (!here) return {};
      add(*here);
      const LineWalk::Step next = walk_.beyond(cell, face);
      if (next.cell < 0 || next.far < 0) continue;
      const double width = walk_.length(face, next.far) / unit;
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
    std::vector<LinePlace> at;
    at.reserve(places.size());
    for (const Place& in : places)
      at.push_back(
          {in.at, in.at_held, in.face < 0 ? Tensor::Zero() : Tensor(Tensor::Identity() - walk_.free_part(in.face))});
    const LineWeights weights = line_weights(at);
    const std::size_t first = made_.slopes_.size(), first_held = made_.held_.size();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Vector step = walk_.place(places[k].to) - walk_.place(places[k].from);
      made_.slopes_.push_back({places[k].from, places[k].to, step, weights.of_all[k] / step.norm()});
    }
    for (LineWeights::Change of : weights.of_held) {
      for (std::size_t k = 0; k < places.size(); ++k) of.change[k] /= made_.slopes_[first + k].step.norm();
      made_.held_.push_back(of);
    }
    const auto neighbour = [&](Index face) {
      const Index next = walk_.beyond(cell, face).cell;
      return next < 0 ? cell : next;
    };
    const Index before = neighbour(faces[0]), after = neighbour(faces[1]);
    const double distance = (mesh_.cell_centre[after] - mesh_.cell_centre[before]).norm();
    made_.lines_.push_back(
        {.along = dual_of(cell, faces),
         .first_slope = first,
         .end_slope = made_.slopes_.size(),
         .first_held = first_held,
         .end_held = made_.held_.size(),
         .before = before,
         .after = after,
         .spread = distance > 0.0 ? walk_.length(faces[0], faces[1]) / (std::sqrt(12.0) * distance) : 0.0});
  }

  // Takes the derivative along the line to the gradient, those along the faces being kept.
  Vector dual_of(Index cell, const FacePair& faces) const {
    const auto outwards = [&](Index f) -> Vector { return mesh_.outward_area(f, cell).normalized(); };
    const Vector line = (mesh_.face_centre[faces[1]] - mesh_.face_centre[faces[0]]).normalized();
    const Vector normal = (outwards(faces[1]) - outwards(faces[0])).normalized();
    return normal / normal.dot(line);
  }

  // The slope towards a bonded or held face changes from the middle of the half cell to it by `part` of their sum.
  struct HalfSlopes {
    std::vector<Slope> slopes;
    Tensor part = Tensor::Zero();
  };

  // `beside`: the cell from whose derivatives along the face, and the cell's own, those on it follow, by this part.
  // `across`: components whose derivative across the face follows from `towards`.
  void add_side(Index cell, Index face, Index beside, double part, const HalfSlopes& towards, const Tensor& across) {
    const auto side = side_of(cell, face);
    if (beside < 0 || !side || std::ranges::find(has_surface_, face) != has_surface_.end()) return;
    has_surface_.push_back(face);
    const Vector& centre = mesh_.cell_centre[cell];
    const Vector to_face = mesh_.face_centre[face] - centre;
    const auto ratio_of = [&](Index other) {
      const Vector to_other = mesh_.cell_centre[other] - centre;
      return std::copysign(part * to_face.norm() / to_other.norm(), -to_face.dot(to_other));
    };
    const Index behind = walk_.cell_behind(cell, face);
    const std::size_t first = made_.slopes_.size();
    made_.slopes_.insert(made_.slopes_.end(), towards.slopes.begin(), towards.slopes.end());
    made_.surfaces_.push_back({.cell = cell,
                               .next = beside,
                               .ratio = ratio_of(beside),
                               .behind = behind,
                               .behind_ratio = behind < 0 ? 0.0 : ratio_of(behind),
                               .n = mesh_.face_area[face].normalized(),
                               .side = *side,
                               .first_slope = first,
                               .end_slope = made_.slopes_.size(),
                               .of_slopes = towards.part,
                               .across = across,
                               .along = to_face.normalized()});
  }

  void add_surface(Index cell, Index face, double part = 1.0) {
    add_side(cell, face, walk_.cell_behind(cell, face), part, {}, Tensor::Zero());
  }

  // The components that are held at the end of a line have a slope across it.
  void add_mirror(Index cell, Index face) {
    add_side(cell, face, walk_.cell_behind(cell, face), 1.0, half_slopes(cell, face),
             Tensor::Identity() - walk_.free_part(face));
  }

  // At the free end of a line, by the thinnest of the layers that it ends: cells 1.5 times as long as these are thick
  // would make a cantilever 2 % softer.
  double part_of_end(std::span<const BendingCell> all, Index face) const {
    double part = 1.0;
    for (const BendingCell& in : all)
      if (std::ranges::count(in.along, face) > 0)
        part = std::min(part, 3.0 - 2.0 * walk_.length(in.along[0], in.along[1]) / in.thickness);
    return part;
  }

  // Derivatives along it are those between both centres, but of much stiffer and much softer cells those of either side
  // by itself: their slopes in the soft one have a kink at the interface where shear builds up.
  void add_bond(Index cell, Index face) {
    constexpr double most_alike = 3.0;
    const Index other = mesh_.across(face, cell), next = walk_.cell_behind(cell, face);
    const Index of = next < 0 || walk_.are_alike(cell, other, most_alike) ? other : next;
    add_side(cell, face, of, 1.0, half_slopes(cell, face), Tensor::Identity());
  }

  // Slopes towards a face and inwards. The inward one is half-way to a node, but at the node if a component is free.
  HalfSlopes half_slopes(Index cell, Index face) const {
    const Index opposite = opposite_face(mesh_, cell, face), next = walk_.beyond(cell, opposite).cell;
    const Index inwards = next >= 0 ? next : unknowns_.node_beside(mesh_, cell, opposite);
    if (inwards < 0) return {};
    const Vector& centre = mesh_.cell_centre[cell];
    const Vector near = mesh_.face_centre[face] - centre, far = walk_.place(inwards) - centre;
    const double at_near = near.norm() / 2.0, half_way = far.norm() / 2.0;
    const double part = at_near / (at_near + half_way), part_of_free = at_near / (at_near + far.norm());
    const std::size_t at = cell, node = as_size(unknowns_.node_beside(mesh_, cell, face));
    return {.slopes = {{.from = at, .to = node, .step = near, .weight_over_length = 1.0 / near.norm()},
                       {.from = at, .to = as_size(inwards), .step = far, .weight_over_length = 1.0 / far.norm()}},
            .part = part * Tensor::Identity() + (part_of_free - part) * walk_.free_part(opposite)};
  }

  // 1/(1 - nu), or less where the shear stiffness is larger [-].
  double bending_over_shear(Index cell, const Vector& along, const Vector& across) const {
    const double isotropic = 1.0 / (1.0 - unknowns_.sound[unknowns_.zone[cell]].poisson_ratio());
    const MandelMatrix* C = unknowns_.stiffness_of(mesh_, cell);
    if (C == nullptr) return isotropic;
    const DirectedStrip strip(*C, along, across);
    return std::min(isotropic, 0.5 * strip.modulus / strip.shear_stiffness);
  }

  // Each cell of the face by half.
  void weigh_jump(const BendingCell& in, Index face) {
    constexpr double left = 0.04;
    const auto side = side_of(in.cell, face);
    if (!side || *side >= 2 * links_.size()) return;
    const momentum_faces::Link& link = links_[*side / 2];
    const double distance = (link.d_P - link.d_N).dot(link.n);
    const double layer = walk_.length(in.across[0], in.across[1]), all = in.zone_thickness;
    const Vector line = mesh_.face_centre[in.across[1]] - mesh_.face_centre[in.across[0]];
    const double by_shear = left * bending_over_shear(in.cell, link.n, line.normalized());
    const double weight = std::min(1.0, by_shear * layer * all / (distance * distance));
    const Vector within = (line - line.dot(link.n) * link.n).normalized();
    made_.sound_weights_[*side / 2] -= 0.5 * (1.0 - weight) * within * within.transpose();
    made_.is_weighed_[*side / 2] = 1;
  }

  const Mesh& mesh_;
  const Unknowns& unknowns_;
  LineWalk walk_;
  const std::vector<momentum_faces::Link>& links_;
  bool has_all_sides_;
  LayerGradients& made_;
  SidesOfCells sides_of_;
  std::vector<Index> has_line_, has_surface_;  // faces of the last cell
};

LayerGradients::LayerGradients(const Mesh& mesh, const Unknowns& unknowns, const std::vector<CubicFaces::Side>& sides,
                               const std::vector<momentum_faces::Link>& links, const std::vector<BendingCell>& cells,
                               OwnSides own)
    : counts_(!cells.empty()) {
  if (cells.empty()) return;
  Maker maker(mesh, unknowns, sides, links, own, *this);
  over_cells(cells, [&](std::span<const BendingCell> of_one) { maker.add(of_one); });
  weights_ = sound_weights_;
  if (unknowns.stiffness) curvature_ = LayerCurvature(mesh, unknowns, sides, cells, surface_sides());
}

}  // namespace pfdm
