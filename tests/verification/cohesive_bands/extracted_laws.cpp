// The traction-separation law that columns extract from a bar, against the closed forms of its phase field
// (literature.md 3.3 to 3.5): cohesive cracks as they run, AT1 and AT2 on the states of their first integrals, the
// whole law down, also where no displacement control can follow it.

#include "postproc/cohesive/cohesive_fit.h"
#include "postproc/cohesive/cohesive_law.h"
#include "tests/verification/bar_profiles.h"
#include "tests/verification/cohesive_bands/cohesive_bar.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

class Extraction {
 public:
  Extraction(const Bar& bar, double half_width)
      : bar_(bar),
        set_(plane_columns(bar.mesh(), "crack", Vector(0.0, 0.5 * bar.cell_width(), 0.0), Vector::UnitX(), half_width,
                           Vector::UnitX())) {
    record_.name = set_.name;
    record_.kind = set_.kind;
    for (const Column& c : set_.columns) record_.places.push_back({c.point, c.normal, 0.0, c.area, c.length});
  }

  void add(const OutputFields& output) {
    record_.steps.push_back(sample_columns(bar_.mesh(), bar_.model(), output, set_));
  }

  const ColumnRecord& record() const { return record_; }
  CohesiveLaw law() const { return averaged_laws(record_).front(); }

 private:
  const Bar& bar_;
  ColumnSet set_;
  ColumnRecord record_;
};

// Of the law that a cohesive phase field produces, up to a separation, by the largest damage [J/m^2].
double produced_area(const SofteningLaw& law, double ft, double separation) {
  constexpr int n = 2000;
  double area = 0.0;
  BarPoint before{.stress = ft, .separation = 0.0};
  for (int i = 1; i < n; ++i) {
    const BarPoint point = pfczm_softening(law, Bar::Gc, ft, static_cast<double>(i) / n);
    if (point.separation > separation) break;
    area += 0.5 * (point.stress + before.stress) * (point.separation - before.separation);
    before = point;
  }
  return area;
}

class ExtractedFromBar : public ::testing::TestWithParam<const char*> {};

TEST_P(ExtractedFromBar, IsTheProducedLaw) {
  const std::string softening = GetParam();
  const Bar bar(cohesive_bar(softening, 20.0));
  Extraction extraction(bar, 4.0 * Bar::ell);
  FractureRun sound(bar.mesh(), bar.model(), {}, {});
  extraction.add(sound.output(sound.initial_state()));
  bar.run({{0.99, 1}, {1.05, 6}, {4.3, 50}},
          [&](FractureRun& run, const FractureState& state) { extraction.add(run.output(state)); });

  const CohesiveLaw law = extraction.law();
  const CohesiveFigures figures = figures_of(extraction.record(), law);
  const double ft = bar.strength(), unit = Bar::Gc / ft;
  double largest = 0.0;
  std::vector<double> separation, traction;
  for (const ColumnSample& s : law.states) {
    separation.push_back(s.separation[0]);
    traction.push_back(s.traction[0]);
    if (s.separation[0] > 1e-6 * unit)
      largest = std::max(
          largest, std::abs(s.traction[0] / ft - produced_stress(softening_law(softening), s.separation[0] / unit)));
  }
  const double area = produced_area(softening_law(softening), ft, figures.final_separation);
  const std::vector<CohesiveFit> fits = fit_laws(separation, traction);
  report_row("extracted from a bar, " + softening + "; nearest to " + fits.front().law,
             {{"largest error/ft", largest},
              {"strength/ft", figures.strength / ft},
              {"area/closed form's", figures.normal_energy / area},
              {"area/Gc", figures.normal_energy / Bar::Gc},
              {"surface energy/Gc", figures.surface_energy / Bar::Gc},
              {"bulk's share of the separation", figures.bulk_separation / figures.final_separation},
              {"rms of the fit", fits.front().rms}});
  EXPECT_LE(largest, 0.005);
  EXPECT_NEAR(figures.strength, ft, 0.01 * ft);
  EXPECT_NEAR(figures.normal_energy, area, 1e-3 * area);
  EXPECT_LE(std::abs(figures.tangential_energy), 1e-9 * area);
  EXPECT_TRUE(std::isnan(figures.initial_stiffness)) << "a rigid rise";
  // Cornelissen's law is none of those that are fitted.
  EXPECT_EQ(fits.front().law, softening == "cornelissen" ? "hyperbolic" : softening);
  EXPECT_LE(fits.front().rms, softening == "cornelissen" ? 0.015 : 0.0015);
  if (softening == "linear") {
    EXPECT_NEAR(figures.surface_energy, Bar::Gc, 0.02 * Bar::Gc);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, ExtractedFromBar, ::testing::Values("linear", "exponential", "cornelissen"));

// ---- AT1 and AT2: equilibrium of a bar whose damage is that of the first integral.

FractureState state_with(const Bar& bar, const Profile& profile) {
  FractureState state = bar.sound_state();
  CellField<double> g(bar.mesh().n_cells());
  for (Index c = 0; c < bar.mesh().n_cells(); ++c) {
    state.damage[c] = profile.at(std::abs(bar.mesh().cell_centre[c][0]) / Bar::ell);
    g[c] = (1.0 - bar.model().residual_stiffness) * std::pow(1.0 - state.damage[c], 2) + bar.model().residual_stiffness;
  }
  const auto solution = solve_elastic(bar.mesh(), bar.model(), g, 1e-11);
  const auto pulled = bar.mesh().patch_index("xmax");
  const double scale = profile.stress * bar.area() / reactions(bar.mesh(), *solution)[pulled][0];
  state.displacement = solution->u;
  for (Vector& u : state.displacement) u *= scale;
  return state;
}

// Largest errors of the law and the strength, over the strength, and of the area, over Gc; the bulk's share of what
// the columns lengthen at the strength.
struct LawBounds {
  double law, strength, area, bulk;
};

void expect_profile_law(const std::string& name, const std::vector<Profile>& profiles, const LawBounds& bounds) {
  // The strain of a nearly broken bar is a peak of width 2 (1 - d)^1.5 ell.
  const Bar bar({.law = name,
                 .cells_per_length = 10,
                 .refinement = 11,
                 .length = 40.0,
                 .weakness = 0.0,
                 .pinned_ends = false,
                 .residual_stiffness = 1e-9});
  Extraction extraction(bar, 20.0 * Bar::ell);
  for (const Profile& profile : profiles) extraction.add(bar.output(state_with(bar, profile)));
  const CohesiveLaw law = extraction.law();
  ASSERT_EQ(law.states.size(), profiles.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const ColumnSample& state = law.states[i];
    // The stress was given: a separation that is wrong counts as the stress by which the law differs there.
    const double slope = bar.strength() / (Bar::Gc / bar.strength());
    largest = std::max({largest, std::abs(state.traction[0] - profiles[i].stress) / bar.strength(),
                        std::abs(state.separation[0] - profiles[i].separation) * slope / bar.strength()});
  }
  const CohesiveFigures figures = figures_of(extraction.record(), law);
  const double of_bulk = figures.bulk_separation / (figures.bulk_separation + figures.critical_separation);
  report_row("extracted from a bar, " + name, {{"largest error/strength", largest},
                                               {"strength/closed form's", figures.strength / bar.strength()},
                                               {"area/Gc", figures.normal_energy / Bar::Gc},
                                               {"surface energy/Gc", figures.surface_energy / Bar::Gc},
                                               {"bulk's share of 40 ell's separation at the strength", of_bulk}});
  EXPECT_LE(largest, bounds.law);
  EXPECT_NEAR(figures.strength, bar.strength(), bounds.strength * bar.strength());
  EXPECT_NEAR(figures.normal_energy, Bar::Gc, bounds.area * Bar::Gc);
  EXPECT_NEAR(of_bulk, bounds.bulk, 1e-6);
}

TEST(ExtractedFromProfiles, At1) {
  std::vector<Profile> profiles;
  for (int i = 0; i <= 40; ++i) profiles.push_back(at1_profile(0.005 + 0.895 * i / 40.0));
  expect_profile_law("AT1", profiles,
                     {.law = 1e-4, .strength = 0.01, .area = 0.02, .bulk = 0.0});  // neither end of the law is whole
}

TEST(ExtractedFromProfiles, At2) {
  // At the strength the bar is damaged evenly; just below it the profile is longer than the bar.
  std::vector<Profile> profiles{{.x = {0.0},
                                 .d = {0.25},
                                 .stress = at2_strength(Bar::E, Bar::Gc, Bar::ell),
                                 .separation = 0.0,
                                 .far_damage = 0.25}};
  for (int i = 0; i <= 40; ++i) profiles.push_back(at2_profile(0.2 * std::pow(0.0425, i / 40.0)));
  expect_profile_law("AT2", profiles, {.law = 1e-3, .strength = 1e-3, .area = 5e-3, .bulk = 1.0});
}

}  // namespace
}  // namespace pfdm::verification::this_file
