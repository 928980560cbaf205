// The energy release rate by G-theta, on a sharp slit under the displacements of its own field:
// G = (K_I^2 + K_II^2) (1 - nu^2)/E; and of a crack between two materials, in a clamped strip (Rice, J. Appl. Mech. 35
// (1968) 379): what the strip ahead of it stores, G = v^2/(2 (h_1/M_1 + h_2/M_2)), M = lambda + 2 mu.

#include "postproc/fields/energy_release_rate.h"
#include "tests/verification/near_field.h"
#include "tests/verification/support.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace pfdm::verification::this_file {
namespace {

constexpr double E = 210e9, nu = 0.3, G_exact = 2700.0;

struct SlitPlate {
  Mesh mesh;
  OutputFields fields;
  FractureModel model{};
};

StressIntensity intensity_of(const SlitPlate& plate, TipRegion ring, double length) {
  ring.shape = &region_shapes().front();
  ring.reference_length = length;
  return stress_intensity(plate.mesh, plate.model, plate.fields, ring);
}

// Undamaged, in equilibrium.
OutputFields elastic_fields(const Mesh& mesh, const FractureModel& model) {
  const auto solution = solve_elastic(mesh, model);
  OutputFields fields;
  fields.damage = CellField<double>(mesh.n_cells(), 0.0);
  fields.strain = solution->cells.strain;
  fields.gradient = solution->cells.gradient;
  fields.stress = solution->cells.stress;
  return fields;
}

// A square of 2 mm, slit to its middle, n cells a side; K in units of sqrt(E' G). `next`: the next field's stresses
// over those of the near field, in about, at 1 mm from the tip.
SlitPlate solve(Index n, double K_I, double K_II, const std::array<double, 2>& next = {0.0, 0.0}) {
  constexpr double half = 1e-3;
  SlitPlate plate;
  plate.mesh = make_box_hexes({.origin = {-half, -half, 0.0},
                               .axes = {{{{2.0 * half, n, 1.0}}, {{2.0 * half, n, 1.0}}, {{2.5e-4, 1, 1.0}}}},
                               .regions = {},
                               .slits = {{"slit", {-half, 0.0, 0.0}, {0.0, 0.0, 1.0}}}});
  const IsotropicElasticity elasticity = from_young_poisson(E, nu);
  const double K = std::sqrt(E / (1.0 - nu * nu) * G_exact);
  std::vector<BoundaryCondition> boundary{plane_on("zmin"), plane_on("zmax")};
  for (const char* side : {"xmin", "xmax", "ymin", "ymax"})
    boundary.push_back(displacement_on(side, [=](const Vector& x) -> Vector {
      const double unit = K / (std::sqrt(2.0 * std::numbers::pi) * half);
      return near_field(elasticity, x, K * K_I, K * K_II) + next_field(elasticity, x, unit * next[0], unit * next[1]);
    }));
  plate.model = elastic_model({elasticity}, boundary);
  plate.fields = elastic_fields(plate.mesh, plate.model);
  return plate;
}

double measured(const SlitPlate& plate, std::string_view shape, double inner, double outer) {
  TipRegion region{.name = "tip", .inner = inner, .outer = outer};
  for (const RegionShape& s : region_shapes())
    if (s.name == shape) region.shape = &s;
  return energy_release_rate(plate.mesh, plate.fields, region).G / G_exact;
}

// The discrete body is too stiff around the tip, by h to the first power; the value does not depend on the ring.
void expect_exact_value(double K_I, double K_II) {
  std::vector<double> errors;
  for (const Index n : {20, 40, 80}) {
    const SlitPlate plate = solve(n, K_I, K_II);
    const double wide = measured(plate, "disc", 0.3e-3, 0.8e-3), narrow = measured(plate, "disc", 0.2e-3, 0.4e-3);
    const double box = measured(plate, "box", 0.3e-3, 0.8e-3);
    report_row("h = " + std::to_string(2000 / n) + " um",
               {{"G/exact, disc 0.3-0.8 mm", wide}, {"disc 0.2-0.4 mm", narrow}, {"box 0.3-0.8 mm", box}});
    errors.push_back(1.0 - wide);
    const double most = n == 20 ? 0.005 : (n == 40 ? 0.001 : 0.0004);
    EXPECT_NEAR(narrow, wide, most);
    EXPECT_NEAR(box, wide, most);
  }
  EXPECT_LT(std::abs(errors[2]), 0.01);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 0.9);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 0.9);
}

TEST(EnergyReleaseRate, OfASlitIsThatOfItsStressIntensity) { expect_exact_value(1.0, 0.0); }

TEST(EnergyReleaseRate, OfAMixedFieldIsTheSumOfBothModes) { expect_exact_value(0.8, 0.6); }

// Two layers of 1 mm, 10 mm long, the lower one clamped, the upper one lifted by v; slit up to the middle;
// cells of 1 mm / n.
double of_a_strip(Index n, const IsotropicElasticity& lower, const IsotropicElasticity& upper) {
  constexpr double layer = 1e-3, v = 1e-6;
  BoxHexesSettings box;
  box.origin = {-5.0 * layer, -layer, 0.0};
  box.axes[0] = {{4.0 * layer, 2 * n, 0.3}, {2.0 * layer, 2 * n, 1.0}, {4.0 * layer, 2 * n, 1.0 / 0.3}};
  box.axes[1] = {{2.0 * layer, 2 * n, 1.0}};
  box.axes[2] = {{0.2 * layer, 1, 1.0}};
  box.base_region = "upper";
  box.regions = {{.name = "lower", .lower = {-1.0, -1.0, -1.0}, .upper = {1.0, 0.0, 1.0}}};
  box.slits = {{.name = "slit", .lower = {-1.0, 0.0, -1.0}, .upper = {0.0, 0.0, 1.0}}};
  const Mesh mesh = make_box_hexes(box);
  std::vector<IsotropicElasticity> by_region;
  for (const std::string& name : mesh.region_names) by_region.push_back(name == "lower" ? lower : upper);
  const FractureModel model =
      elastic_model(by_region, {plane_on("zmin"), plane_on("zmax"), symmetry_on("xmax"),
                                displacement_on("ymin", [](const Vector&) -> Vector { return Vector::Zero(); }),
                                displacement_on("ymax", [=](const Vector&) -> Vector { return Vector(0.0, v, 0.0); })});
  const OutputFields fields = elastic_fields(mesh, model);
  const TipRegion ring{.name = "tip", .shape = &region_shapes().front(), .inner = 0.3 * layer, .outer = 0.8 * layer};
  const double due = 0.5 * v * v / (layer / lower.constrained_modulus() + layer / upper.constrained_modulus());
  return energy_release_rate(mesh, fields, ring).G / due;
}

TEST(EnergyReleaseRate, OfACrackBetweenTwoMaterialsIsThatOfTheStrip) {
  const IsotropicElasticity glass = from_young_poisson(70e9, 0.3), polymer = from_young_poisson(3e9, 0.38);
  for (const auto& [what, upper] : {std::pair{"glass on glass", glass}, std::pair{"polymer on glass", polymer}}) {
    const double coarse = of_a_strip(10, glass, upper), fine = of_a_strip(20, glass, upper);
    report_row(what, {{"G/closed form, h = 0.1 mm", coarse}, {"h = 0.05 mm", fine}});
    EXPECT_NEAR(coarse, 1.0, 0.005);
    EXPECT_NEAR(fine, 1.0, 0.001);
    EXPECT_LT(std::abs(fine - 1.0), 0.4 * std::abs(coarse - 1.0));
  }
}

// In one material K1 and K2 are those of Williams' field, of which the boundary is displaced.
TEST(StressIntensity, OfASlitIsThatOfItsField) {
  const double unit = std::sqrt(E / (1.0 - nu * nu) * G_exact);
  for (const auto& [K_I, K_II] : {std::pair{1.0, 0.0}, std::pair{0.8, 0.6}, std::pair{0.0, 1.0}}) {
    const SlitPlate plate = solve(80, K_I, K_II);
    const StressIntensity K = intensity_of(plate, {.name = "tip", .inner = 0.3e-3, .outer = 0.8e-3}, 1e-3);
    const double due = std::atan2(K_II, K_I);
    report_row(
        "K_I, K_II = " + std::to_string(K_I) + ", " + std::to_string(K_II),
        {{"K1", K.K1 / unit}, {"K2", K.K2 / unit}, {"phase angle - due [degree]", 57.29578 * (K.phase_angle - due)}});
    EXPECT_NEAR(K.K1 / unit, K_I, 0.01);
    EXPECT_NEAR(K.K2 / unit, K_II, 0.01);
    EXPECT_NEAR(K.phase_angle, due, 0.005);
    const SlitPlate coarse = solve(40, K_I, K_II);
    const StressIntensity K_coarse = intensity_of(coarse, {.name = "tip", .inner = 0.3e-3, .outer = 0.8e-3}, 1e-3);
    EXPECT_LT(std::hypot(K.K1 / unit - K_I, K.K2 / unit - K_II),
              0.6 * std::hypot(K_coarse.K1 / unit - K_I, K_coarse.K2 / unit - K_II));
  }
}

// The field of most bodies has next terms. With those, too, the size, which is that of G, and the phase angle are right
// to the first power of h.
TEST(StressIntensity, OfAFieldWithNextTermsIsThatOfTheSingularOne) {
  const double unit = std::sqrt(E / (1.0 - nu * nu) * G_exact);
  for (const auto& next : {std::array{1.0, 0.0}, std::array{0.0, 1.0}, std::array{-0.5, 0.5}}) {
    std::vector<double> size, angle;
    for (const Index n : {40, 80}) {
      const SlitPlate plate = solve(n, 0.8, 0.6, next);
      const StressIntensity K = intensity_of(plate, {.name = "tip", .inner = 0.3e-3, .outer = 0.8e-3}, 1e-3);
      size.push_back(std::hypot(K.K1, K.K2) / unit - 1.0);
      angle.push_back(K.phase_angle - std::atan2(0.6, 0.8));
      report_row("next terms " + std::to_string(next[0]) + ", " + std::to_string(next[1]) +
                     ", h = " + std::to_string(2000 / n) + " um",
                 {{"|K| - 1", size.back()}, {"phase angle - due [degree]", 57.29578 * angle.back()}});
    }
    EXPECT_NEAR(size[1], 0.0, 0.015);
    EXPECT_NEAR(angle[1], 0.0, 0.015);
    EXPECT_LT(std::abs(size[1]), 0.6 * std::abs(size[0]) + 1e-3);
    EXPECT_LT(std::abs(angle[1]), 0.6 * std::abs(angle[0]) + 1e-3);
  }
}

using Complex = std::complex<double>;

// The field of a crack |x| < a between two half-planes under s_yy + i s_xy = T far away (Rice, Sih, J. Appl. Mech. 32
// (1965) 418): on y = 0 s_yy + i s_xy = T (x + 2 i eps a) (x^2 - a^2)^(-1/2) ((x - a)/(x + a))^(i eps).
struct CentralCrack {
  IsotropicElasticity upper, lower;
  double a;
  Complex T;

  static double kappa(const IsotropicElasticity& c) { return 3.0 - 4.0 * c.poisson_ratio(); }
  double eps() const {  // by Dundurs' beta
    const double k1 = kappa(upper), k2 = kappa(lower);
    const double beta =
        (upper.mu * (k2 - 1.0) - lower.mu * (k1 - 1.0)) / (upper.mu * (k2 + 1.0) + lower.mu * (k1 + 1.0));
    return std::log((1.0 - beta) / (1.0 + beta)) / (2.0 * std::numbers::pi);
  }
  // Integral of that function along the axis, and its conjugate's; s = 1 or -1.
  Complex f(Complex z, double s) const {
    const Complex i(0.0, 1.0);
    return std::sqrt(z - a) * std::sqrt(z + a) * std::exp(s * i * eps() * (std::log(z - a) - std::log(z + a)));
  }
  Complex f_slope(Complex z, double s) const {
    const Complex i(0.0, 1.0);
    return (z + s * 2.0 * i * eps() * a) / ((z - a) * (z + a)) * f(z, s);
  }
  Vector displacement(const Vector& x, bool above) const {
    const Complex z(x.x(), above ? std::max(x.y(), 1e-15) : std::min(x.y(), -1e-15));
    const double growth = std::exp((above ? 2.0 : -2.0) * std::numbers::pi * eps());
    const IsotropicElasticity& c = above ? upper : lower;
    const Complex A = std::conj(T) / (1.0 + growth), B = growth * T / (1.0 + growth);
    const Complex u =
        (kappa(c) * A * f(z, -1.0) - std::conj(B * f(z, 1.0)) - (z - std::conj(z)) * std::conj(A * f_slope(z, -1.0))) /
        (2.0 * c.mu);
    return {u.real(), u.imag(), 0.0};
  }
  // (K1 + i K2) at the length L, as published: sqrt(pi a) T (1 + 2 i eps) (2 a)^(-i eps) L^(i eps).
  Complex K(double L) const {
    const Complex i(0.0, 1.0);
    return std::sqrt(std::numbers::pi * a) * T * (1.0 + 2.0 * i * eps()) *
           std::exp(i * eps() * std::log(L / (2.0 * a)));
  }
};

// A square of three crack lengths a side, its sides displaced as that field is; n cells in half the crack.
SlitPlate solve(const CentralCrack& crack, Index n) {
  const double half = 3.0 * crack.a;
  BoxHexesSettings box;
  box.origin = {-half, -half, 0.0};
  box.axes = {{{{2.0 * half, 6 * n, 1.0}}, {{2.0 * half, 6 * n, 1.0}}, {{crack.a / 4.0, 1, 1.0}}}};
  box.base_region = "upper";
  box.regions = {{.name = "lower", .lower = {-1.0, -1.0, -1.0}, .upper = {1.0, 0.0, 1.0}}};
  box.slits = {{"slit", {-crack.a, 0.0, 0.0}, {crack.a, 0.0, 1.0}}};
  SlitPlate plate{.mesh = make_box_hexes(box), .fields = {}};
  std::vector<IsotropicElasticity> by_region;
  for (const std::string& name : plate.mesh.region_names)
    by_region.push_back(name == "lower" ? crack.lower : crack.upper);
  std::vector<BoundaryCondition> boundary{plane_on("zmin"), plane_on("zmax")};
  for (const char* side : {"xmin", "xmax", "ymin", "ymax"})
    boundary.push_back(displacement_on(side, [=](const Vector& x) { return crack.displacement(x, x.y() >= 0.0); }));
  plate.model = elastic_model(by_region, boundary);
  plate.fields = elastic_fields(plate.mesh, plate.model);
  return plate;
}

TEST(StressIntensity, OfACrackBetweenGlassAndPolymerIsTheClosedForm) {
  const IsotropicElasticity glass = from_young_poisson(70e9, 0.3), polymer = from_young_poisson(3e9, 0.38);
  constexpr double a = 1e-3, L = 1e-4;
  const TipRegion ring{.name = "tip", .point = {a, 0.0, 0.0}, .inner = 0.3 * a, .outer = 0.8 * a};
  for (const Complex T : {Complex(1e6, 0.0), Complex(1e6, 1e6), Complex(0.0, 1e6)}) {
    const CentralCrack crack{.upper = polymer, .lower = glass, .a = a, .T = T};
    const Complex due = crack.K(L);
    for (const Index n : {10, 20}) {
      const SlitPlate plate = solve(crack, n);
      const StressIntensity K = intensity_of(plate, ring, L);
      const double ratio = std::hypot(K.K1, K.K2) / std::abs(due), angle = K.phase_angle - std::arg(due);
      report_row("T = " + std::to_string(T.real()) + ", " + std::to_string(T.imag()) + ", n = " + std::to_string(n),
                 {{"|K|/closed form", ratio},
                  {"phase angle, closed form [degree]", 57.29578 * std::arg(due)},
                  {"error [degree]", 57.29578 * angle}});
      EXPECT_NEAR(ratio, 1.0, 0.03);
      EXPECT_NEAR(angle, 0.0, 0.03 * std::max(std::abs(std::arg(due)), 0.3));
      // G of the same field.
      TipRegion disc = ring;
      disc.shape = &region_shapes().front();
      const InterfaceCrack interface { .upper = polymer, .lower = glass };
      EXPECT_NEAR(energy_release_rate(plate.mesh, plate.fields, disc).G * interface.modulus() / std::norm(due), 1.0,
                  0.06);
    }
  }
}

TEST(StressIntensity, IsNoneWhereTheRingHasTwoMaterialsOnOneSide) {
  SlitPlate plate = solve(20, 1.0, 0.0);
  plate.model.cells = CellField<RegionModel>(plate.mesh.n_cells(), plate.model.regions.front());
  const TipRegion ring{.name = "tip", .inner = 0.3e-3, .outer = 0.8e-3};
  EXPECT_FALSE(std::isnan(intensity_of(plate, ring, 1e-3).K1));
  for (Index c = 0; c < plate.mesh.n_cells(); ++c)
    if (plate.mesh.cell_centre[c].x() > 0.3e-3) plate.model.cells[c].elasticity = from_young_poisson(70e9, 0.3);
  EXPECT_TRUE(std::isnan(intensity_of(plate, ring, 1e-3).K1));
}

TEST(EnergyReleaseRate, IsNoneWhereTheRingLeavesTheBody) {
  EXPECT_TRUE(std::isnan(measured(solve(20, 1.0, 0.0), "disc", 0.5e-3, 1.2e-3)));
}

TEST(EnergyReleaseRate, FollowsTheForemostDamage) {
  const SlitPlate plate = solve(20, 1.0, 0.0);
  CellField<double> damage = plate.fields.damage;
  for (Index c = 0; c < plate.mesh.n_cells(); ++c) {
    const Vector& x = plate.mesh.cell_centre[c];
    if (std::abs(x.y() - 0.05e-3) < 1e-9) damage[c] = x.x() < 0.4e-3 ? 1.0 : (x.x() < 0.5e-3 ? 0.8 : 0.0);
    if (std::abs(x.y() - 0.55e-3) < 1e-9) damage[c] = x.x() < 0.6e-3 ? 1.0 : 0.0;
  }
  TipRegion region{.name = "tip", .shape = &region_shapes().front(), .inner = 1e-4, .outer = 2e-4, .follows = true};
  EXPECT_NEAR(crack_tip(plate.mesh, damage, region).x(), 0.56e-3, 1e-9);
  region.corridor = 0.2e-3;
  const Vector tip = crack_tip(plate.mesh, damage, region);
  EXPECT_NEAR(tip.x(), 0.4e-3, 1e-9);  // halfway from d = 1 at 0.35 mm to 0.8 at 0.45 mm
  EXPECT_NEAR(tip.y(), 0.05e-3, 1e-9);
  region.follows = false;
  EXPECT_EQ(crack_tip(plate.mesh, damage, region), region.point);
}

}  // namespace
}  // namespace pfdm::verification::this_file
