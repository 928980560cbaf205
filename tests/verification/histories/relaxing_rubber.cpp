// Nearly incompressible bodies that relax, as rubber between bonded plates: the force falls as that of an elastic body
// of the moduli of the moment.

#include "mesh/dual.h"
#include "tests/verification/finite.h"
#include "tests/verification/histories/held_discs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace pfdm::verification::this_file {
namespace {

using namespace discs;

struct Pad {
  const char* cells;
  Mesh mesh;
};

std::vector<Pad> pads() {
  const auto flat = [](const Vector& s) -> Vector { return {s[0], s[1], s[2] / 3.0}; };
  return {{.cells = "prisms", .mesh = extruded_triangles(6, {0.0, 1.0 / 12.0, 1.0 / 6.0, 0.25, 1.0 / 3.0})},
          {.cells = "tetrahedra", .mesh = mapped_box({5, 5, 3}, flat, BoxCells::tetrahedra)},
          {.cells = "polyhedra", .mesh = barycentric_dual(mapped_box({5, 5, 3}, flat, BoxCells::tetrahedra))}};
}

// Pulled at once and held, in steps of at most half a relaxation time: the shear modulus falls to a 21st, and of nu =
// 0.46 the bulk modulus by a third.
TEST(RelaxingRubber, DiscsRelaxToTheElasticOnes) {
  constexpr double duration = 400.0;
  for (const double poisson : {0.46, 0.4997})
    for (const Index fine : {1, 2}) {
      const Mesh mesh = disc(20 * fine, 4 * fine);
      const IsotropicElasticity stiff = stiff_rubber(poisson);
      const double of_bulk = poisson < 0.47 ? stiff.bulk_modulus() / 3.0 : 0.0;
      const IsotropicElasticity soft{.lambda = stiff.bulk_modulus() - of_bulk - 2.0 * mu / 3.0, .mu = mu};
      PronyLaw law{.relaxed = soft, .shear = {{rubber_branch * mu, 1.0}}};
      if (of_bulk > 0.0) law.bulk = {{of_bulk, 3.0}};
      FractureRun run(mesh, disc_model(relaxing_region(law), pulled_at_once), closely, held(duration, 0.5));
      Pulled first, last;
      double account = 0.0;
      run_to_end(run, [&](const FractureState&, const StepReport& report) {
        if (report.step == 0) return;
        last = pulled(mesh, report);
        if (report.step == 1) first = last;
        account = std::max(account, std::abs(last.account));
      });
      const double due = pull_at_once(mesh, elastic_region(soft), 1.0).modulus;
      report_row(fmt::format("held disc, nu {}, {} cells", poisson, mesh.n_cells()),
                 {{"at once", first.modulus}, {"held", last.modulus}, {"relaxed", due}, {"account", account}});
      EXPECT_NEAR(last.modulus, due, 2e-4 * due);
      EXPECT_LE(account, fine == 1 ? 0.035 : 0.009);
    }
}

// Square pads, six times as wide as thick, of other cells. The prisms' surfaces are bonded as those of the hexahedra.
TEST(RelaxingRubber, PadsOfAnyCellsRelaxToTheElasticOnes) {
  constexpr double duration = 200.0;
  for (const double poisson : {0.46, 0.4997})
    for (const Pad& pad : pads()) {
      const PronyLaw law = relaxing_rubber(poisson);
      const auto pull = [&](const std::shared_ptr<const Material>& material) {
        FractureModel model =
            elastic_model({material ? material->elasticity() : law.relaxed},
                          {symmetry_on("xmin"), symmetry_on("ymin"),
                           displacement_on("zmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                           moved("zmax", {true, true, true}, [](const Vector&, double t) -> Vector {
                             return 1e-3 / 3.0 * pulled_at_once(t) * Vector::UnitZ();
                           })});
        model.regions[0].material = material;
        const LoadingSettings at_once{.initial_increment = 1.0, .maximum_increment = 1.0, .stops = {}};
        FractureRun run(pad.mesh, model, closely, material ? held(duration, 1.0) : at_once);
        double force = 0.0;
        run_to_end(run, [&](const FractureState&, const StepReport& report) {
          force = report.reaction[pad.mesh.patch_index("zmax")].z();
        });
        return force / (1e-3 * mu);
      };
      const double held = pull(make_prony(law)), due = pull(nullptr);
      report_row(fmt::format("held pad of {} {}, nu {}", pad.mesh.n_cells(), pad.cells, poisson),
                 {{"held", held}, {"relaxed", due}});
      EXPECT_NEAR(held, due, 1e-3 * due);
    }
}

// Held, let back and held: what is left of the account is that of the mesh.
TEST(RelaxingRubber, DiscsThatAreLetBackKeepTheirAccount) {
  constexpr double duration = 40.0, poisson = 0.4997;
  for (const Index fine : {1, 2}) {
    const Mesh mesh = disc(20 * fine, 4 * fine);
    const PronyLaw law = relaxing_rubber(poisson);
    const auto there_and_back = [](double t) {
      return t < 0.5 ? std::min(20.0 * t, 1.0) : std::max(1.0 - 20.0 * (t - 0.5), 0.0);
    };
    FractureRun run(mesh, disc_model(relaxing_region(law), there_and_back), closely,
                    {.initial_increment = 0.005,
                     .maximum_increment = 0.005,
                     .duration = duration,
                     .stops = {},
                     .is_proportional = false});
    double most = 0.0, left = 0.0;
    run_to_end(run, [&](const FractureState&, const StepReport& report) {
      most = std::max(most, report.energy.external_work);
      left = left_over({}, report.energy);
    });
    report_row(fmt::format("disc, let back, {} cells", mesh.n_cells()), {{"left of the greatest work", left / most}});
    EXPECT_LE(std::abs(left / most), fine == 1 ? 0.05 : 0.02);
  }
}

// Free to expand under a temperature that varies linearly: no stress, however long it relaxes.
TEST(RelaxingRubber, FreeBlocksUnderALinearTemperatureHaveNoStress) {
  constexpr double poisson = 0.4997, expansion = 1e-4;
  const IsotropicElasticity stiff = stiff_rubber(poisson);
  const PronyLaw law = relaxing_rubber(poisson);
  const Mesh mesh = mapped_box({6, 4, 4}, [](const Vector& s) -> Vector { return s; });
  FractureModel model = elastic_model({stiff}, {symmetry_on("xmin"), symmetry_on("ymin"), symmetry_on("zmin")});
  const auto most = [&](const std::shared_ptr<const Material>& material, const IsotropicElasticity& elasticity) {
    model.regions[0].material = material;
    model.regions[0].elasticity = elasticity;
    model.regions[0].expansion = expansion * Tensor::Identity();
    model.loads.temperature = [](const Vector& x, double t) { return 10.0 * pulled_at_once(t) * x[0]; };
    FractureRun run(mesh, model, closely, held(100.0, 1.0));
    const FractureState state = run_to_end(run, [](const FractureState&, const StepReport&) {});
    const OutputFields fields = run.output(state);
    double stress = 0.0;
    for (Index c = 0; c < mesh.n_cells(); ++c) stress = std::max(stress, fields.stress[c].norm());
    return stress / (mu * expansion * 10.0);
  };
  const double held_for_long = most(make_prony(law), stiff), relaxed = most(nullptr, law.relaxed);
  report_row("free block under a linear temperature",
             {{"stress over mu and strain", held_for_long}, {"elastic", relaxed}});
  EXPECT_NEAR(held_for_long, relaxed, 1e-3 * relaxed + 1e-6);
}

// By the correspondence principle the force under a held rise is the inverse Laplace transform of the elastic one,
// mu~(s)/s times the elastic modulus at K/mu~(s). What the latter differs by from the relaxed one is transformed by
// Stehfest's method with eight values (Comm. ACM 13 (1970) 47).
TEST(RelaxingRubber, ADiscRelaxesByTheCorrespondencePrinciple) {
  constexpr double poisson = 0.4997;
  const Mesh mesh = disc(20, 4);
  const double K = stiff_rubber(poisson).bulk_modulus();
  const auto elastic = [&](double modulus) {  // mean stress over strain and mu; of the same operator
    const PronyLaw law{.relaxed = {.lambda = K - 2.0 * modulus / 3.0, .mu = modulus}, .shear = {{1e-12 * mu, 1.0}}};
    return pull_at_once(mesh, relaxing_region(law), 1e13, closely).modulus;
  };
  const double relaxed = elastic(mu);
  const auto due = [&](double time) {
    constexpr std::array<double, 8> weights{-1.0 / 3.0,     145.0 / 3.0, -906.0,         16394.0 / 3.0,
                                            -43130.0 / 3.0, 18730.0,     -35840.0 / 3.0, 8960.0 / 3.0};
    double sum = 0.0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const double s = static_cast<double>(k + 1) * std::numbers::ln2 / time;
      const double modulus = 1.0 + rubber_branch * s / (s + 1.0);
      sum += weights[k] * (elastic(mu * modulus) - modulus * relaxed) / s;
    }
    return (1.0 + rubber_branch * std::exp(-time)) * relaxed + sum * std::numbers::ln2 / time;
  };
  const std::array times{0.5, 1.0, 2.0, 4.0, 8.0};
  std::size_t next = 0;
  constexpr double duration = 8.0;
  const PronyLaw law = relaxing_rubber(poisson);
  FractureRun run(mesh, disc_model(relaxing_region(law), pulled_at_once), closely,
                  held(duration, 0.05, {0.5, 1.0, 2.0, 4.0}));
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (next == times.size() || std::abs(duration * report.load - times[next]) > 1e-9) return;
    const double found = pulled(mesh, report).modulus, by_principle = due(times[next]);
    report_row(fmt::format("disc after {} relaxation times", times[next++]),
               {{"held", found}, {"by the correspondence principle", by_principle}});
    EXPECT_NEAR(found, by_principle, 0.002 * by_principle);
  });
  EXPECT_EQ(next, times.size());
}

}  // namespace
}  // namespace pfdm::verification::this_file
