// Surface energies of cracks whose damage is given: relaxed to their area, in planes of symmetry half of it.

#include "solver/fracture/damage/damage_equation.h"
#include "tests/solver/damaged_rows.h"
#include "tests/solver/solver_checks.h"

#include <cmath>
#include <string>
#include <utility>

namespace pfdm::this_file {
namespace {

// A crack in the middle of a bar: broken cells with nothing beside them have an energy of their own width.
double energy_of_crack(const std::string& law, Index cells_per_ell, bool relaxes) {
  const double h = ell / double(cells_per_ell);
  const Mesh mesh = row(24 * cells_per_ell + 1, h);
  const FractureModel model = model_of(mesh, law);
  DamageEquation equation(mesh, model, Vector::Zero());
  CellField<double> d = uniform(mesh, 0.0);
  d[in_order_of_x(mesh)[12 * cells_per_ell]] = 1.0;
  const CellField<double> given = d;
  if (relaxes) d = equation.relaxed(given);
  for (Index c = 0; c < mesh.n_cells(); ++c) EXPECT_GE(d[c], given[c]);
  return equation.renewed_fracture_energy(d) / (Gc * h * h);
}

TEST(DamageEquation, RelaxedCracksHaveTheSurfaceEnergyOfTheirArea) {
  for (const std::string law : {"AT1", "AT2", "Wu"})
    for (const Index n : {2, 5, 20, 60}) {
      EXPECT_GT(energy_of_crack(law, n, false), 1.0 + 0.2 * double(n)) << law;
      EXPECT_NEAR(energy_of_crack(law, n, true), 1.0, 0.13 / double(n * n)) << law << ", ell/h = " << n;
    }
  // The row of cells of least energy falls by one factor from cell to cell.
  EXPECT_NEAR(energy_of_crack("AT2", 5, true), std::sqrt(1.0 + 0.25 / 25.0), 1e-6);
}

// Half of a crack that lies in the plane x = 0, where a row of cells begins whose first one is broken: twice its
// energy.
double energy_in_plane(const std::string& law, double n_cells_per_ell, const BoundaryCondition& on_plane,
                       double first_cell = 1.0) {
  const double h = ell / n_cells_per_ell;
  const auto n = static_cast<Index>(12.0 * n_cells_per_ell);
  BoxHexesSettings settings;
  settings.axes = {{{{first_cell * h, 1, 1.0}, {double(n) * h, n, 1.0}}, {{h, 1, 1.0}}, {{h, 1, 1.0}}}};
  const Mesh mesh = make_box_hexes(settings);
  FractureModel model = model_of(mesh, law);
  model.boundary = {on_plane};
  DamageEquation equation(mesh, model, Vector::Zero());
  CellField<double> d = uniform(mesh, 0.0);
  d[in_order_of_x(mesh)[0]] = 1.0;
  return 2.0 * equation.renewed_fracture_energy(equation.relaxed(d)) / (Gc * h * h);
}

BoundaryCondition held(bool x, bool y, bool z) {
  BoundaryCondition condition;
  condition.patch = "xmin";
  condition.displacement_prescribed = {x, y, z};
  return condition;
}

BoundaryCondition symmetry() {
  BoundaryCondition condition;
  condition.patch = "xmin";
  condition.kind = BoundaryCondition::Kind::symmetry;
  return condition;
}

// With q = h/(2 ell): the cells beyond the first have the energy (s + q) d^2 of AT2, s = (1 + q^2)^(1/2), the flux to
// them has the resistance 3 q, from the plane to the centre of the second cell.
TEST(DamageEquation, ACrackInAPlaneOfSymmetryHasHalfOfTheEnergy) {
  for (const double n : {2.0, 4.0, 8.0, 16.0}) {
    const double q = 0.5 / n, beyond = std::sqrt(1.0 + q * q) + q;
    const double exact = 2.0 * q + beyond / (1.0 + 3.0 * q * beyond);
    for (const BoundaryCondition& plane : {symmetry(), held(true, false, false)})
      EXPECT_NEAR(energy_in_plane("AT2", n, plane), exact, 1e-6) << n;
    for (const auto& [law, most] : {std::pair{"AT2", 0.85}, {"AT1", 0.33}, {"Wu", 0.15}})
      EXPECT_NEAR(energy_in_plane(law, n, symmetry()), 1.0, most / (n * n)) << law << ", ell/h = " << n;
  }
}

TEST(DamageEquation, HalfARowOfCellsInAPlaneOfSymmetryIsHalfOfAWholeOne) {
  for (const double n : {2.0, 5.0})
    EXPECT_NEAR(energy_in_plane("AT2", n, symmetry(), 0.5), std::sqrt(1.0 + 0.25 / (n * n)), 1e-6) << n;
}

// Whatever else is prescribed there: the first cell is broken over its whole width, its mirror image too.
TEST(DamageEquation, SidesThatAreNoPlanesOfSymmetryHaveNoMirrorImage) {
  BoundaryCondition moved = held(true, false, false);
  moved.value = [](const Vector&, double t) { return Vector(t, 0.0, 0.0); };
  for (const BoundaryCondition& side : {held(true, true, true), held(false, false, false), moved})
    EXPECT_NEAR(energy_in_plane("AT2", 4.0, side), std::sqrt(1.0 + 1.0 / 64.0) + 1.0 / 8.0, 1e-6);
}

TEST(DamageEquation, RelaxingLeavesHomogeneousDamageAlone) {
  const Mesh mesh = row(10, 0.3 * ell);
  for (const std::string law : {"AT1", "AT2", "Wu"}) {
    const FractureModel model = model_of(mesh, law);
    for (const double value : DamageEquation(mesh, model, Vector::Zero()).relaxed(uniform(mesh, 0.5)))
      EXPECT_EQ(value, 0.5) << law;
  }
}

}  // namespace
}  // namespace pfdm::this_file
