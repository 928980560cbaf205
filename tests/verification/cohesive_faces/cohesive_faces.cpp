// Cohesive faces without thickness, between two blocks: each law, loaded, unloaded and closed, against springs in
// series; mixed modes; sliding with friction.

#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/cohesive_faces/pulled_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::pulled_blocks;

class TwoBlocks : public testing::TestWithParam<TractionSeparationLaw> {};

// Displacement and traction of blocks and law in series: u = delta + 2 L T / E.
TEST_P(TwoBlocks, AreTheLawInSeriesWithThem) {
  const InterfaceLaw law = law_of(GetParam());
  const double length = toughness / strength, compliance = 2.0 * edge / 1e9;
  const auto traction = [&](double opening) {
    return law.respond(glued, Vector::UnitX(), opening * Vector::UnitX(), {}).traction.x();
  };
  std::vector<Vector> path{Vector::Zero()};
  std::vector<double> opening{0.0}, expected{0.0};
  for (const double x : {0.001, 0.05, 0.3, 0.8, 1.5}) {
    opening.push_back(x * length), expected.push_back(traction(x * length));
    path.emplace_back((x * length + compliance * expected.back()) * Vector::UnitX());
  }
  for (const double part : {0.5, 1e-9}) {  // unload to the origin
    opening.push_back(part * opening[5]), expected.push_back(part * expected[5]);
    path.emplace_back(part * path[5]);
  }
  const double pressure = 1e5;  // close
  opening.push_back(-pressure / law.initial_stiffness(glued)), expected.push_back(-pressure);
  path.emplace_back((opening.back() - compliance * pressure) * Vector::UnitX());
  const std::vector<Point> points = pull(law, path);
  ASSERT_EQ(points.size(), path.size());
  double of_traction = 0.0, of_separation = 0.0;  // largest errors
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_NEAR(points[i].traction.x(), expected[i], 1e-12 * strength) << i;
    EXPECT_NEAR(points[i].separation.x(), opening[i], 1e-12 * length) << i;
    of_traction = std::max(of_traction, std::abs(points[i].traction.x() - expected[i]) / strength);
    of_separation = std::max(of_separation, std::abs(points[i].separation.x() - opening[i]) / length);
  }
  report_row("two blocks", {{"traction", of_traction}, {"separation", of_separation}});
  const double dissipated = law.respond(glued, Vector::UnitX(), opening[5] * Vector::UnitX(), {}).history.dissipated;
  EXPECT_NEAR(points.back().energy.interface_dissipation, dissipated * edge * edge, 1e-10 * toughness * edge * edge);
}

INSTANTIATE_TEST_SUITE_P(Laws, TwoBlocks, testing::ValuesIn(traction_separation_laws()),
                         [](const auto& test) { return std::string(test.param.name); });

// Opened and sheared in changing proportion, unloaded, closed and slid to and fro.
class MixedPath : public testing::TestWithParam<std::string_view> {};

TEST_P(MixedPath, IsTheLaws) {
  InterfaceLaw law = law_of(find_by_name(traction_separation_laws(), "linear", "law"), GetParam());
  law.friction = 0.4;
  law.exponent = law.depends_on_mode() ? 1.8 : 1.0;
  law.shear_ratio = law.depends_on_mode() ? 1.0 : 0.7;
  const double length = toughness / strength, K = law.initial_stiffness(glued);
  const std::vector<Vector> separation{Vector::Zero(),
                                       length * Vector(0.1, 0.05, 0.0),
                                       length * Vector(0.3, 0.4, 0.1),
                                       length * Vector(0.05, 0.1, 0.05),
                                       length * Vector(0.2, 0.7, -0.1),
                                       Vector(-1e5 / K, 0.8 * length, 0.0),
                                       Vector(-1e5 / K, 0.9 * length, 0.1 * length),
                                       Vector(-2e5 / K, 0.5 * length, 0.0)};
  std::vector<Vector> traction;
  InterfaceHistory history;
  for (const Vector& delta : separation) {
    const InterfaceResponse response = law.respond(glued, Vector::UnitX(), delta, history);
    traction.push_back(response.traction);
    history = response.history;
  }
  const std::vector<Point> points = lead(law, separation, traction);
  ASSERT_EQ(points.size(), separation.size());
  double of_traction = 0.0, of_separation = 0.0;  // largest errors
  for (std::size_t i = 0; i < separation.size(); ++i) {
    const double wrong = (points[i].traction - traction[i]).norm() / strength;
    const double aside = (points[i].separation - separation[i]).norm() / length;
    EXPECT_LT(wrong, 3e-12) << i;
    EXPECT_LT(aside, 1e-12) << i;
    of_traction = std::max(of_traction, wrong), of_separation = std::max(of_separation, aside);
  }
  report_row("mixed path", {{"traction", of_traction}, {"separation", of_separation}});
  EXPECT_NEAR(points.back().energy.interface_dissipation, (history.dissipated + history.rubbed) * edge * edge,
              1e-10 * toughness * edge * edge);
}

INSTANTIATE_TEST_SUITE_P(Rules, MixedPath,
                         testing::Values("camacho_ortiz", "equal_stiffness", "benzeggagh_kenane", "power_law"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace pfdm::verification::this_file
