#include "mesh/dual.h"

#include <set>

#include "mesh/generators/box_hexes.h"
#include "mesh/generators/particles_in_box.h"
#include "mesh/patch_rules.h"
#include "mesh/quality.h"
#include "physics/error.h"
#include "tests/mesh/mesh_checks.h"

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

constexpr Index subdivision = 3, n_layers = 4;

Mesh sphere_in_layers() {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-2.0);
  settings.upper = Vector(2.0, 2.5, 2.0);
  Particle sphere;
  sphere.radius = 1.0;
  sphere.subdivision = subdivision;
  sphere.n_layers = n_layers;
  sphere.layer_thickness = 0.4;
  settings.particles = {sphere};
  return make_particles_in_box(settings);
}

Mesh tetrahedra(std::vector<Vector> points, const std::vector<std::vector<Index>>& cells,
                const std::vector<PatchRule>& rules = {}) {
  CellSoup soup;
  soup.points = std::move(points);
  soup.region_names = {"body"};
  for (const auto& cell : cells) soup.add_cell(CellShape::tetrahedron, cell, 0);
  return assemble_mesh(std::move(soup), rules);
}

const std::vector<Vector> corner_points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Index count_in(const Mesh& mesh, const std::string& region) {
  return static_cast<Index>(std::count(mesh.region.begin(), mesh.region.end(), mesh.region_index(region)));
}

// Cells close, and know their faces; unlike those of plane faces, volumes are not sums over face centres.
void expect_closed(const Mesh& mesh) {
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    Vector sum = Vector::Zero();
    double size = 0.0;
    for (const Index f : mesh.faces_of_cell(c)) {
      const Vector outward = mesh.owner[f] == c ? mesh.face_area[f] : Vector(-mesh.face_area[f]);
      sum += outward;
      size += outward.norm();
      EXPECT_GT(outward.dot(mesh.face_centre[f] - mesh.cell_centre[c]), 0.0) << "cell " << c;
    }
    EXPECT_LE(sum.norm(), 1e-14 * size) << "cell " << c;
    EXPECT_EQ(mesh.shape[c], CellShape::polyhedron);
  }
  EXPECT_EQ(mesh.face_apex.size(), mesh.n_faces());
}

TEST(Dual, KeepsVolumesOfRegionsAndAreasOfPatches) {
  const Mesh primal = sphere_in_layers(), dual = barycentric_dual(primal);
  expect_closed(dual);
  EXPECT_EQ(dual.region_names, primal.region_names);
  for (const std::string& region : primal.region_names)
    EXPECT_NEAR(region_volume(dual, region) / region_volume(primal, region), 1.0, 1e-12) << region;
  ASSERT_EQ(dual.patches.size(), primal.patches.size());
  for (const Patch& patch : primal.patches)
    EXPECT_LE((patch_area(dual, patch.name) - patch_area(primal, patch.name)).norm(), 1e-12) << patch.name;
}

TEST(Dual, HasACellForEachVertexOfEachRegion) {
  const Mesh primal = sphere_in_layers(), dual = barycentric_dual(primal);
  for (const std::string& region : primal.region_names) {
    std::set<Index> vertices;
    for (Index c = 0; c < primal.n_cells(); ++c)
      if (primal.region[c] == primal.region_index(region))
        vertices.insert(primal.points_of_cell(c).begin(), primal.points_of_cell(c).end());
    EXPECT_EQ(count_in(dual, region), count_of(vertices)) << region;
  }
  EXPECT_EQ(count_in(dual, "interface"), (10 * subdivision * subdivision + 2) * (n_layers + 1));
}

TEST(Dual, HasAFaceForEachVertexBetweenRegions) {
  const Mesh dual = barycentric_dual(sphere_in_layers());
  std::map<std::pair<Index, Index>, std::pair<Index, Vector>> between;  // number, sum of areas outwards
  double radius = 0.0;
  for (Index f = 0; f < dual.n_interior_faces(); ++f) {
    const Index P = dual.owner[f], N = dual.neighbour[f];
    if (dual.region[P] == dual.region[N]) continue;
    ++between[std::minmax(dual.region[P], dual.region[N])].first;
    radius = std::max(radius, dual.points[dual.face_apex[f]].norm());
  }
  ASSERT_EQ(between.size(), 2u);
  for (const auto& [regions, count] : between) EXPECT_EQ(count.first, 10 * subdivision * subdivision + 2);
  EXPECT_NEAR(radius, 1.4, 1e-12);  // the domes reach out to the vertices
}

TEST(Dual, QuartersATetrahedron) {
  const Mesh dual = barycentric_dual(tetrahedra(corner_points, {{0, 1, 2, 3}}));
  expect_sound(dual);
  ASSERT_EQ(dual.n_cells(), 4);
  EXPECT_EQ(dual.n_interior_faces(), 6);
  EXPECT_EQ(dual.n_faces(), 6 + 12);
  for (Index c = 0; c < 4; ++c) EXPECT_NEAR(dual.cell_volume[c], 1.0 / 24.0, 1e-16);
}

TEST(Dual, HalvesTheFirstAndLastOfAStackOfPrisms) {
  CellSoup soup;
  soup.region_names = {"body"};
  for (const double z : {0.0, 1.0, 2.0, 3.0})
    for (const Vector& p : {Vector(0, 0, z), Vector(1, 0, z), Vector(0, 1, z)}) soup.points.push_back(p);
  for (Index k = 0; k < 3; ++k)
    soup.add_cell(CellShape::wedge, std::vector<Index>{3 * k, 3 * k + 2, 3 * k + 1, 3 * k + 3, 3 * k + 5, 3 * k + 4},
                  0);
  const Mesh dual = barycentric_dual(assemble_mesh(std::move(soup), {}));
  expect_sound(dual);
  ASSERT_EQ(dual.n_cells(), 12);
  for (Index c = 0; c < 12; ++c) {
    const bool at_end = dual.cell_centre[c][2] < 0.4 || dual.cell_centre[c][2] > 2.6;
    EXPECT_NEAR(dual.cell_volume[c], at_end ? 1.0 / 12.0 : 1.0 / 6.0, 1e-15);
  }
}

TEST(Dual, DoesNotJoinCellsThatMeetInAPoint) {
  std::vector<Vector> points = corner_points;
  for (const Vector& x : {Vector(-1, 0, 0), Vector(0, -1, 0), Vector(0, 0, -1)}) points.push_back(x);
  const Mesh dual = barycentric_dual(tetrahedra(points, {{0, 1, 2, 3}, {0, 4, 6, 5}}));
  EXPECT_EQ(dual.n_cells(), 8);
}

TEST(Dual, DoesNotJoinRegionsThatMeetInAnEdge) {
  const std::vector<Vector> points{{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  CellSoup soup;
  soup.points = points;
  soup.region_names = {"a", "b"};
  const Index around[] = {2, 3, 4, 5, 2};
  for (std::size_t k = 0; k < 4; ++k)
    soup.add_cell(CellShape::tetrahedron, std::vector<Index>{0, around[k], around[k + 1], 1},
                  static_cast<Index>(k % 2));
  const Mesh primal = assemble_mesh(std::move(soup), {}), dual = barycentric_dual(primal);
  expect_closed(dual);
  EXPECT_EQ(dual.n_cells(), 4 * 4);
  EXPECT_NEAR(region_volume(dual, "a"), region_volume(primal, "a"), 1e-15);
}

TEST(Dual, PartsFacesOfOnePatchAtSharpEdges) {
  const Mesh dual = barycentric_dual(tetrahedra(corner_points, {{0, 1, 2, 3}}, {}));
  ASSERT_EQ(dual.patches.size(), 1u);
  const Vector slanted = Vector::Ones().normalized();
  for (Index f = dual.n_interior_faces(); f < dual.n_faces(); ++f) {
    const Vector n = dual.face_area[f].normalized();
    EXPECT_NEAR(std::max({-n[0], -n[1], -n[2], n.dot(slanted)}), 1.0, 1e-14);
  }
}

TEST(Dual, OfTheSameMeshIsTheSame) {
  const Mesh a = barycentric_dual(sphere_in_layers()), b = barycentric_dual(sphere_in_layers());
  expect_same(a, b);
}

TEST(Dual, IsMoreOrthogonalThanItsPrimal) {
  const Mesh primal = sphere_in_layers();
  const MeshQuality before = mesh_quality(primal), after = mesh_quality(barycentric_dual(primal));
  EXPECT_LT(after.non_orthogonality.mean, before.non_orthogonality.mean);
  EXPECT_LT(after.skewness.mean, before.skewness.mean);
  EXPECT_EQ(after.shapes, (std::vector<NamedCount>{{"polyhedra", after.n_cells}}));
  EXPECT_NEAR(after.volume, before.volume, 1e-11);
}

TEST(Dual, RefusesHexahedra) {
  BoxHexesSettings settings;
  settings.axes = {{{{1.0, 2, 1.0}}, {{1.0, 1, 1.0}}, {{1.0, 1, 1.0}}}};
  const Mesh mesh = make_box_hexes(settings);
  EXPECT_THAT(message_of<InputError>([&] { barycentric_dual(mesh); }),
              HasSubstr("2 of the mesh's 2 cells are hexahedra or polyhedra"));
}

}  // namespace
}  // namespace pfdm::this_file
