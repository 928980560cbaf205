// The work of the reactions is found again as elastic and surface energy as long as damage grows stably
// (literature.md 5.5).

#include "tests/verification/bar.h"
#include "tests/verification/bead.h"

namespace pfdm::verification::this_file {
namespace {

void expect_balance(const std::string& label, double coarse, double fine, double most, double factor) {
  report_row(label, {{"(W - E_el - E_frac)/W", coarse}, {"with half the increment", fine}});
  EXPECT_LE(std::abs(coarse), most) << label;
  EXPECT_LE(std::abs(fine), std::max(1e-5, factor * std::abs(coarse))) << label;
}

// The trapezoidal rule for the work leaves an error of second order in the increment.
TEST(EnergyBalance, HomogeneousBarOfAt2) {
  const Bar bar({.law = "AT2", .cells_per_length = 5, .length = 8.0, .pinned_ends = false});
  expect_balance("AT2 bar to beyond its strength", bar.run({{1.9, 10}}).back().imbalance,
                 bar.run({{1.9, 20}}).back().imbalance, 5e-3, 0.28);
}

TEST(EnergyBalance, SofteningBarOfAt1) {
  const Bar bar({.law = "AT1", .cells_per_length = 10, .length = 5.3});
  const auto imbalance = [&](Index n_steps) {
    const BarState last = bar.run({{0.99, 1}, {1.02, n_steps}}).back();
    EXPECT_LT(last.stress, 0.9);
    EXPECT_GT(last.fracture_energy, 0.1);
    return last.imbalance;
  };
  expect_balance("AT1 bar, softening", imbalance(3), imbalance(6), 1e-4, 0.4);
}

// Until shortly before the bead debonds.
double bead_imbalance(const Mesh& mesh, const std::string& split, Index n_steps) {
  FractureRun run(mesh, bead_model(mesh, split, 0.17), {},
                  {.initial_increment = 1.0 / n_steps, .maximum_increment = 1.0 / n_steps, .stops = {}});
  StepReport last;
  const auto step_done = [&](const FractureState&, const StepReport& report) { last = report; };
  run_to_end(run, step_done);
  EXPECT_GT(last.max_damage, 0.2);
  EXPECT_LT(last.max_damage, 0.9);
  return (last.energy.external_work - last.energy.elastic - last.energy.fracture) / last.energy.external_work;
}

// Between tetrahedra the driving energy is not exactly the slope of the discrete elastic energy: what is left does not
// vanish with the increment; how it falls with the cells has not been measured.
TEST(EnergyBalance, BeadBeforeItDebonds) {
  const Mesh mesh = sphere_in_cube(4, 8, 2.5, 0.4);
  for (const std::string split : {"none", "volumetric_deviatoric"}) {
    const double coarse = bead_imbalance(mesh, split, 5), fine = bead_imbalance(mesh, split, 10);
    report_row("bead, split " + split, {{"(W - E_el - E_frac)/W", coarse}, {"with half the increment", fine}});
    EXPECT_LE(std::abs(coarse), 1.5e-3);
    EXPECT_LE(std::abs(fine), 4e-4);
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
