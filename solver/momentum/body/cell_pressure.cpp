#include "solver/momentum/body/cell_pressure.h"

#include "mesh/geometry.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// Cells without a pressure are no samples of its gradient, also within a zone.
CellField<Index> pressed_zones(const Unknowns& unknowns) {
  CellField<Index> zone(unknowns.zone.size() > 0 ? as_size(unknowns.zone.size()) : 0, -1);
  for (const Index c : unknowns.pressure_cells) zone[c] = unknowns.zone[c];
  return zone;
}

std::vector<char> with_pressure(const Mesh& mesh, const Unknowns& unknowns) {
  std::vector<char> has(mesh.n_cells(), 0);
  for (const Index c : unknowns.pressure_cells) has[c] = 1;
  return has;
}

FaceField<char> split_faces(const Mesh& mesh, const Unknowns& unknowns) {
  if (unknowns.split_faces.empty()) return {};
  FaceField<char> cut(mesh.n_faces(), 0);
  for (const Index f : unknowns.split_faces) cut[f] = 1;
  return cut;
}

FaceField<Tensor> warps(const Mesh& mesh) {
  constexpr double negligible = 1e-12;
  FaceField<Tensor> warp(mesh.n_faces());
  bool any = false;
  for (Index f = 0; f < mesh.n_faces(); ++f) {
    warp[f] = face_warp(mesh, f);
    any = any || warp[f].norm() > negligible * std::pow(mesh.face_area[f].norm(), 1.5);
  }
  return any ? warp : FaceField<Tensor>{};
}

}  // namespace

CellPressure::CellPressure(const Mesh& mesh, const Unknowns& unknowns)
    : mesh_(mesh),
      unknowns_(unknowns),
      gradient_(mesh, {.zone = pressed_zones(unknowns),
                       .node_of_face = {},
                       .cut = split_faces(mesh, unknowns),
                       .plane_normal = unknowns.plane_normal,
                       .wanted = with_pressure(mesh, unknowns),
                       .zero_if_deficient = true}) {
  if (!any()) return;
  const std::size_t n = mesh.n_cells();
  modulus_ = ratio_ = CellField<double>(n, 0.0);
  for (std::size_t k = 0; k < unknowns.pressure_cells.size(); ++k) {
    const IsotropicElasticity& by = unknowns.pressure_laws[k].least();
    ratio_[unknowns.pressure_cells[k]] =
        std::min(moderate_lambda, (by.lambda - least_share * by.bulk_modulus()) / by.mu);
  }
  counts_ = CellField<double>(n, 1.0);
  warp_ = warps(mesh);
}

void CellPressure::take_over(CellField<IsotropicElasticity>& moduli, const CellField<double>& g,
                             const CellField<IsotropicElasticity>& sound, const CellField<char>& relaxes) {
  for (std::size_t k = 0; k < unknowns_.pressure_cells.size(); ++k) {
    const Index c = unknowns_.pressure_cells[k];
    const IsotropicElasticity& rested = unknowns_.pressure_laws[k].elasticity;
    double kept = ratio_[c] * rested.mu / rested.lambda * moduli[c].lambda;
    if (relaxes.size() > 0 && relaxes[c] != 0)
      kept = ratio_[c] * sound[c].mu * moduli[c].bulk_modulus() / sound[c].bulk_modulus();
    modulus_[c] = moduli[c].lambda - kept;
    moduli[c].lambda = kept;
  }
  weigh(g);
}

void CellPressure::bear_closed_cracks(CellField<IsotropicElasticity>& of_stress) {
  constexpr double rounding = 1e-9;
  for (const Index c : unknowns_.pressure_cells) {
    IsotropicElasticity& own = of_stress[c];
    const double open = ratio_[c] * own.mu;
    if (own.lambda <= (1.0 + rounding) * open) continue;
    modulus_[c] += own.lambda - open;
    own.lambda = open;
  }
}

void CellPressure::weigh(const CellField<double>& g) {
  for (const Index c : unknowns_.pressure_cells) counts_[c] = likeness(c, g);
}

// The least ratio of a neighbour's stiffness factor to the cell's own, or the other way round.
double CellPressure::likeness(Index cell, const CellField<double>& g) const {
  double least = 1.0;
  for (const Index f : mesh_.faces_of_cell(cell)) {
    if (!mesh_.is_interior(f)) continue;
    const Index other = mesh_.across(f, cell);
    if (unknowns_.zone[other] == unknowns_.zone[cell])
      least = std::min({least, g[other] / g[cell], g[cell] / g[other]});
  }
  return least;
}

PressureField CellPressure::field() const {
  const std::size_t n = any() ? as_size(mesh_.n_cells()) : 0;
  return {.q = CellField<double>(n, 0.0), .slope = CellField<Vector>(n, Vector::Zero())};
}

void CellPressure::read(const std::vector<Vector>& u, PressureField& pressures) const {
  const std::vector<Index>& cells = unknowns_.pressure_cells;
  const std::size_t first = unknowns_.n_nodes();
  parallel_for(count_of(cells), [&](Index k) { pressures.q[cells[k]] = u[first + k][0]; });
  parallel_for(count_of(cells), [&](Index k) {
    const Index c = cells[k];
    pressures.slope[c] = counts_[c] * gradient_.of(pressures.q.data(), c);
  });
}

}  // namespace pfdm
