// Cantilevers in space of prisms, tetrahedra and polyhedra, which bend by gradients of one ring: what is said of their
// errors. The sides across z are planes of symmetry, so that Timoshenko's beam is that in plane strain (cantilever.h).

#include "solver/fracture/words/bending_words.h"
#include "solver/momentum/bending/slender_layers.h"
#include "tests/verification/layers/cantilever.h"
#include "tests/verification/slender/cell_beams.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::cantilever;

struct Row {
  BoxCut cut;
  std::string name, cells;
  bool alternates;
  double part;  // of the measured error by which the formula may differ
};

// The error that a fifth of the surface exceeds.
double formula(const Mesh& mesh, const FractureModel& model, double nu) {
  std::vector<double> errors;
  for (const SlenderLayers& at : slender_layers(mesh, place_unknowns(mesh, elastic_body(model))))
    errors.push_back(at.error(nu));
  std::ranges::sort(errors, {}, [](double error) { return std::abs(error); });
  return errors[errors.size() * 4 / 5];
}

// Also that they converge: with short cycles half of them did not in 2,000 iterations.
TEST(SlenderBodies, ErrAsTheFormulasSay) {
  for (const Row& row : {Row{BoxCut::prisms_across, "prisms across", "prisms", false, 0.4},
                         {BoxCut::prisms_along, "prisms along", "prisms", false, 0.4},
                         {BoxCut::prisms_along, "prisms along, alternating", "prisms", true, 0.4},
                         {BoxCut::prisms_within, "prisms within", "prisms", false, 0.5},
                         {BoxCut::six_tetrahedra, "tetrahedra", "tetrahedra", false, 0.4},
                         {BoxCut::polyhedra, "polyhedra", "polyhedra", false, 0.9}})
    for (const double nu : {0.0, 0.3, 0.45})
      for (const Index across : {2, 4, 8})
        for (const double ratio : {1.0, 2.0, 4.0}) {
          if (ratio > across) continue;
          const double layer = height / static_cast<double>(across);
          const Mesh mesh = make_cell_beam({.cut = row.cut,
                                            .boxes = {along_with(ratio, across), across, 1},
                                            .size = {span, height, layer},
                                            .alternates = row.alternates});
          const FractureModel model =
              elastic_model({from_young_poisson(E, nu)},
                            {symmetry_on("zmin"), symmetry_on("zmax"),
                             displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                             traction_of(Load::tip)});
          const auto solution = solve_elastic(mesh, model, {}, 1e-8);
          EXPECT_TRUE(solution->equilibrium.converged);
          EXPECT_LT(solution->equilibrium.iterations, 1000);
          const auto end = mesh.patch_index("xmax");
          // the traction on the end is 1 N over its height, and the beam's deflection by 1 N per width
          const double deflection = solution->solver->balance().patch_displacements(solution->u)[end].y();
          const double found = timoshenko({.nu = nu}) / deflection - 1.0;
          const double due = formula(mesh, model, nu);
          report_row(
              fmt::format("{}, nu {}, {} layers of boxes {} times as long as thick", row.name, nu, across, ratio),
              {{"stiffness, less 1", found}, {"formula", due}});
          EXPECT_NEAR(found, due, std::max(across == 2 ? 0.1 : 0.04, row.part * std::abs(found)));
          const auto warning = bending_warning(mesh, model);
          ASSERT_EQ(warning.has_value(), std::abs(due) > 0.04);
          if (!warning) continue;
          EXPECT_GT(std::abs(found), 0.03) << *warning;
          EXPECT_EQ(found > 0.0, due > 0.0);
          EXPECT_NE(warning->find(fmt::format("layers of {} ", row.cells)), std::string::npos) << *warning;
          EXPECT_NE(warning->find(fmt::format("about {:.0f} % too {} (as measured", 100.0 * std::abs(due),
                                              due > 0.0 ? "high" : "low")),
                    std::string::npos)
              << *warning;
        }
}

}  // namespace
}  // namespace pfdm::verification::this_file
