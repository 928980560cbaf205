#include "solver/momentum/faces/polyhedral_jump.h"

#include "physics/elasticity/plane_stress.h"
#include "solver/parallel.h"

#include <algorithm>

namespace pfdm {
namespace {

constexpr double moderate_lambda = 1.5;  // lambda_s / mu of undamaged polyhedra, at most

// Tangential stiffness of the faces between polyhedra with closed cracks, over c along the normal. Measured on
// glass_bead_quick: with 0.01 some solves still do not converge, from 0.025 to 0.3 all do and the forces agree. Cells
// beside tetrahedra have none, which takes fewer staggered iterations.
constexpr double slip_share = 0.05;
// The same with a pressure, which hardly resists there. With 0.05 the quick bead at nu = 0.4995 stops at its second
// debonding; at 0.49 that is at 543 um with 0.05, 518 um with this.
constexpr double slip_share_with_pressure = 0.2;

}  // namespace

CellField<double> jump_shares(const Mesh& mesh, const Unknowns& unknowns) {
  CellField<double> share(mesh.n_cells(), 1.0);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const IsotropicElasticity& sound = unknowns.sound[unknowns.zone[c]];
    const IsotropicElasticity seen = unknowns.plane_stress ? plane_stress(sound) : sound;
    if (mesh.shape[c] == CellShape::polyhedron)
      share[c] = std::min(1.0, (moderate_lambda + 2.0) * seen.mu / seen.constrained_modulus());
  }
  for (const Index c : unknowns.pressure_cells) share[c] = 1.0;
  return share;
}

PolyhedralJump::PolyhedralJump(const FaceSkeleton& skeleton, const CellField<double>& shares)
    : skeleton_(skeleton),
      share_(shares),
      greatest_slip_(skeleton.mesh.n_cells(), 0.0),
      liquidity_(skeleton.mesh.n_cells(), 0.0),
      slip_(skeleton.mesh.n_cells(), 0.0) {
  for (Index c = 0; c < skeleton.mesh.n_cells(); ++c)
    if (skeleton.mesh.shape[c] == CellShape::polyhedron) greatest_slip_[c] = slip_share;
  for (const Index c : skeleton.unknowns.pressure_cells) greatest_slip_[c] = slip_share_with_pressure;
}

// From 0 in undamaged polyhedra and open cracks to 1 in closed cracks, which keep only the bulk modulus.
void PolyhedralJump::renew(const CellField<IsotropicElasticity>& moduli,
                           const CellField<IsotropicElasticity>& undamaged) {
  const Unknowns& unknowns = skeleton_.unknowns;
  const auto sound_of = [&](Index c) { return undamaged.size() > 0 ? undamaged[c] : unknowns.sound[unknowns.zone[c]]; };
  parallel_for(skeleton_.mesh.n_cells(), [&](Index c) {
    if (greatest_slip_[c] == 0.0) return;
    const IsotropicElasticity sound = sound_of(c);
    const double stiffer = moduli[c].bulk_modulus() * sound.mu / (sound.bulk_modulus() * moduli[c].mu);
    liquidity_[c] = std::max(0.0, 1.0 - 1.0 / stiffer);
    slip_[c] = greatest_slip_[c] * liquidity_[c];
  });
  for (std::size_t k = 0; k < unknowns.pressure_cells.size(); ++k) {
    const Index c = unknowns.pressure_cells[k];
    slip_[c] *= unknowns.pressure_laws[k].elasticity.mu / sound_of(c).mu;
  }
}

double PolyhedralJump::along_normal(Index P, Index N, const CellField<IsotropicElasticity>& moduli, double h_P,
                                    double h_N, double full) const {
  const Mesh& mesh = skeleton_.mesh;
  if (mesh.shape[P] != CellShape::polyhedron && mesh.shape[N] != CellShape::polyhedron) return full;
  const double mu_P = moduli[P].mu, mu_N = moduli[N].mu;
  const double theta = 1.0 - std::min(mu_P, mu_N) / std::max(mu_P, mu_N);
  const double small = 1.0 / (h_P / modulus(P, moduli[P]) + h_N / modulus(N, moduli[N]));
  return small + theta * (full - small);
}

double PolyhedralJump::along_face(Index P, Index N, double c_n, double c_t) const {
  return c_t + std::min(slip_[P], slip_[N]) * c_n;
}

// In bending, the shear strain on the faces across a plate and on those along it must agree. With the jump part alpha
// of the former they differ by alpha h_n^2/4 times the second derivative of the slope, h_n being the distance of the
// cells' centres across the face: the shear stiffness times that is added to the bending stiffness, 1.5 (1 - nu) alpha
// (h_n/h)^2 of it in a plate of thickness h. Layers of thickness t, on the other hand, leave out the bending within
// each of them and weight the free surface's gradient by two thirds instead of half: -(3 - 2 t/h) (t/h)^2. Both cancel
// for the alpha below, at any thickness of the plate. Cells that are not flat have alpha = 1.
double PolyhedralJump::bending_part(const momentum_faces::Link& link) const {
  constexpr double both = 1.8;  // 2 (1 - 2 t/(3 h)) with six to eight layers
  const Mesh& mesh = skeleton_.mesh;
  const auto thickness = [&](Index cell) {
    double largest = 0.0;
    for (const Index f : mesh.faces_of_cell(cell)) largest = std::max(largest, mesh.face_area[f].norm());
    return mesh.cell_volume[cell] / largest;
  };
  const double across = (link.d_P - link.d_N).dot(link.n);
  const double flatness = std::min(thickness(link.P), thickness(link.N)) / across;
  const Unknowns& unknowns = skeleton_.unknowns;
  const IsotropicElasticity& sound = unknowns.sound[unknowns.zone[link.P]];
  return std::min(1.0, both / (1.0 - sound.poisson_ratio()) * flatness * flatness);
}

}  // namespace pfdm
