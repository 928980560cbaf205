#include "postproc/cohesive/cohesive_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

constexpr int n_bins = 12;
constexpr double resolved = 1e-3;  // part of the known separation below which a rise counts as rigid

ColumnSample taken_off_bulk(ColumnSample sample, SurfaceKind kind) {
  if (kind == SurfaceKind::plane) sample.separation -= sample.bulk;
  return sample;
}

void add(ColumnSample& sum, const ColumnSample& sample, double weight) {
  sum.traction += weight * sample.traction;
  sum.separation += weight * sample.separation;
  sum.bulk += weight * sample.bulk;
  sum.surface_energy += weight * sample.surface_energy;
  sum.largest_damage += weight * sample.largest_damage;
}

CohesiveLaw mean_of(const ColumnRecord& record, const std::vector<std::size_t>& places, double from, double to) {
  CohesiveLaw law{.from = from, .to = to, .places = places, .area = 0.0, .states = {}};
  if (places.empty()) return law;
  for (const std::size_t p : places) law.area += record.places[p].area;
  for (const std::vector<ColumnSample>& step : record.steps) {
    ColumnSample mean;
    for (const std::size_t p : places) add(mean, step[p], record.places[p].area / law.area);
    law.states.push_back(taken_off_bulk(mean, record.kind));
  }
  return law;
}

double tangential(const Vector& v) { return std::hypot(v[1], v[2]); }

// Where the traction first reaches half the strength, by interpolation from the state before.
double stiffness_at_half(const std::vector<ColumnSample>& states, double strength, double known) {
  for (std::size_t i = 1; i < states.size(); ++i) {
    const double T = states[i].traction[0], before = states[i - 1].traction[0];
    if (T < 0.5 * strength) continue;
    const double share = (0.5 * strength - before) / (T - before);
    const double separation =
        states[i - 1].separation[0] + share * (states[i].separation[0] - states[i - 1].separation[0]);
    return separation > resolved * known ? 0.5 * strength / separation : CohesiveFigures::none;
  }
  return CohesiveFigures::none;
}

// The largest before the jump, if there is one.
double known_separation(const std::vector<ColumnSample>& states, std::optional<std::size_t> jump) {
  double largest = 0.0;
  for (std::size_t i = 0; i < jump.value_or(states.size()); ++i) largest = std::max(largest, states[i].separation[0]);
  return largest;
}

struct Energies {
  double normal = 0.0, tangential = 0.0, at_least = 0.0;  // [J/m^2]
  bool jumps = false;
};

bool falls_at_once(const ColumnSample& before, const ColumnSample& after, double strength) {
  const bool opens = after.separation.norm() > before.separation.norm();  // else it is unloaded
  return opens && before.traction[0] - after.traction[0] > 0.5 * strength;
}

double strength_of(const std::vector<ColumnSample>& states) {
  return std::ranges::max(states, {}, [](const ColumnSample& s) { return s.traction[0]; }).traction[0];
}

Energies energies_of(const std::vector<ColumnSample>& states) {
  const double strength = strength_of(states);
  Energies energies;
  for (std::size_t i = 1; i < states.size(); ++i) {
    const ColumnSample &a = states[i - 1], &b = states[i];
    const Vector opening = b.separation - a.separation, mean = 0.5 * (a.traction + b.traction);
    if (falls_at_once(a, b, strength)) {
      energies.jumps = true;
      energies.at_least += std::max(0.0, b.traction.dot(opening));
      continue;
    }
    energies.normal += mean[0] * opening[0];
    energies.tangential += mean.tail<2>().dot(opening.tail<2>());
    energies.at_least += mean.dot(opening);
  }
  return energies;
}

// The work of means is not the mean of the places' work where a front passes between them.
Energies mean_energies(const ColumnRecord& record, const CohesiveLaw& law) {
  Energies mean;
  for (const std::size_t p : law.places) {
    const Energies own = energies_of(law_at_place(record, p).states);
    const double share = record.places[p].area / law.area;
    mean.normal += share * own.normal;
    mean.tangential += share * own.tangential;
    mean.at_least += share * own.at_least;
    mean.jumps = mean.jumps || own.jumps;
  }
  return mean;
}

}  // namespace

double cap_angle(double cap, double whole) { return std::acos(std::clamp(1.0 - 2.0 * cap / whole, -1.0, 1.0)); }

bool was_damaged(const ColumnRecord& record, std::size_t place) {
  return std::ranges::any_of(
      record.steps, [&](const std::vector<ColumnSample>& step) { return step[place].largest_damage > sound_damage; });
}

std::size_t n_never_damaged(const ColumnRecord& record) {
  std::size_t n = 0;
  for (std::size_t p = 0; p < record.places.size(); ++p) n += was_damaged(record, p) ? 0 : 1;
  return n;
}

CohesiveLaw law_at_place(const ColumnRecord& record, std::size_t place) {
  return mean_of(record, {place}, record.places[place].polar_angle, record.places[place].polar_angle);
}

CohesiveLaw law_between(const ColumnRecord& record, double from, double to) {
  std::vector<std::size_t> places;
  for (std::size_t p = 0; p < record.places.size(); ++p)
    if (const double angle = record.places[p].polar_angle;
        angle >= from && (angle < to || to == std::numbers::pi) && was_damaged(record, p))
      places.push_back(p);
  return mean_of(record, places, from, to);
}

std::vector<CohesiveLaw> averaged_laws(const ColumnRecord& record) {
  const int n = record.kind == SurfaceKind::plane ? 1 : n_bins;
  std::vector<CohesiveLaw> laws;
  for (int bin = 0; bin < n; ++bin) {
    CohesiveLaw law = law_between(record, bin * std::numbers::pi / n, (bin + 1) * std::numbers::pi / n);
    if (!law.places.empty()) laws.push_back(std::move(law));
  }
  return laws;
}

CohesiveFigures figures_of(const ColumnRecord& record, const CohesiveLaw& law) {
  CohesiveFigures figures;
  const auto& states = law.states;
  const auto strongest = std::ranges::max_element(states, {}, [](const ColumnSample& s) { return s.traction[0]; });
  const Energies energies = mean_energies(record, law);
  figures.energy_at_least = energies.at_least;
  if (!energies.jumps) {
    figures.normal_energy = energies.normal;
    figures.tangential_energy = energies.tangential;
  }
  figures.surface_energy = states.back().surface_energy;
  figures.final_traction = states.back().traction[0];
  for (const ColumnSample& s : states)
    figures.largest_tangential = std::max(figures.largest_tangential, tangential(s.traction));
  if (!(strongest->traction[0] > 0.0)) return figures;
  figures.strength = strongest->traction[0];
  figures.critical_separation = strongest->separation[0];
  figures.bulk_separation = strongest->bulk[0];
  figures.mixity_at_strength = std::atan2(tangential(strongest->traction), figures.strength);
  figures.final_separation =
      std::ranges::max(states, {}, [](const ColumnSample& s) { return s.separation[0]; }).separation[0];
  figures.unloaded = states.back().separation[0] < figures.critical_separation;
  for (std::size_t i = 1; i < states.size() && !figures.jump; ++i)
    if (falls_at_once(states[i - 1], states[i], figures.strength)) figures.jump = i;
  figures.initial_stiffness = stiffness_at_half(states, figures.strength, known_separation(states, figures.jump));
  return figures;
}

std::vector<Debonding> debonding_of(const ColumnRecord& record) {
  const double whole = record.area(), least = record.is_cohesive ? debonded_share : debonded_damage;
  std::vector<Debonding> history;
  for (const std::vector<ColumnSample>& step : record.steps) {
    double plus = 0.0, minus = 0.0;
    for (std::size_t p = 0; p < step.size(); ++p)
      if (step[p].largest_damage > least)
        (record.places[p].polar_angle < 0.5 * std::numbers::pi ? plus : minus) += record.places[p].area;
    const bool sphere = record.kind == SurfaceKind::interface;
    history.push_back({.area = plus + minus,
                       .angle_plus = sphere ? cap_angle(plus, whole) : 0.0,
                       .angle_minus = sphere ? cap_angle(minus, whole) : 0.0});
  }
  return history;
}

}  // namespace pfdm
