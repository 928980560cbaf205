#include "solver/momentum/bending/cubic_faces.h"

#include "solver/momentum/bending/bending_layers.h"
#include "solver/momentum/bending/cubic_fit.h"
#include "solver/momentum/bending/fit_surroundings.h"
#include "solver/momentum/bending/slender_layers.h"
#include "solver/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

using namespace cubic;

// A vector and a zero: as long as the vectors of the processor's units.
using Wide = Eigen::Vector4d;

// Points and weights of a rule for quadratics over a face: the middles of the
// edges of its triangles.
template <class Add>
void over_face(const Mesh& mesh, Index face, const Add& add) {
  const auto points = mesh.points_of_face(face);
  const Vector &centre = mesh.face_centre[face], n = mesh.face_area[face].normalized();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector& a = mesh.points[points[i]];
    const Vector& b = mesh.points[points[(i + 1) % points.size()]];
    const double third = (a - centre).cross(b - centre).dot(n) / 6.0;
    add((a + b) / 2.0, third);
    add((a + centre) / 2.0, third);
    add((b + centre) / 2.0, third);
  }
}

// Over the coefficients of a cell's monomials: mean slopes over a face along
// the cell's edges, value at its centre.
struct Functionals {
  std::array<Row, 3> slope{Row::Zero(), Row::Zero(), Row::Zero()};
  Row value;
};

Functionals functionals_of(const Mesh& mesh, const CubicFaces::Side& side, const Tensor& to_units) {
  const Vector& centre = mesh.cell_centre[side.cell];
  Functionals at_face;
  double area = 0.0;
  over_face(mesh, side.face, [&](const Vector& x, double weight) {
    for (int a = 0; a < 3; ++a) at_face.slope[a] += weight * derivative(to_units * (x - centre), a);
    area += weight;
  });
  for (Row& slope : at_face.slope) slope /= area;
  at_face.value = monomials(to_units * (mesh.face_centre[side.face] - centre));
  return at_face;
}

// The cell's edges, as vectors between the centres of opposite faces; across a
// plane mesh its normal; of a prism those of the box that it halves, `along` the body and across it. Empty where the
// cell is too distorted.
std::optional<Tensor> edges_of(const Mesh& mesh, Index cell, const Vector& plane_normal, const Vector& along) {
  if (mesh.shape[cell] == CellShape::wedge) {
    const Vector across = plane_normal.cross(along);
    Tensor edges;
    edges << 2.0 * mean_chord(mesh, cell, along) * along, 2.0 * mean_chord(mesh, cell, across) * across, plane_normal;
    return edges;
  }
  Tensor edges = Tensor::Zero();
  int n = 0;
  for (const Index f : mesh.faces_of_cell(cell)) {
    const Index g = opposite_face(mesh, cell, f);
    if (g < f) continue;
    const Vector edge = mesh.face_centre[g] - mesh.face_centre[f];
    const bool is_across = std::abs(edge.dot(plane_normal)) > 0.5 * edge.norm();
    if (n < 3) edges.col(n++) = is_across ? plane_normal : edge;
  }
  const Tensor directions = edges.colwise().normalized();
  if (n < 3 || std::abs(directions.determinant()) < 0.1) return std::nullopt;
  return edges;
}

// The axis of the cell's edges, 0 to 2, along which a vector in their units is
// longest.
std::size_t axis_of(const Vector& units) {
  Index axis = 0;
  units.cwiseAbs().maxCoeff(&axis);
  return as_size(axis);
}

// None across a plane mesh. Along an edge of the body no cubic in both
// directions away from its surfaces: there samples tell them badly, and rows of
// such cells would be unstable.
Wanted wanted_monomials(const Mesh& mesh, const Unknowns& unknowns, Index cell, const Tensor& to_units) {
  std::array<bool, 3> is_across{}, has_node{};
  if (!unknowns.plane_normal.isZero()) is_across[axis_of(to_units * unknowns.plane_normal)] = true;
  for (const Index f : mesh.faces_of_cell(cell))
    if (unknowns.node_of_face[f] >= 0)
      has_node[axis_of(to_units * (mesh.face_centre[f] - mesh.cell_centre[cell]))] = true;
  Wanted wanted{};
  for (int k = 0; k < n_monomials; ++k) {
    int n_surfaces = 0;
    bool is_within = true;
    for (std::size_t a = 0; a < 3; ++a) {
      if (powers[k][a] == 0) continue;
      n_surfaces += has_node[a] ? 1 : 0;
      is_within = is_within && !is_across[a];
    }
    wanted[k] = is_within && (degree(k) < 3 || n_surfaces < 2);
  }
  return wanted;
}

// The fit of a cell, its samples, and what takes distances to units of its
// edges.
struct LocalFit {
  std::vector<Index> samples;
  Tensor to_units;
  CubicFit fit;
};

// Coefficients of each sample in the mean gradient over a face and in the displacement at its centre.
template <class Coefficient>
void add_coefficients(const Functionals& at_face, const CubicFit& fit, const Tensor& to_units,
                      std::vector<Coefficient>& coefficients) {
  std::array<Eigen::RowVectorXd, 3> slope;
  for (std::size_t a = 0; a < 3; ++a) slope[a] = fit(at_face.slope[a]);
  const Eigen::RowVectorXd value = fit(at_face.value);
  for (Eigen::Index j = 0; j < value.size(); ++j)
    coefficients.push_back(
        {.gradient = to_units.transpose() * Vector(slope[0][j], slope[1][j], slope[2][j]), .value = value[j]});
}

// Empty where the cell is too distorted, or its samples do not tell linear
// fields.
std::optional<LocalFit> fit_of(const Mesh& mesh, const Unknowns& unknowns, Index cell, const Vector& along,
                               FitSurroundings& around) {
  const std::optional<Tensor> edges = edges_of(mesh, cell, unknowns.plane_normal, along);
  if (!edges) return std::nullopt;
  const Tensor to_units = edges->inverse();
  std::vector<Index> samples = around.of(cell);
  std::vector<Vector> places;
  places.reserve(samples.size());
  for (const Index s : samples) places.emplace_back(to_units * (unknowns.place(mesh, s) - mesh.cell_centre[cell]));
  const CubicFit fit(places, wanted_monomials(mesh, unknowns, cell, to_units));
  if (!fit.is_sound()) return std::nullopt;
  return LocalFit{.samples = std::move(samples), .to_units = to_units, .fit = fit};
}

}  // namespace

CubicFaces::CubicFaces(const Mesh& mesh, const Unknowns& unknowns, const std::vector<Side>& sides)
    : n_cells_(mesh.n_cells()) {
  if (unknowns.plane_normal.isZero() || unknowns.is_axisymmetric()) return;
  std::vector<char> bends = bending_cells(mesh, unknowns);
  const CellField<Vector> along = bending_prisms(mesh, unknowns);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (!along[c].isZero()) bends[c] = 1;
  if (std::none_of(bends.begin(), bends.end(), [](char b) { return b != 0; })) return;
  std::vector<std::vector<std::size_t>> of_cell(mesh.n_cells());
  for (std::size_t k = 0; k < sides.size(); ++k) of_cell[sides[k].cell].push_back(k);
  has_fit_ = CellField<char>(mesh.n_cells(), 0);
  FitSurroundings around(mesh, unknowns);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (bends[c] == 0) continue;
    if (const auto local = fit_of(mesh, unknowns, c, along[c], around)) {
      has_fit_[c] = 1;
      cells_.push_back({.cell = c,
                        .first_sample = samples_.size(),
                        .n_samples = local->samples.size(),
                        .first_side = side_numbers_.size(),
                        .n_sides = of_cell[c].size(),
                        .first_coefficient = coefficients_.size()});
      samples_.insert(samples_.end(), local->samples.begin(), local->samples.end());
      for (const std::size_t k : of_cell[c]) {
        side_numbers_.push_back(k);
        to_face_.emplace_back(mesh.face_centre[sides[k].face] - mesh.cell_centre[c]);
        add_coefficients(functionals_of(mesh, sides[k], local->to_units), local->fit, local->to_units, coefficients_);
      }
    }
  }
}

void CubicFaces::weigh(const CellField<double>& g) {
  constexpr double steepness = 4.0;
  parallel_for(count_of(cells_), [&](Index i) {
    Cell& fit = cells_[i];
    double least = g[fit.cell], most = least;
    for (std::size_t s = fit.first_sample; s < fit.first_sample + fit.n_samples; ++s) {
      if (samples_[s] >= n_cells_) continue;
      least = std::min(least, g[samples_[s]]);
      most = std::max(most, g[samples_[s]]);
    }
    fit.weight = std::max(0.0, 1.0 - steepness * (1.0 - least / most));
  });
}

void CubicFaces::read(const std::vector<Vector>& u, const CellField<Tensor>& gradients,
                      std::vector<Change>& changes) const {
  parallel_chunks(count_of(cells_), [&](Index begin, Index end) {
    std::vector<Wide> moved;  // samples against the cell
    for (Index i = begin; i < end; ++i) {
      const Cell& fit = cells_[i];
      const Vector& here = u[fit.cell];
      if (moved.size() < fit.n_samples) moved.resize(fit.n_samples, Wide::Zero());
      for (std::size_t s = 0; s < fit.n_samples; ++s) moved[s].head<3>() = u[samples_[fit.first_sample + s]] - here;
      const Tensor& G = gradients[fit.cell];
      const Coefficient* by = &coefficients_[fit.first_coefficient];
      for (std::size_t k = fit.first_side; k < fit.first_side + fit.n_sides; ++k, by += fit.n_samples) {
        Change& change = changes[side_numbers_[k]];
        change = {};
        if (fit.weight == 0.0) continue;
        Wide rise = Wide::Zero();
        std::array<Wide, 3> slope{rise, rise, rise};
        for (std::size_t s = 0; s < fit.n_samples; ++s) {
          for (int a = 0; a < 3; ++a) slope[a] += by[s].gradient[a] * moved[s];
          rise += by[s].value * moved[s];
        }
        for (int a = 0; a < 3; ++a) change.gradient.col(a) = slope[a].head<3>();
        change.gradient = fit.weight * (change.gradient - G);
        change.rise = fit.weight * (rise.head<3>() - G * to_face_[k]);
      }
    }
  });
}

}  // namespace pfdm
