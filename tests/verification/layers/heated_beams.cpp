// Beams under a temperature that varies linearly across them: they bend to parabolas, without stress but for that which
// plane strain has across the plane. (Boley, Weiner, Theory of Thermal Stresses, 1960, section 9.2.)

#include "physics/materials/hyperelastic.h"
#include "tests/verification/finite_solutions.h"
#include "tests/verification/layers/eigenstrain_bodies.h"
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

// Held at its ends: a beam in plane stress stores E (alpha T)^2/2 whatever Poisson's ratio, one in plane strain twice
// that over 1 - nu; all of it drives damage where there is no split.
TEST(HeatedBeams, ThatAreHeldDriveDamageByWhatTheyStore) {
  constexpr double alpha = 1e-5;
  for (const bool in_plane_stress : {true, false})
    for (const double nu : {0.0, 0.3, 0.45}) {
      const IsotropicElasticity steel = from_young_poisson(200e9, nu);
      BoxHexesSettings box;
      box.axes = {{{{12.0, 12, 1.0}}, {{1.0, 4, 1.0}}, {{1.0, 1, 1.0}}}};
      const Mesh mesh = make_box_hexes(box);
      const auto side = in_plane_stress ? plane_stress_on : plane_on;
      const double stress = -steel.young_modulus() * alpha / (in_plane_stress ? 1.0 : 1.0 - nu),
                   slope = (1.0 + nu) * alpha / (in_plane_stress ? 1.0 : 1.0 - nu);
      const auto at_end = [=](const Vector& x, double t) -> Vector {  // its traction along, its displacement across
        const double y = x[1] - 0.5;
        return t * Vector(stress * y, 0.5 * slope * y * y, 0.0);
      };
      FractureModel model = elastic_model(
          {steel}, {symmetry_on("xmin"), moved("xmax", {false, true, false}, at_end), side("zmin"), side("zmax")});
      model.regions[0].damageable = true;
      model.regions[0].Gc = model.regions[0].ell = 1.0;
      model.regions[0].eigenstrain = std::make_shared<const LoadField<Tensor>>(
          [](const Vector& x, double t) -> Tensor { return t * alpha * (x[1] - 0.5) * Tensor::Identity(); });
      const Answer answer = equilibrium(mesh, model, CellField<double>(mesh.n_cells(), 0.0));
      const double modulus = in_plane_stress ? 0.5 * steel.young_modulus() : steel.young_modulus() / (1.0 - nu);
      double wrong = 0.0, largest = 0.0;
      for (Index c = 0; c < mesh.n_cells(); ++c) {
        const double due = modulus * std::pow(alpha * (mesh.cell_centre[c][1] - 0.5), 2);
        const double stored = answer.stored[c] / mesh.cell_volume[c];
        wrong = std::max({wrong, std::abs(answer.driving[c] - due), std::abs(stored - due)});
        largest = std::max(largest, due);
      }
      report_row(fmt::format("held, {}, nu {}", in_plane_stress ? "plane stress" : "plane strain", nu),
                 {{"energies", wrong / largest}});
      EXPECT_LT(wrong, 1e-7 * largest) << nu;
    }
}

}  // namespace
}  // namespace pfdm::verification::this_file
