// Least-squares gradients are exact for linear fields on every kind of cell and for any damage.

#include "solver/scalar/gradient.h"

#include "mesh/dual.h"

#include "physics/error.h"
#include "tests/solver/solver_checks.h"

namespace pfdm::this_file {
namespace {

// Nodes on the boundary and between zones, as the momentum balance has them.
FaceField<Index> nodes_on_faces(const Mesh& mesh, const CellField<Index>& zone) {
  FaceField<Index> node(mesh.n_faces(), -1);
  Index next = mesh.n_cells();
  for (Index f = 0; f < mesh.n_faces(); ++f)
    if (!mesh.is_interior(f) || zone[mesh.owner[f]] != zone[mesh.neighbour[f]]) node[f] = next++;
  return node;
}

CellField<Index> one_zone(const Mesh& mesh) { return CellField<Index>(mesh.n_cells(), 0); }

struct LinearField {
  Vector offset;
  Tensor slope;
  Vector operator()(const Vector& x) const { return offset + slope * x; }
};

// Of the cells' and the face nodes' positions.
std::vector<Vector> sample(const Mesh& mesh, const FaceField<Index>& node_of_face, const LinearField& field) {
  std::vector<Vector> u;
  for (const Vector& x : mesh.cell_centre) u.push_back(field(x));
  for (Index f = 0; f < node_of_face.size(); ++f)
    if (node_of_face[f] >= 0) u.push_back(field(mesh.face_centre[f]));
  return u;
}

void expect_exact(const Mesh& mesh, const CellField<Index>& zone, const std::vector<CellField<double>>& g_history) {
  RandomNumbers random;
  const LinearField field{random.vector(), random.tensor()};
  const FaceField<Index> nodes = nodes_on_faces(mesh, zone);
  Gradient gradient(mesh, {.zone = zone, .node_of_face = nodes, .wanted = {}});
  for (const CellField<double>& g : g_history) gradient.update(g);
  const std::vector<Vector> u = sample(mesh, nodes, field);
  std::vector<double> component;
  component.reserve(u.size());
  for (const Vector& v : u) component.push_back(v[1]);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    ASSERT_LE((gradient.of(u.data(), c) - field.slope).norm(), 1e-8) << "cell " << c;
    ASSERT_LE((gradient.of(component.data(), c) - field.slope.row(1).transpose()).norm(), 1e-8) << "cell " << c;
  }
}

// Sound, partly and fully broken cells next to each other.
CellField<double> random_damage(Index n_cells) {
  RandomNumbers random;
  CellField<double> g(n_cells);
  for (double& value : g) value = std::pow(10.0, random.between(-6.0, 0.0));
  return g;
}

TEST(Gradient, ExactForLinearFieldsOnHexes) {
  const Mesh mesh = box(5, 4, 3, {2.0, 1.0, 0.5}, 3.0);
  expect_exact(mesh, one_zone(mesh), {});
  expect_exact(mesh, one_zone(mesh), {random_damage(mesh.n_cells())});
}

TEST(Gradient, ExactForLinearFieldsOnTetrahedraAndPrisms) {
  const Mesh mesh = tetrahedra_and_prisms();
  for (const CellField<Index>& zone : {one_zone(mesh), mesh.region}) {
    expect_exact(mesh, zone, {});
    expect_exact(mesh, zone, {random_damage(mesh.n_cells())});
  }
}

TEST(Gradient, ExactForLinearFieldsOnPolyhedra) {
  const Mesh mesh = barycentric_dual(tetrahedra_and_prisms());
  for (const CellField<Index>& zone : {one_zone(mesh), mesh.region}) {
    expect_exact(mesh, zone, {});
    expect_exact(mesh, zone, {random_damage(mesh.n_cells())});
  }
}

TEST(Gradient, OneCellWideBarsNeedFaceNodes) {
  const Mesh mesh = box(6, 1, 1);
  expect_exact(mesh, one_zone(mesh), {});
  EXPECT_THROW(Gradient(mesh, {.zone = one_zone(mesh), .node_of_face = {}, .wanted = {}}), InputError);
}

TEST(Gradient, DeficientCellsHaveNoneIfAskedSo) {
  const Mesh mesh = box(6, 1, 1);
  const Gradient gradient(mesh, {.zone = one_zone(mesh), .node_of_face = {}, .wanted = {}, .zero_if_deficient = true});
  RandomNumbers random;
  const CellField<double> d = random.field(mesh.n_cells(), 0.0, 1.0);
  for (Index c = 0; c < mesh.n_cells(); ++c) EXPECT_EQ(gradient.of(d.data(), c), Vector::Zero().eval());
}

TEST(Gradient, PlaneMeshesHaveNoGradientAcross) {
  const Mesh mesh = box(5, 4, 1);
  FaceField<Index> nodes(mesh.n_faces(), -1);
  Index next = mesh.n_cells();
  for (Index f = mesh.n_interior_faces(); f < mesh.n_faces(); ++f)
    if (std::abs(mesh.face_area[f].normalized()[2]) < 0.5) nodes[f] = next++;
  const Gradient gradient(
      mesh, {.zone = one_zone(mesh), .node_of_face = nodes, .plane_normal = Vector::UnitZ(), .wanted = {}});
  RandomNumbers random;
  LinearField field{random.vector(), random.tensor()};
  field.slope.col(2).setZero();
  const std::vector<Vector> u = sample(mesh, nodes, field);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    EXPECT_LE((gradient.of(u.data(), c) - field.slope).norm(), 1e-11) << "cell " << c;
}

// A cell does not look across to another zone.
TEST(Gradient, ZonesDoNotSeeEachOther) {
  const Mesh mesh = box(8, 3, 3, {8.0, 1.0, 1.0}, 1.0, {{"right", {4.0, -1.0, -1.0}, {9.0, 2.0, 2.0}}});
  const FaceField<Index> nodes = nodes_on_faces(mesh, mesh.region);
  const Gradient gradient(mesh, {.zone = mesh.region, .node_of_face = nodes, .wanted = {}});
  RandomNumbers random;
  const LinearField left{Vector::Zero(), random.tensor()};
  LinearField right{Vector::Zero(), random.tensor()};  // meets the left one at x = 4
  right.slope.rightCols<2>() = left.slope.rightCols<2>();
  right.offset = 4.0 * (left.slope.col(0) - right.slope.col(0));
  std::vector<Vector> u = sample(mesh, nodes, left);
  const std::vector<Vector> v = sample(mesh, nodes, right);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.cell_centre[c][0] > 4.0) u[c] = v[c];
  for (Index f = 0; f < mesh.n_faces(); ++f)
    if (nodes[f] >= 0 && mesh.face_centre[f][0] > 4.0) u[nodes[f]] = v[nodes[f]];
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Tensor& expected = mesh.cell_centre[c][0] > 4.0 ? right.slope : left.slope;
    EXPECT_LE((gradient.of(u.data(), c) - expected).norm(), 1e-10) << "cell " << c;
  }
}

// A broken cell must not bridge into a sound one: the sound ones beside it see only their own side.
TEST(Gradient, BrokenCellsDoNotBridge) {
  const Mesh mesh = box(9, 3, 3, {9.0, 3.0, 3.0});
  const FaceField<Index> nodes = nodes_on_faces(mesh, one_zone(mesh));
  Gradient gradient(mesh, {.zone = one_zone(mesh), .node_of_face = nodes, .wanted = {}});
  CellField<double> g(mesh.n_cells(), 1.0);
  std::vector<Vector> u(*std::max_element(nodes.begin(), nodes.end()) + 1, Vector::Zero());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const double x = mesh.cell_centre[c][0];
    g[c] = x > 4.0 && x < 5.0 ? 1e-6 : 1.0;
    u[c] = Vector(x > 5.0 ? 1.0 : x > 4.0 ? 0.5 : 0.0, 0.0, 0.0);
  }
  for (Index f = 0; f < mesh.n_faces(); ++f)
    if (nodes[f] >= 0) u[nodes[f]] = u[mesh.owner[f]];
  gradient.update(g);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (g[c] == 1.0) {
      EXPECT_LE(gradient.of(u.data(), c).norm(), 2e-6) << "cell " << c;
    }
}

// A run that is gone on with after a restart has seen only the last damage.
TEST(Gradient, DoesNotRememberEarlierDamage) {
  const Mesh mesh = tetrahedra_and_prisms();
  const FaceField<Index> nodes = nodes_on_faces(mesh, mesh.region);
  Gradient long_lived(mesh, {.zone = mesh.region, .node_of_face = nodes, .wanted = {}}), fresh = long_lived;
  RandomNumbers random;
  const CellField<double> sound(mesh.n_cells(), 1.0), last = random.field(mesh.n_cells(), 0.1, 1.0);
  std::vector<Vector> u(*std::max_element(nodes.begin(), nodes.end()) + 1);
  for (Vector& value : u) value = random.vector();
  for (const CellField<double>& g : {last, sound}) {
    long_lived.update(random.field(mesh.n_cells(), 1e-6, 1.0));
    long_lived.update(g);
    Gradient restarted = fresh;
    restarted.update(g);
    for (Index c = 0; c < mesh.n_cells(); ++c)
      ASSERT_EQ(long_lived.of(u.data(), c), restarted.of(u.data(), c)) << "cell " << c;
  }
}

}  // namespace
}  // namespace pfdm::this_file
