#include "solver/fracture/damage/damage_equation.h"

#include "solver/fracture/model/symmetry_planes.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pfdm {
namespace {

CellField<char> damageable_cells(const Mesh& mesh, const FractureModel& model) {
  CellField<char> damageable(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) damageable[c] = model.in_cell(mesh, c).damageable ? 1 : 0;
  return damageable;
}

CellField<double> energy_density(const Mesh& mesh, const FractureModel& model) {
  CellField<double> density(mesh.n_cells(), 0.0);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (const RegionModel& region = model.in_cell(mesh, c); region.damageable)
      density[c] = region.surface_toughness() / (model.crack->c0 * region.ell);
  return density;
}

// The damage is zero at the faces of undamageable cells. Cohesive faces let no damage through, and set none.
TwoPointFlux::Medium medium_of(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal) {
  TwoPointFlux::Medium medium{.conductance = CellField<double>(mesh.n_cells(), 0.0),
                              .plane_normal = plane_normal,
                              .shift = damage_points(mesh, model),
                              .limited = true};
  if (!model.interfaces.empty()) medium.cut = FaceField<char>(mesh.n_faces(), 0);
  for (const CohesiveSurface& surface : model.interfaces)
    for (const Index f : surface.faces) medium.cut[f] = 1;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (const RegionModel& region = model.in_cell(mesh, c); region.damageable)
      medium.conductance[c] = 2.0 * region.surface_toughness() * region.ell / model.crack->c0;
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const bool within_P = model.in_cell(mesh, P).damageable, within_N = model.in_cell(mesh, N).damageable;
    if (within_P == within_N || (medium.cut.size() > 0 && medium.cut[f] != 0)) continue;
    medium.exchanges.push_back({.face = f,
                                .cell = within_P ? P : N,
                                .coefficient = std::numeric_limits<double>::infinity(),
                                .value = 0.0,
                                .corrected = false});
  }
  return medium;
}

}  // namespace

// The damage equation of one solve, as BoundedNewton asks for it.
template <class Driving>
struct DamageEquation::Term {
  const DamageEquation& equation;
  const Driving& psi_plus;  // by cell and d
  const CellField<double>& lower_bound;
  // Least curvature over that at a fixed psi. Where the energy is not convex in d, Newton's steps are shortened and
  // descend still.
  static constexpr double least_curvature = 0.2;

  bool is_free(Index c) const { return equation.is_damageable(c); }
  double slope(Index c, double d) const {
    return equation.local_slope(c, d, psi_plus(c, std::clamp(d, 0.0, 1.0)).value);
  }
  double curvature(Index c, double d) const {
    const double within = std::clamp(d, 0.0, 1.0);
    const DrivingAt psi = psi_plus(c, within);
    const double fixed = equation.local_curvature(c, within, psi.value);
    const double whole = fixed + equation.driving_curvature(c, within, psi.slope);
    return fixed > 0.0 ? std::max(whole, least_curvature * fixed) : whole;
  }
  double lower(Index c) const { return lower_bound[c]; }
  double upper(Index) const { return 1.0; }
};

DamageEquation::DamageEquation(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal)
    : mesh_(mesh),
      model_(model),
      damageable_(damageable_cells(mesh, model)),
      sound_density_(energy_density(mesh, model)),
      toughness_factor_(mesh.n_cells(), 1.0),
      density_(sound_density_),
      flux_(mesh, medium_of(mesh, model, plane_normal)),
      stiffness_damage_(mesh, model, plane_normal) {}

double DamageEquation::local_slope(Index cell, double d, double psi) const {
  const Degradation& degradation = model_.degradation_of(model_.in_cell(mesh_, cell));
  const double own = drive_.from.size() > 0 ? 0.0 : (1.0 - model_.residual_stiffness) * degradation.g_prime(d) * psi;
  const double slope = density_[cell] * model_.crack->alpha_prime(d) + own;
  const double source = source_.size() > 0 ? source_[cell] : 0.0;
  const double force = force_.size() > 0 ? degradation.g(d) * force_[cell] : 0.0;
  const double resistance = resistance_ > 0.0 ? resistance_ * (d - from_[cell]) : 0.0;
  const double local = mesh_.cell_volume[cell] * (slope + resistance - source - force);
  if (drive_.from.size() == 0) return local;
  return local + drive_.slope[cell] + drive_.diagonal[cell] * (d - drive_.from[cell]);
}

double DamageEquation::local_curvature(Index cell, double d, double psi) const {
  const Degradation& degradation = model_.degradation_of(model_.in_cell(mesh_, cell));
  const double force = force_.size() > 0 ? degradation.g_prime(d) * force_[cell] : 0.0;
  const double own = drive_.from.size() > 0 ? 0.0 : (1.0 - model_.residual_stiffness) * degradation.g_second(d) * psi;
  return mesh_.cell_volume[cell] * (density_[cell] * model_.crack->alpha_second(d) + resistance_ - force + own) +
         mean_diagonal(cell);
}

void DamageEquation::linearise_drive(const CellField<double>& psi_plus, const CellField<double>& d) {
  if (!stiffness_damage_.any()) return;
  constexpr double least_curvature = 0.2;  // of that at a fixed dD/dx: where the energy is not convex in d
  const std::size_t n = mesh_.n_cells();
  const CellField<double> mean = stiffness_damage_.means(d);
  CellField<double> slope(n, 0.0), bound(n, 0.0);
  drive_.curvature = CellField<double>(n, 0.0);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (!is_damageable(c)) return;
    const Degradation& degradation = model_.degradation_of(model_.in_cell(mesh_, c));
    const StiffnessDamage::At D = stiffness_damage_.at(c, mean[c]);
    const double energy = mesh_.cell_volume[c] * (1.0 - model_.residual_stiffness) * psi_plus[c];
    const double convex = energy * degradation.g_second(D.value) * D.slope * D.slope;
    slope[c] = energy * degradation.g_prime(D.value) * D.slope;
    drive_.curvature[c] = convex + energy * degradation.g_prime(D.value) * D.curvature;
    bound[c] = std::max(drive_.curvature[c], least_curvature * convex);
  });
  drive_.slope = stiffness_damage_.spread(slope);
  drive_.diagonal = stiffness_damage_.spread(bound);
  drive_.from = d;
}

CellField<double> DamageEquation::stiffness_slopes(const CellField<double>& d) const {
  CellField<double> slope = stiffness_damage_.means(d);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (!is_damageable(c)) {
      slope[c] = 0.0;
      return;
    }
    const Degradation& degradation = model_.degradation_of(model_.in_cell(mesh_, c));
    const StiffnessDamage::At D = stiffness_damage_.at(c, slope[c]);
    slope[c] = (1.0 - model_.residual_stiffness) * degradation.g_prime(D.value) * D.slope;
  });
  return slope;
}

double DamageEquation::driving_curvature(Index cell, double d, double psi_slope) const {
  const Degradation& degradation = model_.degradation_of(model_.in_cell(mesh_, cell));
  return mesh_.cell_volume[cell] * (1.0 - model_.residual_stiffness) * degradation.g_prime(d) * psi_slope;
}

double DamageEquation::imbalance(Index cell, const CellField<double>& d, double psi_plus) const {
  return flux_.balance(cell, d, local_slope(cell, d[cell], psi_plus));
}

double DamageEquation::diagonal(Index cell, double d, double psi_plus) const {
  return flux_.diagonal(cell) + local_curvature(cell, d, psi_plus);
}

void DamageEquation::set_toughness_factor(CellField<double> factor, const CellField<double>& d) {
  if (factor == toughness_factor_) return;
  toughness_factor_ = std::move(factor);
  for (Index c = 0; c < mesh_.n_cells(); ++c) density_[c] = toughness_factor_[c] * sound_density_[c];
  flux_.scale(toughness_factor_);
  flux_.renew_correction(d);
}

void DamageEquation::resist_change(double resistance, const CellField<double>& from) {
  resistance_ = resistance;
  from_ = from;
}

double DamageEquation::viscous_dissipation(const CellField<double>& d) const {
  if (!(resistance_ > 0.0)) return 0.0;
  return parallel_sum(mesh_.n_cells(), [&](Index c) { return viscous_dissipation(c, d[c]); });
}

double DamageEquation::viscous_dissipation(Index cell, double d) const {
  if (!(resistance_ > 0.0)) return 0.0;
  const double change = d - from_[cell];
  return mesh_.cell_volume[cell] * resistance_ * change * change;
}

ScalarSolution DamageEquation::solve(const CellField<double>& psi_plus, const CellField<double>& lower,
                                     const ScalarTolerance& tolerance, CellField<double>& d) {
  linearise_drive(psi_plus, d);
  const auto fixed = [&](Index c, double) { return DrivingAt{.value = psi_plus[c]}; };
  const Term<decltype(fixed)> term{*this, fixed, lower};
  return BoundedNewton(flux_, term, d).solve(tolerance);
}

ScalarSolution DamageEquation::solve(const DrivingLaw& psi_plus, const CellField<double>& lower,
                                     const ScalarTolerance& tolerance, CellField<double>& d) {
  const Term<DrivingLaw> term{*this, psi_plus, lower};
  ScalarTolerance damped = tolerance;
  damped.damps = true;
  return BoundedNewton(flux_, term, d).solve(damped);
}

CellField<double> DamageEquation::relaxed(const CellField<double>& given) {
  constexpr Index most_turns = 100;  // of the deferred correction, and of an active set far from its solution
  constexpr double precision = 1e-6;
  const CellField<double> no_energy(mesh_.n_cells(), 0.0);
  CellField<double> d = given;
  for (Index turn = 0; turn < most_turns; ++turn) {
    const CellField<double> before = d;
    const ScalarSolution solution = solve(no_energy, given, {}, d);
    const double change = parallel_max(d.size(), [&](Index c) { return std::abs(d[c] - before[c]); });
    if (solution.converged && change < precision) break;
  }
  return d;
}

double DamageEquation::local_energy(Index c, double d) const {
  return mesh_.cell_volume[c] * density_[c] * model_.crack->alpha(d) + 0.5 * flux_.exchanged(c) * d * d;
}

double DamageEquation::fracture_energy(const CellField<double>& d) const {
  const double local = parallel_sum(mesh_.n_cells(), [&](Index c) { return local_energy(c, d[c]); });
  return local + parallel_sum(count_of(flux_.links()), [&](Index i) { return flux_.energy(i, d); });
}

double DamageEquation::unevenness(const CellField<double>& d) const {
  const double gradient = parallel_sum(count_of(flux_.links()), [&](Index i) { return flux_.energy(i, d); });
  const double square =
      parallel_sum(mesh_.n_cells(), [&](Index c) { return mesh_.cell_volume[c] * density_[c] * d[c] * d[c]; });
  return square > 0.0 ? gradient / square : 0.0;
}

// d(sigma)/d(eps) of sigma = g E eps with the damage that minimises g psi + w, psi = E eps^2/2, is negative.
bool DamageEquation::softens(Index cell, double d, double psi_plus) const {
  const Degradation& degradation = model_.degradation_of(model_.in_cell(mesh_, cell));
  const double slope = degradation.g_prime(d);
  const double curvature = density_[cell] * model_.crack->alpha_second(d) + degradation.g_second(d) * psi_plus;
  return is_damageable(cell) && 2.0 * slope * slope * psi_plus > degradation.g(d) * curvature;
}

CellField<double> DamageEquation::fracture_energy_density(const CellField<double>& d) const {
  CellField<double> energy(mesh_.n_cells());
  for (Index c = 0; c < mesh_.n_cells(); ++c) energy[c] = local_energy(c, d[c]);
  for (std::size_t i = 0; i < flux_.links().size(); ++i) {
    const double half = 0.5 * flux_.energy(static_cast<Index>(i), d);
    energy[flux_.links()[i].P] += half;
    energy[flux_.links()[i].N] += half;
  }
  for (Index c = 0; c < mesh_.n_cells(); ++c) energy[c] /= mesh_.cell_volume[c];
  return energy;
}

double DamageEquation::renewed_fracture_energy(const CellField<double>& d) {
  flux_.renew_correction(d);
  return fracture_energy(d);
}

}  // namespace pfdm
