// A sphere whose surface is split: springs of any stiffness between its sides, and their nodes eliminated.

#include "solver/momentum/solution/split_condensation.h"

#include "solver/momentum/solution/momentum_solver.h"
#include "tests/solver/solver_checks.h"

namespace pfdm::this_file {
namespace {

constexpr double modulus = 75e6, bond = 1e9;  // Pa; Pa/m, of the two cells beside a face about

struct Sphere {
  explicit Sphere(bool is_split) {
    for (std::size_t k = 0; k < mesh.region_names.size(); ++k)
      model.regions.push_back({.elasticity = from_young_poisson(modulus, 0.3)});
    model.boundary = {clamped("zmin"), clamped("zmax")};
    model.boundary.back().value = [](const Vector&, double) -> Vector { return {0.01, 0.002, 0.02}; };
    if (is_split) model.interfaces = {{.name = "surface", .law = {}, .faces = faces_around(mesh)}};
    unknowns = place_unknowns(mesh, elastic_body(model));
  }

  static std::vector<Index> faces_around(const Mesh& mesh) {
    std::vector<Index> faces;
    for (Index f = 0; f < mesh.n_interior_faces(); ++f)
      if ((mesh.cell_centre[mesh.owner[f]].norm() < 1.0) != (mesh.cell_centre[mesh.neighbour[f]].norm() < 1.0))
        faces.push_back(f);
    return faces;
  }

  /// Solved to 1e-8 with springs of this stiffness [Pa/m].
  Index iterations(double spring, std::string_view linear, std::vector<Vector>& u) const {
    const CellField<double> g(mesh.n_cells(), 1.0);
    MomentumSolver solver(mesh, unknowns, &linear_solver(linear));
    solver.set_moduli(CellField<IsotropicElasticity>(mesh.n_cells(), model.regions.front().elasticity), g);
    const std::size_t n = unknowns.split_faces.size();
    const Tensor K = spring * Tensor::Identity();
    if (n > 0)
      solver.set_springs(std::vector<FaceSpring>(n, {.stiffness = K, .offset = Vector::Zero(), .secant = K}),
                         std::vector<double>(n, bond));
    u.assign(unknowns.n_unknowns(), Vector::Zero());
    const Equilibrium at = solver.solve(1.0, {.ceiling = 1e-10, .floor = 1e-10}, u);
    EXPECT_TRUE(at.converged);
    return at.iterations;
  }

  Mesh mesh = tetrahedra_and_prisms();
  FractureModel model;
  Unknowns unknowns;
};

TEST(SplitCondensation, StiffSpringsTakeHardlyMoreIterations) {
  std::vector<Vector> u;
  const Index whole = Sphere(false).iterations(0.0, "multigrid", u);
  const Sphere split(true);
  for (const double spring : {1.0 * bond, 30.0 * bond, 1000.0 * bond})
    EXPECT_LE(split.iterations(spring, "multigrid", u), 2 * whole) << spring;
}

TEST(SplitCondensation, HasTheSolutionOfTheFactors) {
  const Sphere split(true);
  std::vector<Vector> by_cycles, by_factors;
  for (const double spring : {0.0, 0.1 * bond, 30.0 * bond}) {
    split.iterations(spring, "multigrid", by_cycles);
    split.iterations(spring, "direct", by_factors);
    for (Index i = 0; i < split.unknowns.n_nodes(); ++i) EXPECT_LE((by_cycles[i] - by_factors[i]).norm(), 1e-6 * 0.02);
  }
}

TEST(SplitCondensation, SolvesAsTheWholeMatrix) {
  const Sphere split(true);
  SplitCondensation condensation(split.mesh, split.unknowns);
  const Index n = split.unknowns.n_nodes(), n_kept = count_of(condensation.kept());
  ASSERT_EQ(n - n_kept, 2 * count_of(split.unknowns.split_faces));
  RandomNumbers random;
  BlockTriplets whole;
  for (Index i = 0; i < n; ++i) {
    const Tensor a = random.tensor();
    whole.diagonal.emplace_back(a * a.transpose() + 20.0 * Tensor::Identity());
  }
  std::vector<Vector> x(n), r(n), of_kept, again(n, Vector::Zero());
  for (Vector& at : x) at = random.vector();
  for (const Index f : split.unknowns.split_faces) {
    const Index P = split.mesh.owner[f], N = split.mesh.neighbour[f];
    const Index a = split.unknowns.node_of_face[f], b = split.unknowns.neighbour_node[f];
    whole.off_diagonal.push_back({P, a, random.tensor()});
    whole.off_diagonal.push_back({b, N, random.tensor()});
    whole.off_diagonal.push_back({a, b, random.tensor()});
  }
  const auto times = [](const BlockTriplets& matrix, const std::vector<Vector>& v) {
    std::vector<Vector> y(v.size());
    for (std::size_t i = 0; i < v.size(); ++i) y[i] = matrix.diagonal[i] * v[i];
    for (const auto& entry : matrix.off_diagonal) {
      y[entry.row] += entry.value * v[entry.column];
      y[entry.column] += entry.value.transpose() * v[entry.row];
    }
    return y;
  };
  r = times(whole, x);
  const BlockTriplets condensed = condensation.condense(whole);
  std::vector<Vector> x_kept;
  for (const Index i : condensation.kept()) x_kept.push_back(x[i]);
  condensation.condense(r, of_kept);
  const std::vector<Vector> image = times(condensed, x_kept);
  for (Index k = 0; k < n_kept; ++k) EXPECT_LE((image[k] - of_kept[k]).norm(), 1e-10);
  condensation.expand(x_kept, r, again);
  for (Index i = 0; i < n; ++i) EXPECT_LE((again[i] - x[i]).norm(), 1e-12);
}

}  // namespace
}  // namespace pfdm::this_file
