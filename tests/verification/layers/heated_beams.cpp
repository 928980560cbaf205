// Beams under a temperature that varies linearly across them: they bend to parabolas, without stress but for that which
// plane strain has across the plane. (Boley, Weiner, Theory of Thermal Stresses, 1960, section 9.2.)

#include "physics/materials/hyperelastic.h"
#include "tests/verification/finite_solutions.h"
#include "tests/verification/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pfdm::verification::this_file {
namespace {

enum class BeamIn { plane_stress, plane_strain, space, finite_strain };

const char* name_of(BeamIn in) {
  switch (in) {
    case BeamIn::plane_stress: return "plane stress";
    case BeamIn::plane_strain: return "plane strain";
    case BeamIn::space: return "space";
    case BeamIn::finite_strain: return "finite strain";
  }
  return "";
}

struct Beam {
  BeamIn in = BeamIn::plane_stress;
  Index layers = 4, along = 12;
  double nu = 0.3;
};

struct Bent {
  double displacement = 0.0;  // its error over the largest displacement
  double stress = 0.0;        // its largest error, over E alpha dT
};

Bent heat(const Beam& beam) {
  constexpr double length = 12.0, height = 1.0, width = 0.5, alpha = 1e-5, dT = 1.0;
  const bool in_space = beam.in == BeamIn::space;
  const IsotropicElasticity steel = from_young_poisson(200e9, beam.nu);
  BoxHexesSettings box;
  box.axes[0] = {{length, beam.along, 1.0}};
  box.axes[1] = {{height, beam.layers, 1.0}};
  box.axes[2] = {{width, in_space ? 2 : 1, 1.0}};
  const Mesh mesh = make_box_hexes(box);
  const double slope = (beam.in == BeamIn::plane_strain ? 1.0 + beam.nu : 1.0) * alpha * dT / height;
  const auto exact = [slope, in_space](const Vector& x) -> Vector {
    const double y = x[1] - 0.5, z = in_space ? x[2] : 0.0;
    return {slope * x[0] * y, 0.5 * slope * (y * y - x[0] * x[0] - z * z), slope * y * z};
  };
  std::vector<BoundaryCondition> boundary{
      symmetry_on("xmin"), moved("xmax", {false, true, false}, [exact](const Vector& x, double t) -> Vector {
        return t * exact(x)[1] * Vector::UnitY();
      })};
  if (in_space)
    boundary.push_back(symmetry_on("zmin"));
  else if (beam.in == BeamIn::plane_strain)
    boundary.insert(boundary.end(), {plane_on("zmin"), plane_on("zmax")});
  else
    boundary.insert(boundary.end(), {plane_stress_on("zmin"), plane_stress_on("zmax")});
  FractureModel model = elastic_model({steel}, std::move(boundary));
  if (beam.in == BeamIn::finite_strain)
    model.regions[0].material = make_hyperelastic("neo_hookean", {.elasticity = steel});
  model.regions[0].expansion = alpha * Tensor::Identity();
  model.loads.temperature = [](const Vector& x, double t) { return t * dT * (x[1] - 0.5) / height; };
  const Finished done = solve(mesh, model, 1, beam.in == BeamIn::finite_strain ? 1e-8 : 1e-12);
  Bent bent;
  double largest = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector &x = mesh.cell_centre[c], u = exact(x);
    largest = std::max(largest, u.norm());
    bent.displacement = std::max(bent.displacement, (done.fields.displacement[c] - u).norm());
    Tensor stress = done.fields.stress[c];
    if (beam.in == BeamIn::plane_strain) stress(2, 2) += steel.young_modulus() * alpha * dT * (x[1] - 0.5) / height;
    bent.stress = std::max(bent.stress, stress.norm());
  }
  bent.displacement /= largest;
  bent.stress /= steel.young_modulus() * alpha * dT;
  report_row(fmt::format("{}, {} layers, {} cells along, nu {}", name_of(beam.in), beam.layers, beam.along, beam.nu),
             {{"displacement", bent.displacement}, {"stress", bent.stress}});
  return bent;
}

TEST(HeatedBeams, BendWithoutStress) {
  for (const BeamIn in : {BeamIn::plane_stress, BeamIn::plane_strain, BeamIn::space})
    for (const Beam& beam : {Beam{in, 2, 12}, {in, 4, 12}, {in, 4, 48}, {in, 6, 12}}) {
      const Bent bent = heat(beam);
      EXPECT_LT(bent.displacement, 1e-8);
      EXPECT_LT(bent.stress, 1e-8);
    }
}

// Turned by up to 1.2e-4, the square of which is 7e-4 of the strain.
TEST(HeatedBeams, BendAtFiniteStrain) {
  for (const Beam& beam : {Beam{BeamIn::finite_strain, 4, 12}, {BeamIn::finite_strain, 6, 48}}) {
    const Bent bent = heat(beam);
    EXPECT_LT(bent.displacement, 1e-4);
    EXPECT_LT(bent.stress, 7e-4);
  }
}

// With pressures.
TEST(HeatedBeams, OfRubberBendWithoutStress) {
  for (const BeamIn in : {BeamIn::plane_strain, BeamIn::space}) {
    const Bent bent = heat({.in = in, .layers = 4, .along = 12, .nu = 0.49});
    EXPECT_LT(bent.displacement, 1e-8);
    EXPECT_LT(bent.stress, 1e-8);
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
