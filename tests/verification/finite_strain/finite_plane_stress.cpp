// Plane stress at finite strain: sheets of every law beside a block that is free across, the limit of small strain,
// what it is not combined with. Damaged sheets: finite_damaged_sheets.cpp.

#include "physics/error.h"
#include "solver/fracture/cells/cell_stiffness.h"
#include "solver/fracture/cells/finite_cells.h"
#include "tests/verification/cohesive_blocks.h"
#include "tests/verification/finite.h"
#include "tests/verification/finite_sheets.h"
#include "tests/verification/noise.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::sheets;

// A stretch of 1.8, a shear, a contraction.
TEST(FinitePlaneStress, ASheetOfEachLawIsABlockThatIsFreeAcross) {
  const Tensor H = (Tensor() << 0.8, 0.3, 0.0, -0.1, -0.2, 0.0, 0.0, 0.0, 0.0).finished();
  const Mesh mesh = sheet(3);
  for (const char* name : {"neo_hookean", "mooney_rivlin", "ogden", "lopez_pamies"}) {
    const auto material = law_of(name);
    const Drawn thin = draw(mesh, finite_body(mesh, material, stretched(H, true)), 2, 1e-11);
    const Drawn block = draw(mesh, finite_body(mesh, material, stretched(H, false)), 2, 1e-11);
    const double force =
        (thin.force(mesh, "xmax") - block.force(mesh, "xmax")).norm() / block.force(mesh, "xmax").norm();
    const double energy = thin.report.energy.elastic / block.report.energy.elastic - 1.0;
    report_row(fmt::format("sheet of {}", name), {{"force", force}, {"energy", energy}});
    EXPECT_LE(force, 1e-8);
    EXPECT_NEAR(energy, 0.0, 1e-8);
  }
}

// By hand: neo-Hookean in uniaxial tension to a stretch of 2; P_xx and the contraction across.
TEST(FinitePlaneStress, UniaxialTensionIsTheClosedForm) {
  const Mesh mesh = sheet(2);
  std::vector<BoundaryCondition> boundary{
      moved("xmax", {true, false, false}, [](const Vector&, double t) -> Vector { return t * Vector::UnitX(); }),
      symmetry_on("xmin"), symmetry_on("ymin"), plane_stress_on("zmin"), plane_stress_on("zmax")};
  FractureRun run(mesh, finite_body(mesh, law_of("neo_hookean"), boundary), {.equilibrium_tolerance = 1e-11},
                  {.initial_increment = 0.5, .maximum_increment = 0.5, .stops = {}});
  StepReport last;
  const FractureState end = run_to_end(run, [&](const FractureState&, const StepReport& report) { last = report; });
  double low = 0.5, high = 1.0;  // stretch across
  const auto stress_across = [](double s) {
    return rubber.mu * (s - 1.0 / s) + rubber.lambda * (2.0 * s * s - 1.0) * 2.0 * s;
  };
  for (int i = 0; i < 100; ++i) (stress_across(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
  const double J = 2.0 * low * low, P = rubber.mu * (2.0 - 0.5) + rubber.lambda * (J - 1.0) * J / 2.0;
  const double force = last.reaction[mesh.patch_index("xmax")].x() / 0.1;
  const OutputFields fields = run.output(end);
  report_row("uniaxial", {{"force", force / P - 1.0},
                          {"stretch across", fields.deformation_gradient[0](2, 2) / low - 1.0},
                          {"stress across / P", fields.stress[0](2, 2) / P}});
  EXPECT_NEAR(force / P, 1.0, 1e-9);
  EXPECT_NEAR(fields.deformation_gradient[0](2, 2) / low, 1.0, 1e-9);
  EXPECT_NEAR(fields.stress[0](2, 2) / P, 0.0, 1e-9);
}

TEST(FinitePlaneStress, IsThatOfSmallStrainWhereItIsSmall) {
  const Mesh mesh = sheet(8);
  const FractureModel finite = finite_body(mesh, law_of("neo_hookean"), bent(1e-7));
  const FractureModel small = elastic_model({rubber}, bent(1e-7));
  const Drawn a = draw(mesh, finite, 1, 1e-10), b = draw(mesh, small, 1, 1e-10);
  double u_error = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    u_error = std::max(u_error, (a.state.displacement[c] - b.state.displacement[c]).norm() / 1e-7);
  const double force = (a.force(mesh, "xmax") - b.force(mesh, "xmax")).norm() / b.force(mesh, "xmax").norm();
  report_row("small strain", {{"displacement", u_error}, {"force", force}});
  EXPECT_LE(u_error, 1e-6);
  EXPECT_LE(force, 1e-6);
}

TEST(FinitePlaneStress, WhatItIsNotCombinedWithIsRefused) {
  const Mesh mesh = sheet(2);
  const auto refusal = [&](const FractureModel& model) -> std::string {
    try {
      const FractureRun run(mesh, model, {}, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  FractureModel model = finite_body(mesh, law_of("neo_hookean"), bent(0.1));
  EXPECT_EQ(refusal(model), "");
  model.regions[0].damageable = true, model.regions[0].Gc = 1.0, model.regions[0].ell = 1.0;
  model.crack = &crack_geometry("AT2");
  model.degradation = degradation("quadratic");
  model.split = energy_split("volumetric_deviatoric");
  EXPECT_THAT(refusal(model), testing::HasSubstr("only be combined with the energy split \"none\""));
  const auto stiff = make_hyperelastic("saint_venant_kirchhoff", {.elasticity = from_young_poisson(1e6, 0.3)});
  EXPECT_THAT(refusal(finite_body(mesh, stiff, bent(0.1))), testing::HasSubstr("saint_venant_kirchhoff"));
  std::vector<BoundaryCondition> inflated = bent(0.1);
  inflated.back().pressure = [](const Vector&, double t) { return t; };
  EXPECT_THAT(refusal(finite_body(mesh, law_of("neo_hookean"), inflated)),
              testing::HasSubstr("cannot be combined with the pressure on patch"));
  FractureModel glued_sheet = finite_body(mesh, law_of("neo_hookean"), bent(0.1));
  const auto& linear = find_by_name(traction_separation_laws(), "linear", "law");
  glue(glued_sheet, mesh, verification::law_of(linear), glued, Vector::UnitX(),
       [](const Vector& x) { return std::abs(x.x() - 0.5) < 1e-9; });
  EXPECT_THAT(refusal(glued_sheet), testing::HasSubstr("plane stress cannot be combined with cohesive interfaces"));
}

}  // namespace
}  // namespace pfdm::verification::this_file
