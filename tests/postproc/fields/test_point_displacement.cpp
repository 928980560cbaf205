#include "mesh/dual.h"
#include "mesh/generators/particles_in_box.h"
#include "physics/error.h"
#include "postproc/fields/frame.h"
#include "postproc/fields/point_displacement.h"
#include "tests/postproc/boxes.h"
#include "tests/postproc/opened_fields.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <set>

namespace pfdm::test::this_file {
namespace {

const Tensor some_gradient = (Tensor() << 0.1, 0.02, -0.03, 0.04, -0.2, 0.05, 0.07, -0.01, 0.3).finished();
const Vector some_shift(0.5, -0.25, 2.0);

OutputFields linear_fields(const Mesh& mesh) {
  OutputFields output = sound_fields(mesh);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    output.displacement[c] = some_shift + some_gradient * mesh.cell_centre[c];
    output.gradient[c] = some_gradient;
  }
  return output;
}

Mesh tetrahedra() {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-1.0);
  settings.upper = Vector::Constant(1.0);
  settings.size_far = 0.5;
  return make_particles_in_box(settings);
}

vtkSmartPointer<vtkUnstructuredGrid> read_back(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkUnstructuredGrid> frame_of(const Mesh& mesh, const OutputFields& output,
                                              const std::vector<BoundaryCondition>& boundary = {}, double load = 1.0) {
  const TemporaryFolder folder;
  const SplitPoints points = point_displacement(mesh, boundary, output, load);
  VtuWriter(mesh).write(folder / "a.vtu", frame_fields(mesh, output), load, &points);
  return read_back(folder / "a.vtu");
}

Vector displacement_at(vtkUnstructuredGrid& grid, vtkIdType point) {
  Vector u;
  grid.GetPointData()->GetArray("displacement")->GetTuple(point, u.data());
  return u;
}

// All points of a cell, of the stream of its faces too.
std::set<vtkIdType> points_of(vtkUnstructuredGrid& grid, vtkIdType cell) {
  vtkNew<vtkIdList> ids;
  grid.GetCellPoints(cell, ids);
  std::set<vtkIdType> points(ids->begin(), ids->end());
  if (grid.GetCellType(cell) != VTK_POLYHEDRON) return points;
  vtkNew<vtkIdList> stream;
  grid.GetFaceStream(cell, stream);
  for (vtkIdType at = 1; at < stream->GetNumberOfIds(); at += stream->GetId(at) + 1)
    for (vtkIdType i = at + 1; i <= at + stream->GetId(at); ++i) {
      EXPECT_TRUE(points.contains(stream->GetId(i))) << "of cell " << cell;
      points.insert(stream->GetId(i));
    }
  return points;
}

// Each sound cell keeps the displacement of its side at all its points, and broken cells stay between the sides.
void expect_opened(const Mesh& mesh, const OutputFields& output, const Vector& normal, const Vector& w) {
  const auto grid = frame_of(mesh, output);
  ASSERT_EQ(grid->GetNumberOfCells(), mesh.n_cells());
  Index n_broken = 0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const bool is_broken = output.damage[c] > broken_damage;
    n_broken += is_broken ? 1 : 0;
    const double share = normal.dot(mesh.cell_centre[c]) > 0.0 ? 1.0 : 0.0;
    for (const vtkIdType p : points_of(*grid, c)) {
      const double here = displacement_at(*grid, p).dot(w) / w.squaredNorm();
      if (is_broken) {
        EXPECT_GT(here, -1e-6);
        EXPECT_LT(here, 1.0 + 1e-6);
      } else {
        EXPECT_NEAR(here, share, 1e-6) << "cell " << c << " point " << p;
      }
    }
  }
  EXPECT_GT(n_broken, 0);
}

TEST(PointDisplacement, of_a_linear_field_is_exact) {
  for (const Mesh& mesh : {cube_mesh(1.0, 3), tetrahedra(), barycentric_dual(tetrahedra())}) {
    const auto grid = frame_of(mesh, linear_fields(mesh));
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
      EXPECT_NEAR((displacement_at(*grid, p) - some_shift - some_gradient * Vector(grid->GetPoint(p))).norm(), 0.0,
                  1e-6);
    EXPECT_GT(grid->GetNumberOfPoints(), 0);
  }
}

TEST(PointDisplacement, keeps_the_kink_between_two_materials) {
  const Mesh mesh = cube_mesh(1.0, 4);
  OutputFields output = sound_fields(mesh);
  const auto exact = [](double z) { return z < 0.5 ? 0.1 * z : 0.05 + 2.0 * (z - 0.5); };
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const double z = mesh.cell_centre[c].z();
    output.displacement[c] = Vector(0, 0, exact(z));
    output.gradient[c](2, 2) = z < 0.5 ? 0.1 : 2.0;
  }
  const SplitPoints points = point_displacement(mesh, {}, output, 1.0);
  EXPECT_TRUE(points.copies.empty());
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    EXPECT_NEAR(points.displacement[p].z(), exact(mesh.points[p].z()), 1e-14);
}

TEST(PointDisplacement, opens_a_split_bar) {
  const Mesh bar = box_mesh({1.0, 2, 1.0}, {1.0, 2, 1.0}, {5.0, 5, 1.0});
  OutputFields output = sound_fields(bar);
  for (Index c = 0; c < bar.n_cells(); ++c) {
    const double z = bar.cell_centre[c].z();
    output.displacement[c] = Vector(0, 0, z < 2 ? 0.0 : z > 3 ? 7.0 : 3.5);
    if (z < 2 || z > 3) continue;
    output.damage[c] = 1.0;
    output.gradient[c](2, 2) = 7.0;
  }
  const SplitPoints points = point_displacement(bar, {}, output, 1.0);
  EXPECT_TRUE(points.copies.empty());  // the row of broken cells stretches
  for (std::size_t p = 0; p < bar.points.size(); ++p)
    EXPECT_NEAR(points.displacement[p].z(), bar.points[p].z() < 2.5 ? 0.0 : 7.0, 1e-14);
}

// A crack that goes on at an edge: the sound cells across it touch there.
TEST(PointDisplacement, splits_points_where_a_crack_turns) {
  const Mesh mesh = box_mesh({2.0, 2, 1.0}, {1.0, 1, 1.0}, {2.0, 2, 1.0});
  OutputFields output = sound_fields(mesh);
  const Vector w(-3, 0, 3);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector x = mesh.cell_centre[c];
    const bool is_above = x.z() > x.x() + 0.5;
    output.damage[c] = std::abs(x.z() - x.x()) < 0.5 ? 1.0 : 0.0;
    output.displacement[c] = is_above ? w : (output.damage[c] > 0.5 ? 0.5 * w : Vector::Zero().eval());
  }
  const SplitPoints points = point_displacement(mesh, {}, output, 1.0);
  ASSERT_EQ(points.copies.size(), 2U);
  for (const PointCopy& copy : points.copies)
    EXPECT_NEAR((mesh.points[copy.point] - Vector(1, mesh.points[copy.point].y(), 1)).norm(), 0, 1e-14);
  const auto grid = frame_of(mesh, output);
  EXPECT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(mesh.points.size()) + 2);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (output.damage[c] > 0.5) continue;
    for (const vtkIdType p : points_of(*grid, c))
      EXPECT_NEAR((displacement_at(*grid, p) - output.displacement[c]).norm(), 0.0, 1e-6);
  }
}

TEST(PointDisplacement, opens_a_crack_through_tetrahedra_and_polyhedra) {
  const Vector normal = Vector(0.1, 0.2, 1.0).normalized(), w(0.3, 0.0, 0.8);
  const Mesh tets = tetrahedra();
  expect_opened(tets, opened_fields(tets, normal, 0.3, w), normal, w);
  const Mesh dual = barycentric_dual(tets);
  expect_opened(dual, opened_fields(dual, normal, 0.5, w), normal, w);
}

TEST(PointDisplacement, leaves_intact_points_as_they_are_in_the_file) {
  const Mesh mesh = barycentric_dual(tetrahedra());
  const Vector normal = Vector::UnitZ();
  const auto sound = frame_of(mesh, sound_fields(mesh));
  const auto split = frame_of(mesh, opened_fields(mesh, normal, 0.25, normal));
  ASSERT_LE(sound->GetNumberOfPoints(), split->GetNumberOfPoints());
  for (vtkIdType p = 0; p < sound->GetNumberOfPoints(); ++p)
    EXPECT_EQ(Vector(sound->GetPoint(p)), Vector(split->GetPoint(p)));
}

BoundaryCondition prescribed(const std::string& patch, std::array<bool, 3> components) {
  return {.patch = patch,
          .kind = BoundaryCondition::Kind::components,
          .displacement_prescribed = components,
          .value = [](const Vector& x, double t) { return Vector(t * std::sin(x.y()), x.x() * x.x(), 3.0 * t); }};
}

TEST(PointDisplacement, is_what_is_prescribed_on_patches) {
  const Mesh mesh = cube_mesh(1.0, 3);
  const BoundaryCondition top = prescribed("zmax", {true, false, true});
  const BoundaryCondition side{.patch = "ymin", .kind = BoundaryCondition::Kind::symmetry, .value = {}};
  const SplitPoints points = point_displacement(mesh, {top, side}, linear_fields(mesh), 0.5);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const Vector x = mesh.points[p], value = top.value(x, 0.5), inside = some_shift + some_gradient * x;
    const bool on_top = x.z() == 1.0, on_side = x.y() == 0.0;
    EXPECT_NEAR(points.displacement[p].x(), on_top ? value.x() : inside.x(), 1e-14);
    EXPECT_NEAR(points.displacement[p].y(), on_side ? 0.0 : inside.y(), 1e-14);
    EXPECT_NEAR(points.displacement[p].z(), on_top ? value.z() : inside.z(), 1e-14);
    EXPECT_TRUE(!on_top || points.displacement[p].z() == 1.5);
  }
}

TEST(PointDisplacement, is_prescribed_on_both_sides_of_a_crack) {
  const Mesh mesh = box_mesh({2.0, 2, 1.0}, {1.0, 1, 1.0}, {2.0, 2, 1.0});
  OutputFields output = sound_fields(mesh);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector x = mesh.cell_centre[c];
    output.damage[c] = std::abs(x.z() - x.x()) < 0.5 ? 1.0 : 0.0;
  }
  const SplitPoints points = point_displacement(mesh, {prescribed("ymin", {true, true, true})}, output, 1.0);
  ASSERT_EQ(points.copies.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_EQ(points.displacement[mesh.points.size() + k].z(),
              mesh.points[points.copies[k].point].y() == 0.0 ? 3.0 : 0.0);
}

TEST(PointDisplacement, goes_on_where_a_formula_has_no_value_at_a_point) {
  const Mesh mesh = cube_mesh(1.0, 2);
  const BoundaryCondition singular{
      .patch = "zmin", .displacement_prescribed = {true, true, true}, .value = [](const Vector& x, double) {
        if (x.x() == 0.0) throw InputError("not finite");
        return Vector(1, 1, 1);
      }};
  const SplitPoints points = point_displacement(mesh, {singular}, linear_fields(mesh), 1.0);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const Vector x = mesh.points[p];
    const Vector expected = x.z() == 0.0 && x.x() > 0.0 ? Vector(1, 1, 1) : (some_shift + some_gradient * x).eval();
    EXPECT_NEAR((points.displacement[p] - expected).norm(), 0.0, 1e-14);
  }
}

// The gradient of a broken cell is that of its opening.
TEST(PointDisplacement, of_broken_cells_alone_has_no_spikes) {
  const Mesh mesh = cube_mesh(1.0, 2);
  OutputFields output = sound_fields(mesh);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    output.damage[c] = 1.0;
    output.displacement[c] = Vector::Constant(0.1 * c);
    output.gradient[c] = Tensor::Constant(50.0 * (c % 2 == 0 ? 1 : -1));
  }
  for (const Vector& u : point_displacement(mesh, {}, output, 1.0).displacement) {
    EXPECT_GE(u.minCoeff(), 0.0);
    EXPECT_LE(u.maxCoeff(), 0.7 + 1e-12);
  }
}

}  // namespace
}  // namespace pfdm::test::this_file
