// Beams of few or long cells: a cantilever of 25 x 1.5 mm, clamped at x = 0, under a force at its end, a moment there,
// or a load along it, against Timoshenko's beam (with a force w = P L^3/(3 E' I) + P L/(k mu h), k = 5/6; E' = E/(1 -
// nu^2) in plane strain); the plane field of a cantilever (Timoshenko, Goodier, Theory of Elasticity, art. 21), which
// is cubic; at finite strain the elastica (Mattiasson, Int. J. Numer. Methods Eng. 17 (1981) 145).

#include "solver/fracture/bending_words.h"
#include "solver/momentum/bending_layers.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pfdm::verification::this_file {
namespace {

constexpr double mm = 1e-3, E = 70e9, span = 25.0 * mm, height = 1.5 * mm, width = 1.0 * mm;
const double section = std::pow(height, 3) / 12.0;

enum class Load { tip, moment, distributed };

struct Beam {
  Index along = 0, across = 0;
  double nu = 0.3;
  bool plane_stress = false;
  Load load = Load::tip;
};

double timoshenko(const Beam& beam) {
  const double bending = (beam.plane_stress ? E : E / (1.0 - beam.nu * beam.nu)) * section;
  const double shear = 5.0 / 6.0 * E / (2.0 + 2.0 * beam.nu) * height;
  if (beam.load == Load::tip) return std::pow(span, 3) / (3.0 * bending) + span / shear;
  if (beam.load == Load::moment) return -std::pow(span, 2) / (2.0 * bending);
  return std::pow(span, 3) / (8.0 * bending) + span / (2.0 * shear);
}

std::vector<BoundaryCondition> clamped_at_x0(bool plane_stress) {
  const auto side = plane_stress ? plane_stress_on : plane_on;
  return {side("zmin"), side("zmax"), displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); })};
}

// Unit resultants per width.
BoundaryCondition traction_of(Load load) {
  if (load == Load::tip) return traction_on("xmax", [](const Vector&) -> Vector { return Vector::UnitY() / height; });
  if (load == Load::distributed)
    return traction_on("ymax", [](const Vector&) -> Vector { return Vector::UnitY() / span; });
  return traction_on("xmax",
                     [](const Vector& x) -> Vector { return (x.y() - height / 2.0) / section * Vector::UnitX(); });
}

Mesh mesh_of(Index along, Index across) {
  BoxHexesSettings box;
  box.axes[0] = {{span, along, 1.0}};
  box.axes[1] = {{height, across, 1.0}};
  box.axes[2] = {{width, 1, 1.0}};
  return make_box_hexes(box);
}

Index along_with(double ratio, Index across) {
  return static_cast<Index>(std::lround(span * static_cast<double>(across) / (ratio * height)));
}

Index iterations_of_all = 0;

/// Mean deflection of the end over Timoshenko's; with these stiffness factors in the cells, if any.
double deflection(const Beam& beam, const CellField<double>& g = {}) {
  const Mesh mesh = mesh_of(beam.along, beam.across);
  FractureModel model = elastic_model({from_young_poisson(E, beam.nu)}, clamped_at_x0(beam.plane_stress));
  model.boundary.push_back(traction_of(beam.load));
  const auto solution = solve_elastic(mesh, model, g, 1e-9);
  EXPECT_TRUE(solution->equilibrium.converged);
  iterations_of_all += solution->equilibrium.iterations;
  EXPECT_LT(energy_imbalance(mesh, *solution), 1e-6);
  if (beam.load != Load::moment) {
    EXPECT_LT(reaction_imbalance(mesh, *solution), 1e-6);
  }
  const auto end = static_cast<std::size_t>(&mesh.patch("xmax") - mesh.patches.data());
  return solution->solver->balance().patch_displacements(solution->u)[end].y() / timoshenko(beam);
}

// At nu = 0.45 the clamp, which Timoshenko's beam does not have, takes 1 to 1.5 %.
TEST(Bending, FourLayersOfCellsHalfToSixTimesAsLongAsThick) {
  for (const double nu : {0.0, 0.3, 0.45}) {
    double worst = 0.0;
    for (const double ratio : {0.5, 1.0, 2.0, 4.0, 6.0}) {
      Beam beam{.along = along_with(ratio, 4), .across = 4, .nu = nu};
      std::vector<std::pair<std::string, double>> row;
      for (const Load load : {Load::tip, Load::moment, Load::distributed}) {
        beam.load = load;
        row.emplace_back(load == Load::tip ? "force" : (load == Load::moment ? "moment" : "load"), deflection(beam));
        worst = std::max(worst, std::abs(row.back().second - 1.0));
      }
      report_row(fmt::format("nu = {}, {} x 4 cells, {} times as long as thick", nu, beam.along, ratio), row);
    }
    report_row("iterations so far", {{"n", static_cast<double>(iterations_of_all)}});
    EXPECT_LT(worst, nu > 0.4 ? 0.05 : 0.03) << nu;
  }
}

// One ring: 2.33, 1.341, 1.089, 0.967 times as stiff.
TEST(Bending, SixLayers) {
  for (const Index along : {12, 25, 42, 100})
    for (const bool plane_stress : {false, true}) {
      const double found = deflection({.along = along, .across = 6, .plane_stress = plane_stress});
      report_row(fmt::format("{} x 6 cells{}", along, plane_stress ? ", plane stress" : ""), {{"deflection", found}});
      EXPECT_NEAR(found, 1.0, 0.015);
    }
}

TEST(Bending, TwoToTwelveLayers) {
  for (const Index across : {2, 3, 5, 8, 12}) {
    const double square = deflection({.along = along_with(1.0, across), .across = across});
    const double flat = deflection({.along = along_with(4.0, across), .across = across});
    report_row(fmt::format("{} layers", across), {{"square cells", square}, {"four times as long as thick", flat}});
    EXPECT_NEAR(square, 1.0, 0.015) << across;
    EXPECT_NEAR(flat, 1.0, across > 2 ? 0.02 : 0.12) << across;  // with two layers 8 cells along the beam
  }
}

// In space each cell's gradient is that of one ring. The sides across z are planes of symmetry, so that the beam is
// that in plane strain.
TEST(Bending, InSpaceErrsAsTheFormulaSays) {
  for (const double nu : {0.0, 0.3})
    for (const Index across : {4, 6})
      for (const double ratio : {1.0, 2.0, 4.0}) {
        const Mesh mesh = mesh_of(along_with(ratio, across), across);
        FractureModel model = elastic_model(
            {from_young_poisson(E, nu)},
            {symmetry_on("zmin"), symmetry_on("zmax"),
             displacement_on("xmin", [](const Vector&) -> Vector { return Vector::Zero(); }), traction_of(Load::tip)});
        const auto solution = solve_elastic(mesh, model, {}, 1e-9);
        const auto end = static_cast<std::size_t>(&mesh.patch("xmax") - mesh.patches.data());
        const double tip = solution->solver->balance().patch_displacements(solution->u)[end].y();
        const double found = timoshenko({.nu = nu}) / tip - 1.0;
        const double due = largest_bending_error(mesh, solution->unknowns)->error;
        report_row(fmt::format("in space, nu = {}, {} layers, {} times as long as thick", nu, across, ratio),
                   {{"stiffness over the beam's, less 1", found}, {"formula", due}});
        EXPECT_NEAR(found, due, 0.02 + 0.25 * std::abs(due));
        const auto warning = bending_warning(mesh, model);
        ASSERT_TRUE(warning.has_value());
        EXPECT_NE(
            warning->find(fmt::format("about {:.0f} % too {}", 100.0 * std::abs(due), due > 0.0 ? "high" : "low")),
            std::string::npos)
            << *warning;
        model.boundary[0] = plane_on("zmin");
        model.boundary[1] = plane_on("zmax");
        EXPECT_FALSE(bending_warning(mesh, model).has_value());  // it fits cubics
        model.split = energy_split("spectral");
        EXPECT_TRUE(bending_warning(mesh, model).has_value());
        model.regions[0].stiffness =
            std::make_shared<const MandelMatrix>(stiffness_matrix(model.regions[0].elasticity));
        EXPECT_NE(bending_warning(mesh, model).value_or("").find("; elasticity that depends on the direction)"),
                  std::string::npos);
      }
}

// A body that has lost half of its stiffness everywhere bends twice as much.
TEST(Bending, OfEvenlyDamagedBeams) {
  const Beam beam{.along = 25, .across = 4};
  EXPECT_NEAR(deflection(beam, CellField<double>(100, 0.5)) / deflection(beam), 2.0, 1e-6);
}

// In plane stress: the displacements of the field at both ends, its sides free.
TEST(Bending, ConvergesToTheCubicFieldOfACantilever) {
  const double nu = 0.3, load = 1.0 / (6.0 * E * section), D = height;
  const auto exact = [=](const Vector& place) -> Vector {
    const double x = place.x(), y = place.y() - D / 2.0;
    return load * Vector(-y * ((6.0 * span - 3.0 * x) * x + (2.0 + nu) * (y * y - D * D / 4.0)),
                         3.0 * nu * y * y * (span - x) + (4.0 + 5.0 * nu) * D * D * x / 4.0 + (3.0 * span - x) * x * x,
                         0.0);
  };
  std::vector<double> errors;
  for (const Index across : {2, 4, 8}) {
    const Mesh mesh = mesh_of(5 * across, across);
    const FractureModel model =
        elastic_model({from_young_poisson(E, nu)}, {plane_stress_on("zmin"), plane_stress_on("zmax"),
                                                    displacement_on("xmin", exact), displacement_on("xmax", exact)});
    errors.push_back(displacement_error(mesh, *solve_elastic(mesh, model), exact));
    report_row(fmt::format("{} x {} cells", 5 * across, across), {{"displacement", errors.back()}});
  }
  EXPECT_LT(errors[0], 1e-2);
  EXPECT_LT(errors[1], errors[0] / 4.0);
  EXPECT_LT(errors[2], errors[1] / 4.0);
}

}  // namespace
}  // namespace pfdm::verification::this_file
