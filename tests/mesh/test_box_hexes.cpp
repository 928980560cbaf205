#include <set>

#include "mesh/box_hexes.h"
#include "mesh_checks.h"
#include "physics/error.h"

namespace pfdm {
namespace {

using ::testing::HasSubstr;

BoxHexesSettings bar() {
  BoxHexesSettings settings;
  settings.origin = {-1.0, 2.0, 0.5};
  settings.axes = {{{{3.0, 6, 0.25}, {1.0, 8, 1.0}, {3.0, 6, 4.0}}, {{2.0, 5, 1.0}}, {{0.5, 3, 1.0}}}};
  return settings;
}

TEST(BoxHexes, FillsTheBoxToRounding) {
  const Mesh mesh = make_box_hexes(bar());
  expect_sound(mesh);
  EXPECT_EQ(mesh.n_cells(), 20 * 5 * 3);
  EXPECT_NEAR(total_volume(mesh), 7.0, 7.0e-12);
  EXPECT_NEAR((patch_area(mesh, "xmax") - Vector(1.0, 0, 0)).norm(), 0.0, 1e-13);
  EXPECT_NEAR((patch_area(mesh, "ymin") - Vector(0, -3.5, 0)).norm(), 0.0, 1e-13);
  EXPECT_NEAR((patch_area(mesh, "zmax") - Vector(0, 0, 14.0)).norm(), 0.0, 1e-13);
  EXPECT_EQ(mesh.patches.size(), 6U);
}

TEST(BoxHexes, WidthsGrowByTheRatio) {
  const Mesh mesh = make_box_hexes(bar());
  std::set<double> nodes;
  for (const Vector& x : mesh.points) nodes.insert(x[0]);
  ASSERT_EQ(nodes.size(), 21U);
  std::vector<double> widths;
  for (auto a = nodes.begin(), b = std::next(a); b != nodes.end(); ++a, ++b) widths.push_back(*b - *a);
  EXPECT_NEAR(widths[5] / widths[0], 0.25, 1e-12);
  EXPECT_NEAR(widths[1] / widths[0], widths[4] / widths[3], 1e-12);
  EXPECT_NEAR(widths[6], 0.125, 1e-12);
  EXPECT_NEAR(widths[19] / widths[14], 4.0, 1e-12);
  EXPECT_EQ(*nodes.begin(), -1.0);
  EXPECT_EQ(*nodes.rbegin(), 6.0);
}

TEST(BoxHexes, LaterRegionsWin) {
  BoxHexesSettings settings = bar();
  settings.regions = {{"middle", {2.0, 2.0, 0.0}, {3.0, 4.0, 1.0}}, {"core", {2.25, 2.0, 0.0}, {2.75, 4.0, 1.0}}};
  const Mesh mesh = make_box_hexes(settings);
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"body", "middle", "core"}));
  EXPECT_NEAR(region_volume(mesh, "core"), 0.5, 1e-12);
  EXPECT_NEAR(region_volume(mesh, "middle"), 0.5, 1e-12);
  EXPECT_NEAR(region_volume(mesh, "body"), 6.0, 1e-12);
}

TEST(BoxHexes, BaseRegionVanishesWhereNoCellIsLeft) {
  BoxHexesSettings settings = bar();
  settings.regions = {{"all", {-9, -9, -9}, {9, 9, 9}}};
  EXPECT_EQ(make_box_hexes(settings).region_names, std::vector<std::string>{"all"});
}

TEST(BoxHexes, OrderKeepsNeighboursClose) {
  BoxHexesSettings settings;
  settings.axes = {{{{1.0, 8, 1.0}}, {{9.0, 80, 1.0}}, {{1.0, 8, 1.0}}}};
  EXPECT_LT(bandwidth(make_box_hexes(settings)), 130);  // a layer has 64 cells
}

TEST(BoxHexes, BadInputIsRefused) {
  BoxHexesSettings settings = bar();
  settings.axes[1] = {{-2.0, 5, 1.0}};
  EXPECT_THAT(message_of<InputError>([&] { make_box_hexes(settings); }), HasSubstr("along y"));
  settings = bar();
  settings.axes[2].clear();
  EXPECT_THAT(message_of<InputError>([&] { make_box_hexes(settings); }), HasSubstr("along z"));
  settings = bar();
  settings.axes[0][1].n = 0;
  EXPECT_THAT(message_of<InputError>([&] { make_box_hexes(settings); }), HasSubstr("0 cells"));
  settings = bar();
  settings.axes[0][0].ratio = 0.0;
  EXPECT_THAT(message_of<InputError>([&] { make_box_hexes(settings); }), HasSubstr("ratio 0"));
  settings = bar();
  settings.regions = {{"notch", {100, 0, 0}, {101, 1, 1}}};
  EXPECT_THAT(message_of<InputError>([&] { make_box_hexes(settings); }), HasSubstr("\"notch\""));
}

}  // namespace
}  // namespace pfdm
