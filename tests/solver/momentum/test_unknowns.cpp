// Where displacement unknowns live, and what is refused.

#include "solver/momentum/body/unknowns.h"

#include "mesh/generators/sphere_sector.h"
#include "physics/error.h"
#include "tests/physics/physics_checks.h"
#include "tests/solver/solver_checks.h"

#include <numbers>

namespace pfdm::this_file {
namespace {

using Kind = BoundaryCondition::Kind;
using ::testing::AllOf;
using ::testing::HasSubstr;

FractureModel model_of(const Mesh& mesh, std::vector<BoundaryCondition> boundary) {
  FractureModel model;
  for (std::size_t r = 0; r < mesh.region_names.size(); ++r)
    model.regions.push_back({.elasticity = from_young_poisson(75e6 * double(r + 1), 0.3)});
  model.boundary = std::move(boundary);
  return model;
}

std::string refusal(const Mesh& mesh, std::vector<BoundaryCondition> boundary) {
  return message_of<InputError>([&] { place_unknowns(mesh, elastic_body(model_of(mesh, std::move(boundary)))); });
}

TEST(Unknowns, CellsInterfacesAndBoundaryCarryNodes) {
  const Mesh mesh = box(4, 3, 2, Vector::Ones(), 1.0, {{"right", {0.5, -1.0, -1.0}, {2.0, 2.0, 2.0}}});
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model_of(mesh, {clamped("xmin")})));
  const Index interface_faces = 3 * 2, boundary_faces = mesh.n_faces() - mesh.n_interior_faces();
  EXPECT_EQ(unknowns.n_nodes(), 24 + interface_faces + boundary_faces);
  for (std::size_t k = 0; k < unknowns.face_of_node.size(); ++k)
    EXPECT_EQ(unknowns.node_of_face[unknowns.face_of_node[k]], mesh.n_cells() + static_cast<Index>(k));
}

TEST(Unknowns, EqualMaterialsShareAZone) {
  const Mesh mesh = box(4, 3, 2, Vector::Ones(), 1.0, {{"right", {0.5, -1.0, -1.0}, {2.0, 2.0, 2.0}}});
  FractureModel model = model_of(mesh, {clamped("xmin")});
  model.regions[1] = model.regions[0];
  model.regions[1].Gc = 7.0;  // toughness does not matter to the momentum balance
  EXPECT_EQ(place_unknowns(mesh, elastic_body(model)).n_nodes(), 24 + mesh.n_faces() - mesh.n_interior_faces());
}

TEST(Unknowns, NearlyIncompressibleCellsCarryPressures) {
  const Mesh mesh = box(4, 3, 2, Vector::Ones(), 1.0, {{"right", {0.5, -1.0, -1.0}, {2.0, 2.0, 2.0}}});
  FractureModel model = model_of(mesh, {clamped("xmin")});
  EXPECT_TRUE(place_unknowns(mesh, elastic_body(model)).pressure_cells.empty());
  model.regions[1].elasticity = from_young_poisson(75e6, 0.4999);
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  EXPECT_EQ(unknowns.n_unknowns(), unknowns.n_nodes() + 12);
  for (const Index c : unknowns.pressure_cells) EXPECT_GT(mesh.cell_centre[c][0], 0.5);
  model.split = energy_split("spectral");  // whose stiffness is not isotropic
  EXPECT_TRUE(place_unknowns(mesh, elastic_body(model)).pressure_cells.empty());
}

TEST(Unknowns, FreeDirectionsAreThoseNotPrescribed) {
  const Mesh mesh = box(2, 2, 2);
  const Unknowns unknowns = place_unknowns(
      mesh, elastic_body(model_of(mesh, {clamped("xmin"), held_along("xmax", 1), of_kind("zmin", Kind::symmetry)})));
  const auto directions_on = [&](const std::string& patch) {
    return unknowns.free_directions[unknowns.node_of_face[mesh.patch(patch).first_face] - mesh.n_cells()];
  };
  EXPECT_EQ(directions_on("xmin"), Tensor::Zero().eval());
  EXPECT_EQ(directions_on("xmax"), Tensor(Vector(1, 0, 1).asDiagonal()));
  EXPECT_TRUE(directions_on("zmin").isApprox(Tensor(Vector(1, 1, 0).asDiagonal())));
  EXPECT_EQ(directions_on("ymax"), Tensor::Identity().eval());
}

TEST(Unknowns, PatchesThatAreNotThereAreAnsweredWithThoseThereAre) {
  EXPECT_THAT(refusal(box(2, 2, 2), {clamped("bottom")}), AllOf(HasSubstr("bottom"), HasSubstr("zmin")));
}

TEST(Unknowns, TwoConditionsOnAPatchAreRefused) {
  EXPECT_THAT(refusal(box(2, 2, 2), {clamped("zmin"), clamped("xmin"), clamped("zmin")}),
              AllOf(HasSubstr("\"zmin\""), HasSubstr("two")));
}

TEST(Unknowns, CurvedSymmetryIsRefused) {
  CellSoup soup;  // a wedge whose slanted and upright sides are one patch
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  soup.region_names = {"body"};
  soup.add_cell(CellShape::wedge, std::vector<Index>{0, 2, 1, 3, 5, 4}, 0);
  const Mesh mesh = assemble_mesh(
      soup, {{"side", [](const Vector&, const Vector& n, std::span<const Index>) { return std::abs(n[2]) < 0.5; }}});
  EXPECT_THAT(refusal(mesh, {of_kind("side", Kind::symmetry)}), AllOf(HasSubstr("\"side\""), HasSubstr("plane")));
}

TEST(Unknowns, BodiesThatCanMoveAreRefused) {
  const Mesh mesh = box(3, 3, 3);
  EXPECT_THAT(refusal(mesh, {}), HasSubstr("rigid"));
  EXPECT_THAT(refusal(mesh, {held_along("zmin", 2)}), HasSubstr("rigid"));
  EXPECT_THAT(refusal(mesh, {of_kind("xmin", Kind::symmetry), of_kind("ymin", Kind::symmetry)}), HasSubstr("rigid"));
  // Held along each axis at one side, but by tangential components only: it can turn about z.
  EXPECT_THAT(refusal(mesh, {held_along("zmin", 2), held_along("zmax", 2)}), HasSubstr("rigid"));
}

TEST(Unknowns, BodiesThatAreHeldAreAccepted) {
  const Mesh mesh = box(3, 3, 3);
  EXPECT_NO_THROW(place_unknowns(mesh, elastic_body(model_of(mesh, {clamped("ymax")}))));
  EXPECT_NO_THROW(place_unknowns(
      mesh, elastic_body(model_of(mesh, {of_kind("xmin", Kind::symmetry), of_kind("ymin", Kind::symmetry),
                                         of_kind("zmin", Kind::symmetry)}))));
  EXPECT_NO_THROW(place_unknowns(
      mesh, elastic_body(model_of(mesh, {held_along("xmin", 0), held_along("ymin", 1), held_along("zmax", 2)}))));
}

Mesh cut_box() {
  BoxHexesSettings settings;
  settings.axes = {{{{1.0, 4, 1.0}}, {{1.0, 2, 1.0}}, {{1.0, 2, 1.0}}}};
  settings.regions = {{"right", {0.5, -1.0, -1.0}, {2.0, 2.0, 2.0}}};
  settings.slits = {{"cut", {0.5, 0.0, 0.0}, {0.5, 1.0, 1.0}}};
  return make_box_hexes(settings);
}

TEST(Unknowns, EveryPartOfTheMeshMustBeHeld) {
  const Mesh mesh = cut_box();
  EXPECT_THAT(refusal(mesh, {clamped("xmin")}),
              AllOf(HasSubstr("2 parts"), HasSubstr("(750, 500, 500) mm"), HasSubstr("region \"right\", 8 of 16"),
                    HasSubstr("along x and y and z")));
  EXPECT_THAT(refusal(mesh, {clamped("xmin"), held_along("xmax", 0)}), HasSubstr("along y and z"));
  EXPECT_THAT(refusal(mesh, {of_kind("ymin", Kind::symmetry), of_kind("zmin", Kind::symmetry), clamped("xmin")}),
              AllOf(HasSubstr("\"right\""), HasSubstr("along x;")));
  EXPECT_NO_THROW(place_unknowns(mesh, elastic_body(model_of(mesh, {clamped("xmin"), clamped("xmax")}))));
}

TEST(Unknowns, MotionsThatAreFreeAreNamed) {
  const Mesh mesh = box(3, 3, 3);
  EXPECT_THAT(refusal(mesh, {of_kind("xmin", Kind::symmetry), of_kind("ymin", Kind::symmetry)}),
              HasSubstr("the body can still move rigidly: it can move along z;"));
  // One face of many holds no rotation.
  BoxHexesSettings pinned;
  pinned.axes = {{{{1.0, 3, 1.0}}, {{1.0, 3, 1.0}}, {{1.0, 3, 1.0}}}};
  pinned.patches = {{"pin", {0.4, 0.4, -1.0}, {0.6, 0.6, 0.01}}};
  EXPECT_THAT(refusal(make_box_hexes(pinned), {clamped("pin")}),
              HasSubstr("it can rotate about x and y and z through"));
}

// A body far from the origin and very small is judged like one at the origin.
TEST(Unknowns, PlaceAndSizeDoNotMatter) {
  BoxHexesSettings settings;
  settings.origin = {1.0, -2.0, 3.0};
  settings.axes = {{{{50e-6, 10, 1.0}}, {{10e-6, 2, 1.0}}, {{10e-6, 2, 1.0}}}};
  const Mesh mesh = make_box_hexes(settings);
  EXPECT_NO_THROW(place_unknowns(mesh, elastic_body(model_of(mesh, {clamped("xmin")}))));
  EXPECT_THAT(refusal(mesh, {held_along("xmin", 0)}), HasSubstr("rigid"));
}

TEST(Unknowns, PlaneMeshesNeedOnlyBeHeldInTheirPlane) {
  const Mesh mesh = box(6, 2, 1);
  const auto with = [](std::vector<BoundaryCondition> others) {
    others.push_back(of_kind("zmin", Kind::plane));
    others.push_back(of_kind("zmax", Kind::plane));
    return others;
  };
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model_of(mesh, with({clamped("xmin")}))));
  EXPECT_NEAR(std::abs(unknowns.plane_normal[2]), 1.0, 1e-12);
  for (Index f = mesh.patch("zmin").first_face; f < mesh.patch("zmin").first_face + 12; ++f)
    EXPECT_EQ(unknowns.node_of_face[f], -1);
  EXPECT_NO_THROW(place_unknowns(
      mesh, elastic_body(model_of(mesh, with({held_along("xmin", 0), of_kind("ymin", Kind::symmetry)})))));
  EXPECT_THAT(refusal(mesh, with({held_along("xmin", 0)})), HasSubstr("rigid"));
  EXPECT_THAT(refusal(mesh, with({of_kind("ymin", Kind::symmetry)})), HasSubstr("rigid"));
}

// Turning about the bar's own axis is not a motion in the plane: nothing needs to resist it.
TEST(Unknowns, OneCellWideBarsBetweenPlanesAreAccepted) {
  const Mesh mesh = box(10, 1, 1, {10.0, 1.0, 1.0});
  EXPECT_NO_THROW(place_unknowns(
      mesh, elastic_body(model_of(
                mesh, {held_along("xmin", 0), held_along("xmax", 0), of_kind("ymin", Kind::symmetry),
                       of_kind("ymax", Kind::symmetry), of_kind("zmin", Kind::plane), of_kind("zmax", Kind::plane)}))));
}

// The face centres where displacements are held lie in planes through an axis, about which the unknowns can turn: the
// faces on the planes hold that.
TEST(Unknowns, OneCellWideBarsAndSingleCellsAreHeldByTheirPlanes) {
  const auto holds = [](const Mesh& mesh, std::vector<BoundaryCondition> boundary) {
    return place_unknowns(mesh, elastic_body(model_of(mesh, std::move(boundary)))).spin_holds.size();
  };
  const Mesh bar = box(10, 1, 1, {10.0, 1.0, 1.0}), cell = box(1, 1, 1);
  EXPECT_GT(holds(bar, {clamped("xmin"), clamped("xmax")}), 0u);
  EXPECT_GT(
      holds(bar, {clamped("xmin"), clamped("xmax"), of_kind("ymin", Kind::symmetry), of_kind("ymax", Kind::symmetry),
                  of_kind("zmin", Kind::symmetry), of_kind("zmax", Kind::symmetry)}),
      0u);
  EXPECT_GT(holds(cell, {of_kind("xmin", Kind::symmetry), of_kind("ymin", Kind::symmetry),
                         of_kind("zmin", Kind::symmetry), held_along("ymax", 1)}),
            0u);
  EXPECT_EQ(holds(box(10, 2, 2), {clamped("xmin")}), 0u);
  EXPECT_THAT(refusal(cell, {of_kind("xmin", Kind::symmetry), of_kind("ymin", Kind::symmetry)}),
              HasSubstr("it can move along z"));
}

TEST(Unknowns, PlatesAreInPlaneStrainOrInPlaneStress) {
  const auto between = [](Kind front, Kind back) {
    return std::vector{clamped("xmin"), of_kind("zmin", front), of_kind("zmax", back)};
  };
  const Mesh mesh = box(6, 2, 1);
  EXPECT_FALSE(place_unknowns(mesh, elastic_body(model_of(mesh, between(Kind::plane, Kind::plane)))).plane_stress);
  const Unknowns unknowns =
      place_unknowns(mesh, elastic_body(model_of(mesh, between(Kind::plane_stress, Kind::plane_stress))));
  EXPECT_TRUE(unknowns.plane_stress);
  EXPECT_EQ(unknowns.node_of_face[mesh.patch("zmax").first_face], -1);
  EXPECT_THAT(refusal(mesh, between(Kind::plane, Kind::plane_stress)),
              AllOf(HasSubstr("\"zmax\""), HasSubstr("one type")));
}

TEST(Unknowns, PlatesNeedAFrontAndABack) {
  const auto words = AllOf(HasSubstr("both sides"), HasSubstr("one of them"), HasSubstr("\"symmetry\""));
  for (const Kind kind : {Kind::plane, Kind::plane_stress}) {
    EXPECT_THAT(refusal(box(6, 2, 1), {clamped("xmin"), of_kind("zmin", kind)}), words);
    EXPECT_THAT(refusal(box(6, 2, 2), {clamped("xmin"), of_kind("zmin", kind), of_kind("zmax", kind)}), words);
  }
}

TEST(Unknowns, SectorsNeedOnlyBeHeldAlongTheirAxis) {
  const Mesh mesh = make_sphere_sector(
      {.azimuth = 0.1, .shells = {{{1.0, 3, 1.0}, "body"}}, .polar = {{0.5 * std::numbers::pi, 4, 1.0}}});
  const auto with = [](std::vector<BoundaryCondition> others) {
    others.push_back(of_kind("front", Kind::axisymmetric));
    others.push_back(of_kind("back", Kind::axisymmetric));
    return others;
  };
  const Unknowns unknowns =
      place_unknowns(mesh, elastic_body(model_of(mesh, with({of_kind("equator", Kind::symmetry)}))));
  EXPECT_NEAR(std::abs(unknowns.plane_normal.y()), 1.0, 1e-12);
  EXPECT_NEAR(unknowns.radial.x(), 1.0, 1e-12);
  EXPECT_THAT(refusal(mesh, with({})), HasSubstr("rigid"));
  EXPECT_THAT(refusal(mesh, {of_kind("front", Kind::axisymmetric), of_kind("equator", Kind::symmetry)}),
              HasSubstr("two axisymmetric patches"));
  EXPECT_THAT(refusal(mesh, with({of_kind("equator", Kind::axisymmetric)})), HasSubstr("through the axis z"));
}

// Plane strain is across one direction.
TEST(Unknowns, PlanePatchesOfTwoDirectionsAreRefused) {
  EXPECT_THAT(refusal(box(10, 1, 1), {clamped("xmin"), of_kind("ymin", Kind::plane), of_kind("ymax", Kind::plane),
                                      of_kind("zmin", Kind::plane), of_kind("zmax", Kind::plane)}),
              HasSubstr("plane"));
}

}  // namespace
}  // namespace pfdm::this_file
