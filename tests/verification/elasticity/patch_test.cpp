// A linear displacement is reproduced exactly on every kind of cell and with every kind of boundary condition.

#include "tests/verification/support.h"

#include "mesh/geometry.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace pfdm::verification::this_file {
namespace {

const Tensor general_slope = (Tensor() << 1.0, 0.3, -0.2, 0.1, -0.7, 0.4, 0.25, -0.15, 0.6).finished() * 1e-3;

// u = slope (x - origin) in one material.
struct LinearCase {
  Tensor slope = general_slope;
  Vector origin = Vector::Zero();
  IsotropicElasticity material = from_young_poisson(75e6, 0.44);

  Vector displacement(const Vector& x) const { return slope * (x - origin); }
  Tensor stress() const { return pfdm::stress(material, symmetric_part(slope)); }
};

// Components of the displacement that are prescribed, patch by patch; tractions of the exact stress are on the others.
using Masks = std::map<std::string, std::array<bool, 3>>;

std::vector<BoundaryCondition> exact_boundary(const Mesh& mesh, const LinearCase& exact, const Masks& masks) {
  std::vector<BoundaryCondition> all;
  for (const auto& [name, mask] : masks) {
    const Vector traction = exact.stress() * mesh.face_area[mesh.patch(name).first_face].normalized();
    all.push_back({.patch = name,
                   .displacement_prescribed = mask,
                   .value = [exact, traction, mask = mask](const Vector& x, double) {
                     Vector value = exact.displacement(x);
                     for (int i = 0; i < 3; ++i)
                       if (!mask[i]) value[i] = traction[i];
                     return value;
                   }});
  }
  return all;
}

void expect_exact(const Mesh& mesh, const LinearCase& exact, const std::vector<BoundaryCondition>& boundary,
                  double most_of_displacement = 3e-11) {
  const std::vector<IsotropicElasticity> by_region(mesh.region_names.size(), exact.material);
  const auto solution = solve_elastic(mesh, elastic_model(by_region, boundary), {}, 1e-13);
  EXPECT_TRUE(solution->equilibrium.converged);
  const auto everywhere = [](Index) { return true; };
  const double u = displacement_error(mesh, *solution, [&](const Vector& x) { return exact.displacement(x); });
  const double stress = relative_stress_error(
      mesh, solution->cells.stress, [&](const Vector&) { return exact.stress(); }, everywhere);
  const double strain = relative_stress_error(
      mesh, solution->cells.strain, [&](const Vector&) { return symmetric_part(exact.slope); }, everywhere);
  report_row(fmt::format("{} cells, nu {:.3f}", mesh.n_cells(), exact.material.poisson_ratio()),
             {{"u", u},
              {"stress", stress},
              {"strain", strain},
              {"reactions", reaction_imbalance(mesh, *solution)},
              {"energy", energy_imbalance(mesh, *solution)},
              {"iterations", solution->equilibrium.iterations}});
  EXPECT_LE(u, most_of_displacement);
  const double nu = exact.material.poisson_ratio();
  // What a residual of 1e-13 leaves of the pressure, by rounding: up to 1.2e-10, and 1.1e-9 at nu = 0.4999.
  EXPECT_LE(stress, nu > 0.4995 ? 2e-9 : (nu > 0.45 ? 2e-10 : 1e-11));
  EXPECT_LE(strain, 4e-11);
  EXPECT_LE(reaction_imbalance(mesh, *solution), 2e-11);
  EXPECT_LE(energy_imbalance(mesh, *solution), 2e-11);
}

BoxHexesSettings graded_box(Index n_z) {
  BoxHexesSettings settings;
  settings.origin = Vector(-1.0, -0.5, 0.0);
  settings.axes = {{{{.length = 2.0, .n = 10, .ratio = 5.0}},
                    {{.length = 0.6, .n = 5, .ratio = 0.3}, {.length = 0.7, .n = 4, .ratio = 1.0}},
                    {{.length = 0.8, .n = n_z, .ratio = 2.0}}}};
  return settings;
}

// Inner points are moved, so that faces are neither plane nor orthogonal to the lines between cell centres.
Mesh warped_hexes() {
  Mesh mesh = make_box_hexes(graded_box(6));
  std::vector<bool> outer(mesh.points.size(), false);
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f)
    for (const Index p : mesh.points_of_face(f)) outer[p] = true;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const auto i = static_cast<double>(p);
    if (!outer[p]) mesh.points[p] += 0.02 * Vector(std::sin(37.0 * i), std::sin(91.0 * i), std::sin(53.0 * i));
  }
  compute_geometry(mesh);
  return mesh;
}

struct NamedMesh {
  std::string name;
  Mesh (*make)();
};

const std::vector<NamedMesh> meshes{
    {"TetrahedraAndPrisms", [] { return sphere_in_cube(2, 3, 2.0, 0.6); }},
    {"Polyhedra", [] { return barycentric_dual(sphere_in_cube(2, 3, 2.0, 0.6)); }},
    {"GradedHexes", [] { return make_box_hexes(graded_box(6)); }},
    {"WarpedHexes", warped_hexes},
};

double most_on(const NamedMesh& mesh) { return mesh.name.ends_with("Hexes") ? 2e-10 : 3e-11; }

struct NamedMasks {
  std::string name;
  Masks of_patch;
};

constexpr std::array<bool, 3> all{true, true, true}, none{false, false, false};

const std::vector<NamedMasks> boundaries{
    {"Displacement", {{"xmin", all}, {"xmax", all}, {"ymin", all}, {"ymax", all}, {"zmin", all}, {"zmax", all}}},
    {"Traction", {{"xmin", all}, {"xmax", none}, {"ymin", none}, {"ymax", none}, {"zmin", none}, {"zmax", none}}},
    {"MixedComponents",
     {{"xmin", {true, false, false}},
      {"xmax", {false, true, false}},
      {"ymin", {true, true, false}},
      {"ymax", {false, false, true}},
      {"zmin", {true, false, true}},
      {"zmax", {false, true, true}}}},
};

using MeshAndMasks = std::tuple<NamedMesh, NamedMasks>;
class PatchTest : public testing::TestWithParam<MeshAndMasks> {};

TEST_P(PatchTest, IsExact) {
  const auto& [mesh_kind, masks] = GetParam();
  const Mesh mesh = mesh_kind.make();
  const LinearCase exact;
  expect_exact(mesh, exact, exact_boundary(mesh, exact, masks.of_patch), most_on(mesh_kind));
}

// Its dilation is mu/lambda of the other cases', so that tractions are as large: those of theirs would be lambda/mu
// times as large as what shears the body, and so would their rounding.
TEST_P(PatchTest, IsExactForNearlyIncompressibleMaterials) {
  const auto& [mesh_kind, masks] = GetParam();
  const Mesh mesh = mesh_kind.make();
  for (const double nu : {0.49, 0.499, 0.4999}) {
    const IsotropicElasticity material = from_young_poisson(75e6, nu);
    const double taken_away = (1.0 - material.mu / material.lambda) * general_slope.trace() / 3.0;
    const LinearCase exact{.slope = general_slope - taken_away * Tensor::Identity(), .material = material};
    expect_exact(mesh, exact, exact_boundary(mesh, exact, masks.of_patch), most_on(mesh_kind));
  }
}

INSTANTIATE_TEST_SUITE_P(Boundaries, PatchTest,
                         testing::Combine(testing::ValuesIn(meshes), testing::ValuesIn(boundaries)),
                         [](const auto& test) { return std::get<0>(test.param).name + std::get<1>(test.param).name; });

Vector lowest_corner(const Mesh& mesh) {
  return *std::min_element(mesh.points.begin(), mesh.points.end(),
                           [](const Vector& a, const Vector& b) { return a.sum() < b.sum(); });
}

// Uniaxial tension along the turned x axis: three symmetry faces, free sides, one end pulled.
class RotatedTension : public testing::TestWithParam<double> {
 protected:
  static void pull(Mesh straight, bool by_traction) {
    const double nu = GetParam();
    const Tensor R = arbitrary_rotation();
    const Vector corner = lowest_corner(straight);
    const Mesh mesh = rotated(std::move(straight), R);
    const LinearCase exact{.slope = 1e-3 * R * Vector(1.0, -nu, -nu).asDiagonal() * R.transpose(),
                           .origin = R * corner,
                           .material = from_young_poisson(75e6, nu)};
    auto boundary = exact_boundary(mesh, exact, {{"xmax", by_traction ? none : all}});
    for (const char* patch : {"xmin", "ymin", "zmin"}) boundary.push_back(symmetry_on(patch));
    expect_exact(mesh, exact, boundary);
  }
};

TEST_P(RotatedTension, OfHexesByTraction) { pull(make_box_hexes(graded_box(6)), true); }
TEST_P(RotatedTension, OfHexesByDisplacement) { pull(make_box_hexes(graded_box(6)), false); }
TEST_P(RotatedTension, OfTetrahedraAndPrismsByTraction) { pull(sphere_in_cube(2, 3, 2.0, 0.6), true); }
TEST_P(RotatedTension, OfTetrahedraAndPrismsByDisplacement) { pull(sphere_in_cube(2, 3, 2.0, 0.6), false); }
TEST_P(RotatedTension, OfPolyhedraByTraction) { pull(barycentric_dual(sphere_in_cube(2, 3, 2.0, 0.6)), true); }
TEST_P(RotatedTension, OfPolyhedraByDisplacement) { pull(barycentric_dual(sphere_in_cube(2, 3, 2.0, 0.6)), false); }

INSTANTIATE_TEST_SUITE_P(PoissonRatios, RotatedTension, testing::Values(0.3, 0.44, 0.499));

// One cell thick, in the plane of the coordinates and in a turned one.
class OneCellThick : public testing::TestWithParam<std::tuple<NamedMesh, bool>> {
 protected:
  static Tensor rotation() { return std::get<1>(GetParam()) ? arbitrary_rotation() : Tensor(Tensor::Identity()); }

  static LinearCase turned(Tensor in_plane_slope, double across = 0.0) {
    in_plane_slope.row(2).setZero();
    in_plane_slope.col(2).setZero();
    in_plane_slope(2, 2) = across;
    return {.slope = rotation() * in_plane_slope * rotation().transpose()};
  }

  // Displacements live half-way between front and back.
  static void solve(LinearCase exact, BoundaryCondition (*front_and_back)(const std::string&), const Masks& masks,
                    const std::vector<std::string>& symmetric) {
    const Mesh straight = std::get<0>(GetParam()).make();
    const double middle = straight.cell_centre[0].z() - lowest_corner(straight).z();
    exact.origin = rotation() * (lowest_corner(straight) + middle * Vector::UnitZ());
    const Mesh mesh = rotated(straight, rotation());
    auto boundary = exact_boundary(mesh, exact, masks);
    for (const char* patch : {"zmin", "zmax"}) boundary.push_back(front_and_back(patch));
    for (const std::string& patch : symmetric) boundary.push_back(symmetry_on(patch));
    expect_exact(mesh, exact, boundary);
  }
};

class PlaneStrain : public OneCellThick {};
class PlaneStress : public OneCellThick {
 protected:
  static constexpr double nu = 0.44;  // of LinearCase

  static LinearCase general() {
    return turned(general_slope, -nu / (1.0 - nu) * general_slope.topLeftCorner<2, 2>().trace());
  }
};

TEST_P(PlaneStrain, ByDisplacement) {
  solve(turned(general_slope), plane_on, {{"xmin", all}, {"xmax", all}, {"ymin", all}, {"ymax", all}}, {});
}

TEST_P(PlaneStrain, ByTraction) {
  solve(turned(general_slope), plane_on, {{"xmin", all}, {"xmax", none}, {"ymin", none}, {"ymax", none}}, {});
}

TEST_P(PlaneStrain, BetweenSymmetryFaces) {
  const Tensor principal = 1e-3 * Vector(1.0, -0.6, 0.0).asDiagonal();
  solve(turned(principal), plane_on, {{"xmax", none}, {"ymax", none}}, {"xmin", "ymin"});
}

TEST_P(PlaneStress, ByDisplacement) {
  solve(general(), plane_stress_on, {{"xmin", all}, {"xmax", all}, {"ymin", all}, {"ymax", all}}, {});
}

TEST_P(PlaneStress, ByTraction) {
  solve(general(), plane_stress_on, {{"xmin", all}, {"xmax", none}, {"ymin", none}, {"ymax", none}}, {});
}

// E times the strain, which contracts both ways by nu.
TEST_P(PlaneStress, InUniaxialTension) {
  const LinearCase tension = turned(1e-3 * Vector(1.0, -nu, 0.0).asDiagonal().toDenseMatrix(), -1e-3 * nu);
  EXPECT_NEAR(tension.stress().norm(), 75e6 * 1e-3, 1e-6);
  solve(tension, plane_stress_on, {{"xmax", none}, {"ymax", none}}, {"xmin", "ymin"});
}

const std::vector<NamedMesh> thin_meshes{
    {"Hexes", [] { return make_box_hexes(graded_box(1)); }},
    {"Wedges",
     [] {
       return extruded_triangles(8, {0.0, 0.1});
     }},
};

const auto on_thin_meshes = testing::Combine(testing::ValuesIn(thin_meshes), testing::Bool());
const auto thin_name = [](const auto& test) {
  return std::get<0>(test.param).name + (std::get<1>(test.param) ? "Turned" : "");
};
INSTANTIATE_TEST_SUITE_P(OneCellThick, PlaneStrain, on_thin_meshes, thin_name);
INSTANTIATE_TEST_SUITE_P(OneCellThick, PlaneStress, on_thin_meshes, thin_name);

}  // namespace
}  // namespace pfdm::verification::this_file
