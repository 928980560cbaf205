// Beams of few or long cells at finite strain (layer_gradients.h, turned_weights.h): a cantilever of 25 x 1.5 mm under
// a dead load P at its end, P L^2 = 3 E' I (E' = E/(1 - nu^2) in plane strain, I of the height cubed), neo-Hookean,
// against elements of third and fourth degree, which agree to 2e-4 of the length; the limit of small strain; stretched
// beams that are turned.

#include "solver/fracture/words/bending_words.h"
#include "tests/verification/finite.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

constexpr double mm = 1e-3, E = 1e6, span = 25.0 * mm, height = 1.5 * mm;

struct Cantilever {
  bool in_space = false;
  double nu = 0.3;
  Index across = 4;
  double ratio = 1.0;       // of the cells' length to the thickness of a layer
  double load = 3.0;        // P L^2/(E' I)
  bool held_across = true;  // the clamp of a plane beam, across its plane

  Mesh mesh() const {
    BoxHexesSettings box;
    box.axes[0] = {{span, static_cast<Index>(std::lround(span * double(across) / (ratio * height))), 1.0}};
    box.axes[1] = {{height, across, 1.0}};
    box.axes[2] = {{in_space ? height : 1.0 * mm, in_space ? 2 : 1, 1.0}};
    return make_box_hexes(box);
  }
  std::vector<BoundaryCondition> boundary() const {
    const double modulus = in_space ? E : E / (1.0 - nu * nu);
    const double traction = load * modulus * height * height / (12.0 * span * span);
    const auto nothing = [](const Vector&, double) -> Vector { return Vector::Zero(); };
    std::vector<BoundaryCondition> on{moved("xmin", {true, true, held_across}, nothing),
                                      {.patch = "xmax", .value = [traction](const Vector&, double t) -> Vector {
                                         return t * traction * Vector::UnitY();
                                       }}};
    if (!in_space) on.insert(on.end(), {plane_on("zmin"), plane_on("zmax")});
    return on;
  }
};

struct Bent {
  Vector end = Vector::Zero();  // mean displacement of the end over the length
  double energy = 0.0, work = 0.0;
  Index iterations = 0;
};

Bent bend(const Cantilever& beam, Index steps) {
  const Mesh mesh = beam.mesh();
  const FractureModel model = finite_body(
      mesh, make_hyperelastic("neo_hookean", {.elasticity = from_young_poisson(E, beam.nu)}), beam.boundary());
  EXPECT_EQ(bending_warning(mesh, model).has_value(), beam.ratio > 6.0);
  const Drawn drawn = draw(mesh, model, steps);
  const auto end = mesh.patch_index("xmax");
  EXPECT_LT((drawn.force(mesh, "xmin") + drawn.force(mesh, "xmax")).norm(), 1e-6 * drawn.force(mesh, "xmax").norm());
  return {.end = drawn.report.patch_displacement[end] / span,
          .energy = drawn.report.energy.elastic,
          .work = drawn.report.energy.external_work,
          .iterations = drawn.krylov_iterations};
}

// Gradients of one ring: 0.4657 with cells 4 times as long as thick in plane strain, 0.4529 in space.
TEST(FiniteBending, CantileversAsElementsOfHighDegree) {
  struct Row {
    Cantilever beam;
    double along, down;
  };
  for (const auto& [beam, along, down] : {Row{{.ratio = 4.0}, -0.25490, 0.60542},
                                          {{.ratio = 6.0}, -0.25490, 0.60542},
                                          {{.in_space = true, .ratio = 4.0}, -0.25417, 0.60432},
                                          {{.nu = 0.49, .ratio = 4.0}, -0.25325, 0.60379}}) {
    const Bent bent = bend(beam, 6);
    report_row(fmt::format("{}, nu {}, {} layers, cells {} times as long as thick",
                           beam.in_space ? "in space" : "plane", beam.nu, beam.across, beam.ratio),
               {{"along", bent.end.x()}, {"down", bent.end.y()}, {"iterations", double(bent.iterations)}});
    EXPECT_NEAR(bent.end.y() / down, 1.0, 0.012);
    EXPECT_NEAR(bent.end.x() / along, 1.0, 0.025);
  }
}

// What is prescribed across a plane beam changes nothing.
TEST(FiniteBending, ClampsOfPlaneBeamsAreHeldWithinTheirPlane) {
  for (const double nu : {0.3, 0.49}) {
    Cantilever beam{.nu = nu, .ratio = 4.0, .load = 0.3};
    const Bent all = bend(beam, 1);
    beam.held_across = false;
    const Bent within = bend(beam, 1);
    EXPECT_EQ(all.end.y(), within.end.y()) << nu;
    EXPECT_EQ(all.energy, within.energy) << nu;
  }
}

// Energies of bent cells are those of their mean gradient and of how it varies within them. Without the latter 6 % are
// missing with four layers.
TEST(FiniteBending, SmallLoadsBendAsTheLinearProgramAndStoreTheirWork) {
  for (const bool in_space : {true, false}) {
    const Cantilever beam{.in_space = in_space, .ratio = 4.0, .load = 1e-6};
    const Mesh mesh = beam.mesh();
    const auto linear = solve_elastic(mesh, elastic_model({from_young_poisson(E, beam.nu)}, beam.boundary()));
    const auto end = mesh.patch_index("xmax");
    const double due = linear->solver->balance().patch_displacements(linear->u)[end].y() / span;
    const Bent bent = bend(beam, 1);
    report_row(in_space ? "in space" : "plane",
               {{"end over that of the linear program", bent.end.y() / due}, {"energy", bent.energy / bent.work}});
    EXPECT_NEAR(bent.end.y() / due, 1.0, in_space ? 1e-5 : 0.02);  // in the plane that one fits cubics
    EXPECT_NEAR(bent.energy / bent.work, 1.0, 0.025);
  }
}

// F = R U, U the stretches of a bar that is drawn, on both ends: the free sides follow, however far R turns.
TEST(FiniteBending, StretchedBeamsThatAreTurnedAreExact) {
  const double stretch = 1.4, angle = 2.0;
  const IsotropicElasticity rubber = from_young_poisson(E, 0.3);
  const auto material = make_hyperelastic("neo_hookean", {.elasticity = rubber});
  for (const double by : {1.0, stretch}) {
    double low = 0.5, high = 1.5;  // the stretch across, without stress there
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high), J = by * middle * middle;
      (rubber.mu * (middle - 1.0 / middle) + rubber.lambda * (J - 1.0) * by * middle > 0.0 ? high : low) = middle;
    }
    const auto H = [=](double t) -> Tensor {
      const double along = 1.0 + t * (by - 1.0), across = t < 1.0 ? 1.0 + t * (low - 1.0) : low;
      const Tensor U = Vector(along, across, across).asDiagonal();
      return Eigen::AngleAxisd(t * angle, Vector(0.0, 0.6, 0.8)).toRotationMatrix() * U - Tensor::Identity();
    };
    const Mesh mesh = Cantilever{.in_space = true, .ratio = 4.0}.mesh();
    const auto held = [&](const char* patch) {
      return moved(patch, {true, true, true}, [H](const Vector& x, double t) -> Vector { return H(t) * x; });
    };
    const FractureModel model = finite_body(mesh, material, {held("xmin"), held("xmax")});
    FractureRun run(mesh, model, {.equilibrium_tolerance = 1e-12},
                    {.initial_increment = 0.125, .maximum_increment = 0.125, .stops = {}});
    const OutputFields fields = run.output(run_to_end(run, [](const FractureState&, const StepReport&) {}));
    const Tensor F = Tensor::Identity() + H(1.0), P = material->stress(H(1.0), {});
    const Tensor sigma = P * F.transpose() / F.determinant();
    double F_error = 0.0, stress_error = 0.0;
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      F_error = std::max(F_error, (fields.deformation_gradient[c] - F).norm());
      stress_error = std::max(stress_error, (fields.stress[c] - sigma).norm() / E);
    }
    report_row(fmt::format("turned by {} rad, stretched to {}", angle, by), {{"F", F_error}, {"stress", stress_error}});
    EXPECT_LT(F_error, 1e-8);
    EXPECT_LT(stress_error, 1e-8);
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
