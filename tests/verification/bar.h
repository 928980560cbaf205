#pragma once
// A bar in tension between its ends, one-dimensional (nu = 0), whose middle cell is a little less tough than the rest,
// so that damage localises there. Two cells wide, one cell thick.

#include "physics/closed_forms/bars.h"
#include "solver/fracture/fracture_run.h"
#include "solver/fracture/staggered.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::verification {

struct BarSettings {
  std::string law = "AT1";
  std::string softening{};      ///< of the rational degradation; none: the quadratic one
  double irwin_lengths = 20.0;  ///< with a softening law: E Gc/(ft^2 ell), which sets its strength ft
  Index cells_per_length = 10;  ///< cells in one ell
  Index refinement = 1;         ///< of the middle four ell: cells in one of the others, odd
  double length = 5.3;          ///< of the part that can be damaged, in ell; rounded to an odd number of cells
  Index weak_cells = 1;         ///< in the middle, odd
  double weakness = 0.02;       ///< share of its toughness, or of ft, that the middle cell lacks
  /// Undamageable cells at both ends, d = 0 on their faces: without, damage likes the ends, where half a band will do.
  bool pinned_ends = true;
  double tolerance = 1e-4;  ///< of damage and energy
  double residual_stiffness = 1e-6;
  double poisson_ratio = 0.0;
  bool plane_stress = false;  ///< the bar may contract; else it is held at its sides
  std::string split = "none";
};

/// What a load step left behind.
struct BarState {
  double load = 0.0;             ///< elongation over that at which the undamaged bar reaches its strength [-]
  double stress = 0.0;           ///< over the strength [-]
  double separation = 0.0;       ///< elongation beyond that of an undamaged bar, times strength / Gc [-]
  double largest_damage = 0.0;   ///< [-]
  double fracture_energy = 0.0;  ///< per area, over Gc [-]
  double imbalance = 0.0;        ///< (work - elastic energy - fracture energy) / work [-]
  CellField<double> damage;
};

class Bar {
 public:
  static constexpr double E = 30e9, Gc = 100.0, ell = 5e-3;

  explicit Bar(const BarSettings& settings) : settings_(settings), mesh_(make_mesh(settings)), model_(make_model()) {}

  const Mesh& mesh() const { return mesh_; }
  const FractureModel& model() const { return model_; }
  double cell_width() const { return ell / settings_.cells_per_length; }
  double length() const { return mesh_.points.back()[0] - mesh_.points.front()[0]; }
  double area() const { return 2.0 * cell_width() * cell_width(); }
  double strength() const {
    if (!settings_.softening.empty()) return std::sqrt(E * Gc / (settings_.irwin_lengths * ell));
    return settings_.law == "AT1" ? at1_strength(E, Gc, ell) : at2_strength(E, Gc, ell);
  }

  /// One leg after the other, each to a load in so many equal steps. No step is cut.
  struct Leg {
    double end;
    Index n_steps;
  };
  using Seen = std::function<void(FractureRun&, const FractureState&)>;
  std::vector<BarState> run(const std::vector<Leg>& legs, const Seen& seen = {}) const;

  /// To the end of the load, by steps that dissipate no more than `dissipation` times Gc on the bar's section: past
  /// snap-back.
  std::vector<BarState> follow(double end, double increment, double dissipation) const;

  /// To the end of the load, by steps that release no more than this share of the energy, down to the finest increment.
  std::vector<BarState> resolve(double end, double increment, double energy_release, double finest) const;

  /// The same without irreversibility, as the closed forms have it: every step may heal what the one before broke.
  std::vector<BarState> run_reversibly(const std::vector<Leg>& legs) const;

  /// Fields of a state that need not be one of a run.
  OutputFields output(const FractureState& state) const {
    return FractureRun(mesh_, model_, staggered(), {}).output(state);
  }
  FractureState sound_state() const { return FractureRun(mesh_, model_, staggered(), {}).initial_state(); }

  /// Cells along x, in one of the two rows.
  std::vector<Index> row() const;
  /// Cells of a row that are broken, d > 0.99.
  Index n_broken(const CellField<double>& damage) const {
    const std::vector<Index> cells = row();
    return static_cast<Index>(std::count_if(cells.begin(), cells.end(), [&](Index c) { return damage[c] > 0.99; }));
  }

 private:
  static Mesh make_mesh(const BarSettings& settings);
  FractureModel make_model() const;
  BarState state_of(const FractureState& state, double force, double fracture_energy) const;
  StepSeen recorder(std::vector<BarState>& states) const;
  std::vector<BarState> run_with(LoadingSettings loading) const;
  StaggeredSettings staggered() const {
    return {
        .damage_tolerance = settings_.tolerance, .energy_tolerance = settings_.tolerance, .maximum_iterations = 20000};
  }

  BarSettings settings_;
  Mesh mesh_;
  FractureModel model_;
};

inline Mesh Bar::make_mesh(const BarSettings& settings) {
  const double h = ell / settings.cells_per_length;
  const Index ends = settings.pinned_ends ? 1 : 0;
  const auto half = static_cast<Index>(std::lround(0.5 * settings.length * settings.cells_per_length - 0.5));
  const Index n = 2 * (half + ends) + 1;
  const Index fine = 4 * settings.cells_per_length / 2 * 2 + 1;  // cells that are refined
  const double outer = 0.5 * (n - fine) * h, thin = h / settings.refinement;
  BoxHexesSettings box;
  box.origin = {-0.5 * n * h, 0.0, 0.0};
  box.axes[0] = {
      {outer, (n - fine) / 2, 1.0}, {fine * h, fine * settings.refinement, 1.0}, {outer, (n - fine) / 2, 1.0}};
  box.axes[1] = {{2.0 * h, 2, 1.0}};
  box.axes[2] = {{h, 1, 1.0}};
  const auto slab = [](const std::string& name, double from, double to) -> SubRegion {
    return {.name = name, .lower = {from, -1.0, -1.0}, .upper = {to, 1.0, 1.0}};
  };
  box.regions.push_back(slab("weak", -0.5 * settings.weak_cells * thin, 0.5 * settings.weak_cells * thin));
  if (settings.pinned_ends) {
    box.regions.push_back(slab("end", -n * h, -(0.5 * n - 1.0) * h));
    box.regions.push_back(slab("end", (0.5 * n - 1.0) * h, n * h));
  }
  return make_box_hexes(box);
}

inline FractureModel Bar::make_model() const {
  FractureModel model;
  for (const std::string& name : mesh_.region_names)
    model.regions.push_back({.elasticity = from_young_poisson(E, settings_.poisson_ratio),
                             .Gc = name == "weak" ? (1.0 - settings_.weakness) * Gc : Gc,
                             .ell = ell,
                             .damageable = name != "end"});
  model.crack = &crack_geometry(settings_.law);
  model.residual_stiffness = settings_.residual_stiffness;
  model.degradation = degradation(settings_.softening.empty() ? "quadratic" : "rational");
  if (!settings_.softening.empty())
    for (std::size_t r = 0; r < model.regions.size(); ++r) {
      const double ft = strength() * (mesh_.region_names[r] == "weak" ? 1.0 - settings_.weakness : 1.0);
      model.regions[r].Gc = Gc;
      model.regions[r].degradation =
          rational_degradation(rational_coefficients(softening_law(settings_.softening), E, Gc, ft, ell));
    }
  model.split = energy_split(settings_.split);
  BoundaryCondition pulled = displacement_on("xmax", {});
  pulled.value = [elongation = strength() / E * length()](const Vector&, double t) {
    return Vector(elongation * t, 0.0, 0.0);
  };
  pulled.displacement_prescribed = {true, false, false};
  model.boundary = {symmetry_on("xmin"), pulled, symmetry_on("ymin")};
  if (!settings_.plane_stress) model.boundary.push_back(symmetry_on("ymax"));
  for (const char* side : {"zmin", "zmax"})
    model.boundary.push_back(settings_.plane_stress ? plane_stress_on(side) : plane_on(side));
  return model;
}

inline BarState Bar::state_of(const FractureState& state, double force, double fracture_energy) const {
  const double stress = force / area();
  const double elongation = state.load * strength() / E * length();
  return {.load = state.load,
          .stress = stress / strength(),
          .separation = (elongation - stress / E * length()) * strength() / Gc,
          .largest_damage = *std::max_element(state.damage.begin(), state.damage.end()),
          .fracture_energy = fracture_energy / (area() * Gc),
          .damage = state.damage};
}

inline StepSeen Bar::recorder(std::vector<BarState>& states) const {
  const auto pulled = mesh_.patch_index("xmax");
  return [this, pulled, &states](const FractureState& state, const StepReport& report) {
    for (const std::string& remark : report.remarks) ADD_FAILURE() << remark;
    if (report.step == 0) return;
    states.push_back(state_of(state, report.reaction[pulled][0], report.energy.fracture));
    states.back().imbalance =
        (report.energy.external_work - report.energy.elastic - report.energy.fracture) / report.energy.external_work;
  };
}

inline std::vector<BarState> Bar::run(const std::vector<Leg>& legs, const Seen& seen) const {
  std::vector<BarState> states;
  const StepSeen record = recorder(states);
  FractureState state;
  for (const auto& [end, n_steps] : legs) {
    const double increment = (end - state.load) / n_steps;
    FractureRun leg(mesh_, model_, staggered(),
                    {.end = end, .initial_increment = increment, .maximum_increment = increment, .stops = {}});
    if (state.step == 0) state = leg.initial_state();
    state.increment = increment;
    state = advance_to_end(leg, std::move(state), [&](const FractureState& now, const StepReport& report) {
      record(now, report);
      if (seen) seen(leg, now);
    });
  }
  return states;
}

inline std::vector<BarState> Bar::follow(double end, double increment, double dissipation) const {
  return run_with({.end = end,
                   .initial_increment = increment,
                   .maximum_increment = increment,
                   .maximum_dissipation = dissipation * Gc * area(),
                   .stops = {}});
}

inline std::vector<BarState> Bar::resolve(double end, double increment, double energy_release, double finest) const {
  return run_with({.end = end,
                   .initial_increment = increment,
                   .maximum_increment = increment,
                   .energy_release = energy_release,
                   .finest_increment = finest,
                   .stops = {}});
}

inline std::vector<BarState> Bar::run_with(LoadingSettings loading) const {
  std::vector<BarState> states;
  FractureRun run(mesh_, model_, staggered(), std::move(loading));
  run_to_end(run, recorder(states));
  return states;
}

inline std::vector<BarState> Bar::run_reversibly(const std::vector<Leg>& legs) const {
  const FractureState sound = sound_state();
  const Unknowns unknowns = place_unknowns(mesh_, elastic_body(model_));
  Staggered solver(mesh_, model_, unknowns, staggered());
  const Patch& pulled = mesh_.patch("xmax");
  std::vector<BarState> states;
  FractureState state = sound;
  for (const auto& [end, n_steps] : legs) {
    const double start = state.load;
    for (Index step = 1; step <= n_steps; ++step) {
      state.load = start + (end - start) * step / n_steps;
      EXPECT_TRUE(solver.solve_step(sound, state, {}).converged) << "load " << state.load;
      const std::vector<Vector> forces = solver.momentum().balance().boundary_forces(state.displacement);
      double force = 0.0;
      for (Index f = pulled.first_face; f < pulled.first_face + pulled.n_faces; ++f)
        force += forces[f - mesh_.n_interior_faces()][0];
      states.push_back(state_of(state, force, solver.damage_equation().fracture_energy(state.damage)));
    }
  }
  return states;
}

inline std::vector<Index> Bar::row() const {
  std::vector<Index> cells;
  for (Index c = 0; c < mesh_.n_cells(); ++c)
    if (mesh_.cell_centre[c][1] < cell_width()) cells.push_back(c);
  std::sort(cells.begin(), cells.end(),
            [&](Index a, Index b) { return mesh_.cell_centre[a][0] < mesh_.cell_centre[b][0]; });
  return cells;
}

/// The state with the largest stress.
inline const BarState& peak(const std::vector<BarState>& states) {
  return *std::max_element(states.begin(), states.end(),
                           [](const BarState& a, const BarState& b) { return a.stress < b.stress; });
}

/// Of the steps of 0.1 in which this model breaks the bar, to 1.6 of the displacement at its strength.
inline std::vector<StepReport> reports_of_break(const Bar& bar, const FractureModel& model) {
  std::vector<StepReport> reports;
  FractureRun run(bar.mesh(), model,
                  {.damage_tolerance = 1e-6, .energy_tolerance = 1e-6, .equilibrium_tolerance = 1e-9},
                  {.end = 1.6, .initial_increment = 0.1, .maximum_increment = 0.1, .stops = {}});
  run_to_end(run, [&](const FractureState&, const StepReport& report) { reports.push_back(report); });
  return reports;
}

}  // namespace pfdm::verification
