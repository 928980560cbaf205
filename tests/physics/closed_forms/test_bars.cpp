// The closed forms against the tables of literature.md 3.3 and 3.4, and against the energy they must release.

#include "physics/closed_forms/bars.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/physics/physics_checks.h"

namespace pfdm::this_file {
namespace {

constexpr double E = 75e6, Gc = 10.0, ell = 20e-6;

// Area under the polyline of a law that begins at its strength and no separation.
double area(const std::vector<BarPoint>& law, double strength) {
  double sum = 0.0;
  BarPoint last{.stress = strength, .separation = 0.0};
  for (const BarPoint& point : law) {
    sum += 0.5 * (point.stress + last.stress) * (point.separation - last.separation);
    last = point;
  }
  return sum;
}

TEST(Bars, StrengthsAreThePeaksOfTheHomogeneousResponse) {
  EXPECT_NEAR(at1_strength(E, Gc, ell), std::sqrt(3.0 * E * Gc / (8.0 * ell)), 1e-6);
  double peak = 0.0;
  for (double d = 0.0; d < 0.5; d += 1e-4) {
    // AT2: d = ell E eps^2 / (Gc + ell E eps^2)
    const double eps = std::sqrt(d * Gc / ((1.0 - d) * ell * E));
    peak = std::max(peak, (1.0 - d) * (1.0 - d) * E * eps);
  }
  EXPECT_NEAR(at2_strength(E, Gc, ell) / peak, 1.0, 1e-7);
}

TEST(Bars, At1FollowsItsTable) {
  const double table[][2] = {{.9849, .03844}, {.9234, .19154}, {.8433, .38119}, {.7593, .56860}, {.6708, .75327},
                             {.5774, .93450}, {.4781, 1.1112}, {.3721, 1.2816}, {.2582, 1.4423}, {.1348, 1.5852},
                             {.0690, 1.6425}, {.0141, 1.6697}, {.0014, 1.6677}};
  const double strength = at1_strength(E, Gc, ell);
  for (const auto& [stress, separation] : table) {
    // s of stress = sqrt2 s / sqrt(1 + s)
    const double s = 0.25 * (stress * stress + std::sqrt(std::pow(stress, 4) + 8.0 * stress * stress));
    const BarPoint point = at1_softening(E, Gc, ell, 1.0 - s);
    EXPECT_NEAR(point.stress / strength, stress, 1e-12);
    EXPECT_NEAR(point.separation * strength / Gc, separation, 6e-4) << "stress " << stress;
  }
}

TEST(Bars, At2FollowsItsTable) {
  const double table[][2] = {{.9995, .2581},  {.9949, .4413},  {.9853, .5625},  {.9346, .7716},  {.8314, .9175},
                             {.6375, 1.0275}, {.4225, 1.0755}, {.3033, 1.0835}, {.0972, 1.0643}, {.0308, 1.0417}};
  const double strength = at2_strength(E, Gc, ell);
  for (const auto& [stress, separation] : table) {
    double low = 1e-8, high = 0.25;  // the stress rises with the far field's damage
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (at2_softening(E, Gc, ell, middle).stress < stress * strength ? low : high) = middle;
    }
    // The stress is printed to four digits, which tells little about the separation near the peak.
    const double tolerance = stress > 0.99 ? 0.02 : 6e-4;
    EXPECT_NEAR(at2_softening(E, Gc, ell, low).separation * strength / Gc, separation, tolerance) << stress;
  }
}

TEST(Bars, At1ReleasesItsToughness) {
  std::vector<BarPoint> law;
  for (int i = 1; i < 4000; ++i)
    law.push_back(at1_softening(E, Gc, ell, std::sin(0.5 * std::numbers::pi * i / 4000.0)));
  EXPECT_NEAR(area(law, at1_strength(E, Gc, ell)) / Gc, 1.0, 1e-4);
}

TEST(Bars, At2ReleasesItsToughness) {
  std::vector<BarPoint> law;
  law.reserve(4000);
  for (int i = 0; i < 4000; ++i) law.push_back(at2_softening(E, Gc, ell, 0.25 * std::pow(1.0 - i / 4000.0, 2)));
  EXPECT_NEAR(area(law, at2_strength(E, Gc, ell)) / Gc, 1.0, 1e-4);
}

TEST(Bars, PfczmProducesTheLinearLawExactly) {
  constexpr double ft = 3e6, Gf = 120.0;
  for (double d = 0.05; d < 1.0; d += 0.05) {
    const BarPoint point = pfczm_softening(softening_law("linear"), Gf, ft, d);
    EXPECT_NEAR(point.stress / ft, 1.0 - d, 1e-12);
    EXPECT_NEAR(point.separation * ft / (2.0 * Gf), d, 1e-7);
  }
}

// literature.md 3.5: produced laws, w ft/Gf against sigma/ft.
TEST(Bars, PfczmFollowsItsTables) {
  struct Table {
    std::string_view law;
    std::vector<std::pair<double, double>> points;
  };
  const Table tables[] = {{"exponential",
                           {{.0320, .96848},
                            {.1660, .84704},
                            {.3486, .70554},
                            {.5518, .57542},
                            {1.0473, .34918},
                            {1.7629, .16896},
                            {3.2349, .03877}}},
                          {"cornelissen",
                           {{.0292, .9617},
                            {.1557, .8188},
                            {.3396, .6621},
                            {.5586, .5273},
                            {1.1386, .3124},
                            {2.0121, .1556},
                            {3.5086, .0429}}}};
  for (const Table& table : tables)
    for (const auto& [separation, stress] : table.points) {
      double low = 1e-9, high = 1.0 - 1e-9;
      for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (pfczm_softening(softening_law(table.law), Gc, 1e6, middle).stress > stress * 1e6 ? low : high) = middle;
      }
      EXPECT_NEAR(pfczm_softening(softening_law(table.law), Gc, 1e6, low).separation * 1e6 / Gc, separation, 6e-4)
          << table.law << " at " << stress;
    }
}

TEST(Bars, PfczmReleasesItsToughness) {
  for (const SofteningLaw& softening : softening_laws()) {
    std::vector<BarPoint> law;
    for (int i = 1; i < 400; ++i)
      law.push_back(pfczm_softening(softening, Gc, 1e6, 1.0 - std::pow(1.0 - i / 400.0, 2)));
    EXPECT_NEAR(area(law, 1e6) / Gc, 1.0, 3e-3) << softening.name;
  }
}

// literature.md 3.3 and 3.4: what a bar opens by when it has just broken.
TEST(Bars, SeparationWhenBroken) {
  const double at1 = at1_softening(E, Gc, ell, 1.0 - 1e-4).separation * at1_strength(E, Gc, ell) / Gc;
  EXPECT_NEAR(at1, 3.0 * std::numbers::sqrt2 * std::numbers::pi / 8.0, 2e-3);
  const double at2 = at2_softening(E, Gc, ell, 1e-9).separation / (std::numbers::pi * std::sqrt(Gc * ell / E));
  EXPECT_NEAR(at2, 1.0, 2e-3);
}

// Minimum of h/ell alpha(d_0) + ... over a uniform row of cells whose middle one is broken (literature.md 3.6).
TEST(Bars, DiscreteToughnessIsTheMinimumOverARowOfCells) {
  for (const double h : {0.5, 0.25, 0.1}) {
    // AT2: d_j = r^j with r + 1/r = 2 + h^2, in units of ell and Gc.
    const double r = 1.0 + 0.5 * h * h - h * std::sqrt(1.0 + 0.25 * h * h);
    double at2 = 0.5 * h;
    for (int j = 1; j < 2000; ++j) at2 += h * std::pow(r, 2 * j) + std::pow(std::pow(r, j) - std::pow(r, j - 1), 2) / h;
    EXPECT_NEAR(at2_discrete_toughness(h * ell, ell), at2, 1e-10) << h;
    // AT1: a parabola that vanishes after about 2/h cells a side.
    const int n = static_cast<int>(std::lround(2.0 / h));
    double best = 1e300;
    for (int cells = n - 1; cells <= n + 1; ++cells) {
      // d'' = 1/2 with d_0 = 1, d_cells = 0: a parabola through both.
      const double length = cells * h, slope_at_0 = -1.0 / length - 0.25 * length;
      double sum = 0.375 * h;
      double before = 1.0;
      for (int j = 1; j <= cells; ++j) {
        const double d = std::max(0.0, 1.0 + slope_at_0 * j * h + 0.25 * j * h * j * h);
        sum += 0.75 * (h * d + std::pow(d - before, 2) / h);
        before = d;
      }
      best = std::min(best, sum);
    }
    EXPECT_NEAR(at1_discrete_toughness(h * ell, ell), best, 1e-10) << h;
  }
}

}  // namespace
}  // namespace pfdm::this_file
