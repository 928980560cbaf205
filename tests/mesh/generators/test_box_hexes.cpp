#include <set>

#include "mesh/generators/box_hexes.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"

namespace pfdm::this_file {
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

// 4 x 4 x 2 cells of unit size; a slit in the plane y = 2.
BoxHexesSettings slit_block(const Vector& lower, const Vector& upper) {
  BoxHexesSettings settings;
  settings.axes = {{{{4.0, 4, 1.0}}, {{4.0, 4, 1.0}}, {{2.0, 2, 1.0}}}};
  settings.slits = {{"notch", lower, upper}};
  return settings;
}

TEST(BoxHexes, ASlitPartsTheCellsOnItsSides) {
  const Mesh mesh = make_box_hexes(slit_block({-9.0, 2.0, -9.0}, {2.0, 2.0, 9.0}));
  expect_sound(mesh);
  const Patch& notch = mesh.patch("notch");
  EXPECT_EQ(notch.n_faces, 8);
  EXPECT_EQ(mesh.n_interior_faces(), 3 * 8 + 3 * 8 + 16 - 4);
  EXPECT_NEAR(patch_area(mesh, "notch").norm(), 0.0, 1e-13);
  EXPECT_EQ(mesh.points.size(), 75U + 6U);  // x = 0 and 1; the front x = 2 holds together
  for (Index f = notch.first_face; f < notch.first_face + notch.n_faces; ++f) {
    EXPECT_EQ(mesh.face_centre[f][1], 2.0);
    EXPECT_LT(mesh.face_centre[f][0], 2.0);
    EXPECT_GT(mesh.face_area[f][1] * (2.0 - mesh.cell_centre[mesh.owner[f]][1]), 0.0);
  }
}

TEST(BoxHexes, ASlitWithinTheBoxHasAFrontAllAround) {
  BoxHexesSettings settings = slit_block({1.0, 2.0, 0.0}, {3.0, 2.0, 2.0});
  const Mesh through = make_box_hexes(settings);
  EXPECT_EQ(through.patch("notch").n_faces, 8);
  EXPECT_EQ(through.points.size(), 75U + 3U);
  settings.axes[2] = {{6.0, 6, 1.0}};
  settings.slits[0].lower[2] = 2.0;
  settings.slits[0].upper[2] = 4.0;
  const Mesh embedded = make_box_hexes(settings);
  expect_sound(embedded);
  EXPECT_EQ(embedded.patch("notch").n_faces, 8);
  EXPECT_EQ(embedded.points.size(), 175U + 1U);
}

TEST(BoxHexes, SlitsOfTwoDirectionsStandBesideEachOther) {
  BoxHexesSettings settings = slit_block({0.0, 1.0, 0.0}, {2.0, 1.0, 2.0});
  settings.slits.push_back({"other", {3.0, 2.0, 0.0}, {3.0, 4.0, 2.0}});
  const Mesh mesh = make_box_hexes(settings);
  expect_sound(mesh);
  EXPECT_EQ(mesh.patch("notch").n_faces, 8);
  EXPECT_EQ(mesh.patch("other").n_faces, 8);
}

TEST(BoxHexes, BadSlitsAreRefused) {
  const auto message = [](const Vector& lower, const Vector& upper) {
    return message_of<InputError>([&] { make_box_hexes(slit_block(lower, upper)); });
  };
  EXPECT_THAT(message({0, 1.9, 0}, {2, 1.9, 2}), HasSubstr("y = 1.9 m is not a plane of the grid"));
  EXPECT_THAT(message({0, 2, 0}, {1.5, 2, 2}), HasSubstr("x = 1.5 m is not a plane of the grid"));
  EXPECT_THAT(message({0, 1, 0}, {2, 2, 2}), HasSubstr("exactly one axis"));
  EXPECT_THAT(message({2, 2, 0}, {0, 2, 2}), HasSubstr("above its upper one along x"));
  EXPECT_THAT(message({0, 0, 0}, {2, 0, 2}), HasSubstr("surface of the box"));
  EXPECT_THAT(message({0, 9, 0}, {2, 9, 2}), HasSubstr("surface of the box"));
  EXPECT_THAT(message({1, 2, 0}, {2, 2, 2}), HasSubstr("too narrow"));
  BoxHexesSettings settings = slit_block({0, 2, 0}, {2, 2, 2});
  settings.slits.push_back({"other", {2, 0, 0}, {2, 2, 2}});
  EXPECT_THAT(message_of<InputError>([&] { make_box_hexes(settings); }), HasSubstr("\"other\" meets another"));
}

TEST(BoxHexes, AHoleLeavesItsCellsOutAndIsAPatch) {
  BoxHexesSettings settings = slit_block({0, 1, 0}, {1, 1, 2});
  settings.slits.clear();
  settings.holes = {{"corner", {-9, -9, -9}, {2, 2, 9}}};  // an L
  const Mesh mesh = make_box_hexes(settings);
  expect_sound(mesh);
  EXPECT_EQ(mesh.n_cells(), 32 - 8);
  EXPECT_EQ(mesh.patch("corner").n_faces, 8);
  EXPECT_NEAR((patch_area(mesh, "corner") - Vector(-4.0, -4.0, 0.0)).norm(), 0.0, 1e-13);
  EXPECT_EQ(mesh.patch("xmin").n_faces, 4);
  EXPECT_EQ(mesh.patch("zmin").n_faces, 12);
  EXPECT_EQ(mesh.points.size(), 75U - 3U * 4U);
}

TEST(BoxHexes, AHoleWithinTheBoxMeetsASlit) {
  BoxHexesSettings settings = slit_block({0, 2, 0}, {2, 2, 2});
  settings.holes = {{"hole", {2, 1, 0}, {3, 3, 2}}};
  const Mesh mesh = make_box_hexes(settings);
  expect_sound(mesh);
  EXPECT_EQ(mesh.patch("hole").n_faces, 2 * 6);
  EXPECT_EQ(mesh.patch("notch").n_faces, 8);
  EXPECT_NEAR(patch_area(mesh, "hole").norm(), 0.0, 1e-13);
}

TEST(BoxHexes, PartsOfASideArePatches) {
  BoxHexesSettings settings = slit_block({0, 2, 0}, {2, 2, 2});
  settings.patches = {{"support", {0, 0, -9}, {1, 0, 9}}, {"loaded", {3, 4, 0}, {4, 4, 1}}};
  const Mesh mesh = make_box_hexes(settings);
  expect_sound(mesh);
  EXPECT_EQ(mesh.patch("support").n_faces, 2);
  EXPECT_EQ(mesh.patch("loaded").n_faces, 1);
  EXPECT_EQ(mesh.patch("ymin").n_faces, 6);
  EXPECT_EQ(mesh.patch("ymax").n_faces, 7);
  EXPECT_NEAR((patch_area(mesh, "support") - Vector(0.0, -2.0, 0.0)).norm(), 0.0, 1e-13);
}

TEST(BoxHexes, BadHolesAndPatchesAreRefused) {
  BoxHexesSettings settings = slit_block({0, 2, 0}, {2, 2, 2});
  settings.holes = {{"hole", {1.6, 1, 0}, {1.9, 2, 2}}};
  EXPECT_THAT(message_of<InputError>([&] { make_box_hexes(settings); }), HasSubstr("hole \"hole\""));
  settings.holes = {{"hole", {-9, -9, -9}, {9, 9, 9}}};
  EXPECT_THAT(message_of<InputError>([&] { make_box_hexes(settings); }), HasSubstr("no cells"));
  settings.holes.clear();
  settings.patches = {{"support", {1, 0.6, 0.4}, {3, 1.6, 1.6}}};
  EXPECT_THAT(message_of<InputError>([&] { make_box_hexes(settings); }), HasSubstr("patch \"support\""));
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
  settings.regions.insert(settings.regions.begin(), {"notch", {-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}});
  EXPECT_THAT(message_of<InputError>([&] { make_box_hexes(settings); }), HasSubstr("\"notch\", number 2 of the list"));
}

}  // namespace
}  // namespace pfdm::this_file
