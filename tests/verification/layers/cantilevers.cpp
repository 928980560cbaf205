// A double cantilever beam, upper half, with the dimensions of the case dcb, opened without breaking: its energy
// release rate by G-theta and by its compliance. The corrected beam (Williams, J. Compos. Mater. 23 (1989) 330;
// Hashemi, Kinloch, Williams, Proc. R. Soc. A 427 (1990) 173) has the opening D = 8 P (a + chi h)^3/(E' B h^3) and G =
// 12 P^2 (a + chi h)^2/(E' B^2 h^3).

#include "postproc/fields/energy_release_rate.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::verification::this_file {
namespace {

constexpr double mm = 1e-3, E = 126e9, nu = 0.3, thickness = 1.0 * mm;
constexpr double arm = 2.0 * mm, band = 0.05 * mm;  // half of the band

struct CorrectedBeam {
  double plane_modulus = E / (1.0 - nu * nu), height = arm + band, chi = 0.0;

  CorrectedBeam() {
    const double shear = E / (2.0 * (1.0 + nu)), gamma = 1.18 * plane_modulus / shear;
    chi = std::sqrt(plane_modulus / (11.0 * shear) * (3.0 - 2.0 * std::pow(gamma / (1.0 + gamma), 2)));
  }
  double effective(double a) const { return a + chi * height; }
  double compliance(double a) const {
    return 8.0 * std::pow(effective(a), 3) / (plane_modulus * thickness * std::pow(height, 3));
  }
  double release_rate(double force, double a) const {
    return 12.0 * std::pow(force * effective(a) / thickness, 2) / (plane_modulus * std::pow(height, 3));
  }
};

struct Cantilever {
  double compliance = 0.0;  // D/P [m/N]
  double G = 0.0;           // G-theta at P = 1 N, of both halves [J/m^2]
};

// Upper half of the specimen with its slot of length a, opened elastically.
Cantilever open(double a) {
  BoxHexesSettings box;
  box.axes[0] = {{29.0 * mm, 100, 0.2}, {2.0 * mm, 32, 1.0}, {69.0 * mm, 30, 40.0}};  // the same for every a
  box.axes[1] = {{arm + band, 24, 25.0}};
  box.axes[2] = {{thickness, 1, 1.0}};
  box.patches = {{"slot", {0.0, 0.0, 0.0}, {a, 0.0, thickness}}};
  const Mesh mesh = make_box_hexes(box);
  FractureModel model = elastic_model(
      {from_young_poisson(E, nu)}, {plane_on("zmin"), plane_on("zmax"), symmetry_on("ymin"),
                                    displacement_on("xmax", [](const Vector&) -> Vector { return Vector::Zero(); })});
  model.boundary.push_back({.patch = "xmin",
                            .kind = BoundaryCondition::Kind::components,
                            .displacement_prescribed = {false, true, false},
                            .value = [](const Vector&, double) { return Vector(0.0, 0.5 * mm, 0.0); }});
  const auto solution = solve_elastic(mesh, model);
  const auto pulled = mesh.patch_index("xmin");
  const double force = reactions(mesh, *solution)[pulled].y();
  OutputFields fields;
  fields.damage = CellField<double>(mesh.n_cells(), 0.0);
  fields.strain = solution->cells.strain;
  fields.gradient = solution->cells.gradient;
  fields.stress = solution->cells.stress;
  const TipRegion region{
      .name = "half", .point = {a, 0.0, 0.0}, .shape = &region_shapes().front(), .inner = 0.5 * mm, .outer = 1.5 * mm};
  return {.compliance = 1.0 * mm / force, .G = 2.0 * energy_release_rate(mesh, fields, region).G / (force * force)};
}

TEST(Cantilevers, ReleaseWhatTheirComplianceSaysAndOpenAsTheCorrectedBeam) {
  const CorrectedBeam beam;
  const double a = 30.0 * mm, step = 0.5 * mm;
  const Cantilever shorter = open(a - step), middle = open(a), longer = open(a + step);
  const double by_compliance = (longer.compliance - shorter.compliance) / (2.0 * step) / (2.0 * thickness);
  report_row("a = 30 mm", {{"C over the corrected beam's", middle.compliance / beam.compliance(a)},
                           {"G-theta over P^2/2B dC/da", middle.G / by_compliance},
                           {"over the corrected beam's G", middle.G / beam.release_rate(1.0, a)}});
  EXPECT_NEAR(middle.compliance / beam.compliance(a), 1.0, 0.02);
  EXPECT_NEAR(middle.G / by_compliance, 1.0, 0.025);
  EXPECT_NEAR(middle.G / beam.release_rate(1.0, a), 1.0, 0.025);
}

}  // namespace
}  // namespace pfdm::verification::this_file
