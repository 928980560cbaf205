#pragma once
// A uniform plate under cycles of strain whose toughness falls by fatigue, and the same at a point, by the equations of
// Carrara et al. (CMAME 361 (2020) 112731).

#include "solver/fracture/fracture_run.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace pfdm::verification::fatigue_plate {

inline constexpr double E = 30e9, Gc = 100.0, ell = 5e-3, side = 10e-3, threshold = 2e3;
inline constexpr double peak_strain = 3e-4;  // 0.6 of the elastic limit of AT1

inline double strain_at(double t) {
  const double s = std::sin(std::numbers::pi * t);
  return peak_strain * s * s;
}

struct Row {
  double damage = 0.0, energy = 0.0;  // d [-], alpha_bar [J/m^3]
  double imbalance = 0.0;             // of work and energies, over the work
  double cycles = 0.0;
};

/// A law of fatigue as it is published, with its row in the program.
struct Law {
  std::string name;
  LawParameters p{};
  double factor(double x) const {
    if (x <= 1.0) return 1.0;
    if (name == "asymptotic") return 4.0 / ((x + 1.0) * (x + 1.0));
    return x < std::pow(10.0, 1.0 / p[0]) ? std::pow(1.0 - p[0] * std::log10(x), 2.0) : 0.0;
  }
};
inline const Law asymptotic{"asymptotic", {}}, logarithmic{"logarithmic", {0.9}};

/// At a point, f being that of the step's start: f Gc/(c0 ell) alpha'(d) = 2 (1 - d) psi, d never falls. With `history`
/// the largest psi so far drives it.
inline Row integrate(const std::string& crack, const Law& law, double cycles, Index steps_per_cycle,
                     bool history = false) {
  Row row;
  double active = 0.0, largest = 0.0;
  const auto n = static_cast<Index>(std::lround(cycles * double(steps_per_cycle)));
  for (Index i = 1; i <= n; ++i) {
    const double eps = strain_at(double(i) / double(steps_per_cycle)), psi = 0.5 * E * eps * eps;
    const double tough = law.factor(row.energy / threshold) * Gc / ell;
    double d = 0.0;
    largest = std::max(largest, psi);
    const double drive = history ? largest : psi;
    if (drive > 0.0) d = crack == "AT1" ? 1.0 - 3.0 / 16.0 * tough / drive : 2.0 * drive / (2.0 * drive + tough);
    row.damage = std::clamp(d, row.damage, 1.0);
    const double now = (1.0 - row.damage) * (1.0 - row.damage) * psi;
    row.energy += std::max(now - active, 0.0);
    active = now;
  }
  return row;
}

struct Plate {
  std::string crack = "AT1";
  std::optional<Law> law{};
  FatigueCycles cycles{};
  double alpha_T = threshold;
  Index cells = 1;
  double weakness = 0.0;  // of the toughness of the cells of one half
  bool is_monotonic = false;
  bool history = false;  // of the driving energy, for irreversibility
};

inline FractureModel model_of(const Plate& plate, const Mesh& mesh) {
  FractureModel model =
      elastic_model({}, {symmetry_on("xmin"), symmetry_on("ymin"), plane_on("zmin"), plane_on("zmax")});
  model.crack = &crack_geometry(plate.crack);
  model.regions = {{.elasticity = from_young_poisson(E, 0.0), .Gc = Gc, .ell = ell}};
  if (plate.law) model.regions[0].fatigue = Fatigue(fatigue_law(plate.law->name), plate.alpha_T, plate.law->p);
  model.fatigue_cycles = plate.cycles;
  if (plate.history) model.irreversibility = Irreversibility::history;
  model.residual_stiffness = 1e-12;
  model.boundary.push_back(moved("xmax", {true, false, false}, [&plate](const Vector&, double t) {
    return Vector((plate.is_monotonic ? 3.0 * peak_strain * t : strain_at(t)) * side, 0.0, 0.0);
  }));
  if (plate.weakness == 0.0) return model;
  model.cells = CellField<RegionModel>(mesh.n_cells(), model.regions[0]);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c][0] > 0.5 * side) model.cells[c].Gc *= 1.0 - plate.weakness;
  return model;
}

inline Mesh mesh_of(Index n) {
  return make_box_hexes(
      {.axes = {{{{side, n, 1.0}}, {{side, n, 1.0}}, {{side / double(n), 1, 1.0}}}}, .regions = {}, .slits = {}});
}

struct Outcome {
  FractureState state;
  std::vector<Row> rows;
  std::vector<EnergyAccount> accounts;
  Index lost_work = 0;  // remarks on it
};

inline Outcome stretch(const Plate& plate, double cycles, Index steps_per_cycle, double tolerance = 1e-10) {
  const Mesh mesh = mesh_of(plate.cells);
  const double increment = 1.0 / double(steps_per_cycle);
  FractureRun run(mesh, model_of(plate, mesh),
                  {.damage_tolerance = tolerance, .energy_tolerance = tolerance, .maximum_iterations = 5000},
                  {.end = cycles, .initial_increment = increment, .maximum_increment = increment, .stops = {}});
  Outcome outcome;
  outcome.state = run_to_end(run, [&](const FractureState& state, const StepReport& report) {
    if (report.step == 0) return;
    for (const std::string& remark : report.remarks) {
      EXPECT_EQ(remark.find("converge"), remark.npos) << remark;
      if (remark.find("fatigue.steps") != remark.npos) ++outcome.lost_work;
    }
    const EnergyAccount& e = report.energy;
    outcome.accounts.push_back(e);
    outcome.rows.push_back({.damage = report.max_damage,
                            .energy = plate.law ? state.fatigue.energy[0] : 0.0,
                            .imbalance = (e.external_work - e.elastic - e.fracture) / e.external_work,
                            .cycles = state.load});
  });
  return outcome;
}

}  // namespace pfdm::verification::fatigue_plate
