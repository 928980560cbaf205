#include "solver/fracture/conducted_heat.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace pfdm {
namespace {

constexpr double cycle_rounding = 1e-9;  // of a cycle

HeatBody heat_body(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal) {
  HeatBody body{.conductivity = CellField<double>(mesh.n_cells()),
                .capacity = CellField<double>(mesh.n_cells()),
                .boundary = model.heat->boundary,
                .plane_normal = plane_normal};
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = model.in_cell(mesh, c);
    body.conductivity[c] = region.conductivity;
    body.capacity[c] = region.density * region.specific_heat;
  }
  for (const CohesiveSurface& surface : model.interfaces)
    body.interfaces.insert(body.interfaces.end(), surface.faces.begin(), surface.faces.end());
  return body;
}

}  // namespace

ConductedHeat::ConductedHeat(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal)
    : mesh_(mesh), model_(model), equation_(mesh, heat_body(mesh, model, plane_normal)) {}

HeatState ConductedHeat::start(double duration) const {
  std::size_t n_faces = 0;
  for (const CohesiveSurface& surface : model_.interfaces) n_faces += surface.faces.size();
  const std::size_t n = mesh_.n_cells();
  return {.rise = CellField<double>(n, 0.0),
          .made = CellField<double>(n, 0.0),
          .cycle = {},
          .transmitted = std::vector<double>(n_faces, 0.0),
          .cycle_transmittance = {},
          .duration = duration,
          .elapsed = 0.0,
          .stood_for = {},
          .stretch = 0.0,
          .felt = {}};
}

std::vector<double> ConductedHeat::transmittance(const std::vector<char>& parted) const {
  std::vector<double> of_face(parted.size());
  for (std::size_t k = 0; k < parted.size(); ++k)
    of_face[k] =
        equation_.transmittance(k, parted[k] != 0 ? model_.heat->open_conductance : model_.heat->closed_conductance);
  return of_face;
}

void ConductedHeat::advance(const Staggered& staggered, const FractureState& from, double duration, FractureState& to) {
  const std::vector<double> transmittance =
      this->transmittance(staggered.faces().parted(staggered.balance(), to.displacement, to.interfaces));
  equation_.set_transmittance(transmittance);
  CellField<double> made(mesh_.n_cells());
  parallel_for(mesh_.n_cells(), [&](Index c) {
    made[c] = staggered.stiffness().plastic_dissipation(c, from, to) +
              staggered.damage_equation().viscous_dissipation(c, to.damage[c]);
  });
  equation_.add_interfaces(staggered.faces().heat(from.interfaces, to.interfaces, model_.heat->debonding_share), made);
  equation_.step(duration, made, to.heat.rise, to.heat.account);
  to.heat.elapsed += duration;
  parallel_for(mesh_.n_cells(), [&](Index c) { to.heat.made[c] += made[c]; });
  for (std::size_t k = 0; k < transmittance.size(); ++k) to.heat.transmitted[k] += duration * transmittance[k];
  if (to.load < end_of_cycle(from.load) - cycle_rounding * model_.heat->cycle) return;
  end_cycle(duration / (to.load - from.load) * model_.heat->cycle, to.heat);
  if (follows_long_time(*model_.heat) && repeats(to.heat)) warm_on(staggered.temperature(), to.load, to.heat);
}

// A cycle stands for a time in which the moduli change by a small share; steps that would change them by much more are
// halved. Nor is it much longer than the last one, after which the heat of a cycle had changed by that share.
void ConductedHeat::warm_on(const CellTemperature& temperature, double load, HeatState& heat) {
  constexpr double most = 1.5, least_step = 1e-9;
  const HeatModel& by = *model_.heat;
  const CellField<double> power = mean_power(heat);
  equation_.set_transmittance(heat.cycle_transmittance);
  const double longest = longest_stretch(heat), end = std::min(heat.elapsed + longest, by.time);
  const double begin = heat.elapsed;
  double dt = std::min(by.time / static_cast<double>(by.time_steps), longest);
  for (double change = 0.0; change < by.changes_within && heat.elapsed < end;) {
    CellField<double> rise = heat.rise, given = power;
    HeatBalance account = heat.account;
    const bool is_last = heat.elapsed + dt >= end * (1.0 - 1e-12);
    const double step = is_last ? end - heat.elapsed : dt;
    for (double& q : given) q *= step;
    equation_.step(step, given, rise, account);
    change = temperature.change_of_moduli(heat.felt, rise, load, 2.0 * std::numbers::pi / (by.cycle * heat.duration));
    if (change > most * by.changes_within && step > least_step * by.time) {
      dt = 0.5 * step, change = 0.0;
      continue;
    }
    heat.rise = std::move(rise);
    heat.account = account;
    heat.elapsed = is_last ? end : heat.elapsed + step;
  }
  heat.stretch = heat.elapsed - begin;
  heat.stood_for = heat.cycle;
  heat.cycle_change = std::numeric_limits<double>::infinity();
}

double ConductedHeat::longest_stretch(const HeatState& heat) const {
  constexpr double most_growth = 5.0, least_growth = 0.2;
  const HeatModel& by = *model_.heat;
  if (heat.stood_for.size() == 0) return by.time / static_cast<double>(by.time_steps);
  const double change = relative_change(heat.stood_for, heat.cycle);
  return heat.stretch * std::clamp(by.changes_within / change, least_growth, most_growth);
}

// Summed over the cells, over the whole heat of now.
double ConductedHeat::relative_change(const CellField<double>& before, const CellField<double>& now) const {
  const auto sum = [&](const auto& of_cell) { return parallel_sum(mesh_.n_cells(), of_cell); };
  const double change = sum([&](Index c) { return std::abs(now[c] - before[c]); });
  return change > 0.0 ? change / sum([&](Index c) { return std::abs(now[c]); }) : 0.0;
}

double ConductedHeat::end_of_cycle(double load) const {
  if (!(model_.heat->cycle > 0.0)) return std::numeric_limits<double>::infinity();
  return model_.heat->cycle * (std::floor(load / model_.heat->cycle + cycle_rounding) + 1.0);
}

// `duration`: of a cycle [s].
void ConductedHeat::end_cycle(double duration, HeatState& heat) const {
  if (heat.cycle.size() > 0) heat.cycle_change = relative_change(heat.cycle, heat.made);
  heat.cycle = std::exchange(heat.made, CellField<double>(mesh_.n_cells(), 0.0));
  heat.cycle_transmittance = std::exchange(heat.transmitted, std::vector<double>(heat.transmitted.size(), 0.0));
  for (double& of_face : heat.cycle_transmittance) of_face /= duration;
}

std::optional<HeatReport> ConductedHeat::report(const HeatState& heat) const {
  return HeatReport{.figures = equation_.figures(heat.rise),
                    .account = heat.account,
                    .cycle_change = heat.cycle_change,
                    .elapsed = heat.elapsed};
}

bool ConductedHeat::is_complete(const HeatState& heat) const {
  if (!(model_.heat->cycle > 0.0)) return false;
  return follows_long_time(*model_.heat) ? heat.elapsed >= model_.heat->time : repeats(heat);
}

CellField<double> ConductedHeat::mean_power(const HeatState& heat) const {
  CellField<double> power = heat.cycle;
  for (double& q : power) q /= model_.heat->cycle * heat.duration;
  return power;
}

std::vector<HeatRow> ConductedHeat::warm_by_cycles(const HeatState& heat, double time, Index n,
                                                   CellField<double>& rise) {
  if (heat.cycle.size() == 0) return BodyHeat::warm_by_cycles(heat, time, n, rise);
  equation_.set_transmittance(heat.cycle_transmittance);
  rise = CellField<double>(mesh_.n_cells(), 0.0);
  return equation_.under_steady_source(mean_power(heat), time, n, rise);
}

void ConductedHeat::show(const HeatState& heat, std::vector<OutputHistory>& fields) const {
  const bool has_cycle = heat.cycle.size() > 0;
  CellField<double> density = has_cycle ? heat.cycle : heat.made;
  for (Index c = 0; c < mesh_.n_cells(); ++c) density[c] /= mesh_.cell_volume[c];
  fields.push_back({.name = "temperature_rise", .unit = "K", .scalar = heat.rise});
  fields.push_back({.name = has_cycle ? "heat_of_cycle" : "heat", .unit = "J/m^3", .scalar = std::move(density)});
}

}  // namespace pfdm
