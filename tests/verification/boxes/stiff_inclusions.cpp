// Boxes with stiff inclusions under mean strains: how many iterations they take, alone and in shells, and a cube that
// slides in its binder.

#include "mesh/generators/packed_spheres.h"
#include "physics/elasticity/effective_stiffness.h"
#include "tests/verification/box_paths.h"
#include "tests/verification/cohesive_blocks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

// Strains that are free take hardly more iterations than ones that are prescribed, those that the first ones found.
TEST(FreeStrains, TakeHardlyMoreIterations) {
  PackedSpheresSettings packing;
  packing.box.lower = Vector::Zero();
  packing.box.upper = Vector::Ones();
  packing.like.subdivision = 2;
  packing.like.region = "particle";
  packing.diameters = draw_diameters({.mean = 1.0}, 10, 0.3, true, 1);
  packing.gap = packing.wall_gap = 0.01;
  packing.edges_over_gap = 0.0;
  const Mesh mesh = make_packed_spheres(packing);
  FractureModel model = elastic_model({from_young_poisson(70e9, 0.3), from_young_poisson(75e6, 0.44)}, {});
  if (mesh.region_names.front() != "particle") std::swap(model.regions.front(), model.regions.back());
  const auto end_of = [&](const MeanPath& path) {
    load(model, mesh, path, "periodic");
    return follow(mesh, model, path, 1e-8).back();
  };
  const StepReport free = end_of(strains({{zz, {0.01}}}));
  MeanPath path{.points = {{}}};
  for (std::size_t k = 0; k < 6; ++k)
    path.points[0][k] = to_mandel(free.means->strain)[k] / mandel_factor(static_cast<int>(k));
  const StepReport prescribed = end_of(path);
  report_row(fmt::format("{} cells", mesh.n_cells()),
             {{"free", static_cast<double>(free.krylov_iterations)},
              {"prescribed", static_cast<double>(prescribed.krylov_iterations)}});
  EXPECT_LE((free.means->stress - prescribed.means->stress).norm(), 1e-5 * free.means->stress.norm());
  EXPECT_LE(static_cast<double>(free.krylov_iterations), 1.3 * static_cast<double>(prescribed.krylov_iterations));
  EXPECT_LE(prescribed.krylov_iterations, 110);  // up to 107 on meshes that differ by rounding
}

// A stiff core in a stiff shell turns with it as one body, whichever of the two is the stiffer. Where nodes between
// them moved twice as far it took 800 and 948 iterations.
TEST(StiffInclusions, TurnWithTheirShells) {
  PackedSpheresSettings packing;
  packing.box.lower = Vector::Zero();
  packing.box.upper = Vector::Ones();
  packing.like = {.subdivision = 2, .region = "core", .n_layers = 2, .layer_thickness = 0.03, .layer_region = "shell"};
  packing.diameters = draw_diameters({.mean = 1.0}, 10, 0.05, true, 1);
  packing.gap = packing.wall_gap = 0.01;
  packing.edges_over_gap = 0.0;
  const Mesh mesh = make_packed_spheres(packing);
  const auto iterations = [&](double core, double shell) {
    FractureModel model = elastic_model(std::vector(3, from_young_poisson(75e6, 0.44)), {});
    model.regions[mesh.region_index("core")].elasticity = from_young_poisson(core, 0.3);
    model.regions[mesh.region_index("shell")].elasticity = from_young_poisson(shell, 0.3);
    load(model, mesh, strains({{zz, {0.01}}}), "periodic");
    return static_cast<double>(follow(mesh, model, strains({{zz, {0.01}}}), 1e-8).back().krylov_iterations);
  };
  const double alike = iterations(70e9, 70e9), soft_shell = iterations(70e9, 5e9), soft_core = iterations(5e9, 70e9);
  report_row(fmt::format("{} cells", mesh.n_cells()),
             {{"of one material", alike}, {"softer shells", soft_shell}, {"softer cores", soft_core}});
  EXPECT_LE(alike, 100.0);
  EXPECT_LE(soft_shell, 2.7 * alike);
  EXPECT_LE(soft_core, 1.3 * alike);
}

// A stiff cube slides in a pressed binder that is sheared, and the box goes back to no strain. Friction holds it on its
// way; the pressure that it needs goes with the strain, and with it the stress.
TEST(SlidingCube, LosesItsStressWithItsStrain) {
  BoxHexesSettings settings;
  for (auto& axis : settings.axes) axis = {{.length = 1e-3, .n = 4}};
  Mesh mesh = make_box_hexes(settings);
  mesh.region_names = {"binder", "cube"};
  for (Index c = 0; c < mesh.n_cells(); ++c)
    mesh.region[c] = (mesh.cell_centre[c] - Vector::Constant(0.5e-3)).cwiseAbs().maxCoeff() < 0.25e-3 ? 1 : 0;
  // Of pressure and of shear, from 1 on to almost nothing: together, or one before the other. With a friction of 1 or
  // more the cube may also stay jammed where the pressure goes first (equilibrium.md).
  constexpr double last = 1e-6, least_that_jams = 1.0;
  const std::array<std::vector<double>, 2> ways[] = {
      {{{1.0, last}, {1.0, last}}}, {{{1.0, 1.0, last}, {1.0, last, last}}}, {{{1.0, last, last}, {1.0, 1.0, last}}}};
  for (const double friction : {0.6, 0.8, 2.0})
    for (const auto& [pressure, shear] : ways) {
      if (friction >= least_that_jams && pressure[1] < shear[1]) continue;
      FractureModel model = elastic_model({from_young_poisson(50e6, 0.4), from_young_poisson(1e9, 0.3)}, {});
      CohesiveSurface bond{.name = "bond", .law = law_of(linear_law()), .faces = {}};
      bond.law.friction = friction;
      for (Index f = 0; f < mesh.n_interior_faces(); ++f)
        if (mesh.region[mesh.owner[f]] != mesh.region[mesh.neighbour[f]]) {
          bond.faces.push_back(f);
          bond.at.push_back({.strength = 1e4, .toughness = 0.05, .stiffness = 1e12});
        }
      model.interfaces.push_back(std::move(bond));
      MeanPath path = strains({{zz, pressure}, {0, pressure}, {4, shear}});
      for (auto& point : path.points) point[zz] *= -0.05, point[0] *= -0.05, point[4] *= 0.1;
      load(model, mesh, path, "periodic");
      const std::vector<StepReport> steps = follow(mesh, model, path, 1e-10, 0.25);
      double most = 0.0;
      for (const StepReport& report : steps) most = std::max(most, report.means->stress.norm());
      const double left = steps.back().means->stress.norm() / most;
      report_row(fmt::format("friction {}, {} points", friction, pressure.size()),
                 {{"stress left at 1e-6 of the strain", left}});
      EXPECT_LE(left, 2.0 * last);
    }
}

}  // namespace
}  // namespace pfdm::verification::this_file
