// A bar of three materials, tough or undamageable | band | tough, that breaks in the band: what it dissipates against
// the apparent toughness of physics/interfaces/interface_toughness.h (literature.md 4.1).

#include "physics/interfaces/interface_toughness.h"
#include "solver/fracture/damage/damage_equation.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <limits>

namespace pfdm::verification::this_file {
namespace {

constexpr double ell = 20e-6, band_Gc = 100.0, matrix_Gc = 1000.0;

struct BandedBar {
  Mesh mesh;
  FractureModel model;
  Index crack = 0;  // the cell at mid-band
  double area = 0.0;
};

// Glass on the left if `glass`, else matrix on both sides; an odd number of cells across the band, one at its middle.
BandedBar banded_bar(const std::string& law, double half_width, Index cells_per_half, bool glass) {
  const Index n = 2 * cells_per_half + 1, outer = 8 * cells_per_half;
  const double h = 2.0 * half_width * ell / n, side = outer * h;
  BoxHexesSettings box;
  box.origin = {-0.5 * n * h - side, 0.0, 0.0};
  box.axes = {{{{2.0 * side + n * h, 2 * outer + n, 1.0}}, {{h, 1, 1.0}}, {{h, 1, 1.0}}}};
  box.regions = {{.name = "band", .lower = {-0.5 * n * h, -1.0, -1.0}, .upper = {0.5 * n * h, 1.0, 1.0}},
                 {.name = "left", .lower = {-1.0, -1.0, -1.0}, .upper = {-0.5 * n * h, 1.0, 1.0}}};
  BandedBar bar{.mesh = make_box_hexes(box), .model = {}, .area = h * h};
  for (const std::string& name : bar.mesh.region_names)
    bar.model.regions.push_back({.elasticity = from_young_poisson(75e6, 0.0),
                                 .Gc = name == "band" ? band_Gc : matrix_Gc,
                                 .ell = ell,
                                 .damageable = !(glass && name == "left")});
  bar.model.crack = &crack_geometry(law);
  bar.model.degradation = degradation("quadratic");
  bar.model.split = energy_split("none");
  for (Index c = 0; c < bar.mesh.n_cells(); ++c)
    if (std::abs(bar.mesh.cell_centre[c][0]) < 0.25 * h) bar.crack = c;
  return bar;
}

// What a crack that is prescribed at mid-band dissipates, per area.
double dissipation(const BandedBar& bar) {
  DamageEquation equation(bar.mesh, bar.model, Vector::Zero());
  const std::size_t n = bar.mesh.n_cells();
  CellField<double> lower(n, 0.0), d(n, 0.0), psi(n, 0.0);
  lower[bar.crack] = d[bar.crack] = 1.0;
  equation.solve(psi, lower, {}, d);
  return equation.fracture_energy(d) / bar.area;
}

class InterfaceBand : public ::testing::TestWithParam<const char*> {};

TEST_P(InterfaceBand, DissipatesItsApparentToughness) {
  const std::string law = GetParam();
  for (const bool glass : {false, true})
    for (const double half_width : {0.5, 1.0, 1.5, 2.0, 3.0}) {
      const double left = glass ? std::numeric_limits<double>::infinity() : matrix_Gc;
      const double expected =
          apparent_toughness(crack_geometry(law), band_Gc, 2.0 * half_width * ell, ell, {left}, {matrix_Gc});
      const double measured = dissipation(banded_bar(law, half_width, 20, glass));
      report_row(law + (glass ? ", glass | band | matrix" : ", matrix | band | matrix") + ", half width over ell",
                 {{"b/ell", half_width}, {"dissipated/Gc", measured / band_Gc}, {"formula", expected / band_Gc}});
      EXPECT_NEAR(measured, expected, 0.005 * expected) << half_width;
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, InterfaceBand, ::testing::Values("AT1", "AT2"));

}  // namespace
}  // namespace pfdm::verification::this_file
