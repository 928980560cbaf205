// Modes: plates against three-dimensional Ritz values, beams against Timoshenko's.
//
// Reference values were computed apart from this program: Ritz with products of Legendre polynomials (17 x 11 x 5 for
// each displacement component, converged to about 2e-3) for plates; the exponential of Timoshenko's state matrix (shear
// factor 5/6, in plane strain 5/(6 - nu)) for beams and strips.

#include "solver/dynamics/base_response.h"
#include "solver/dynamics/modes.h"
#include "tests/verification/support.h"
#include "tests/verification/vibrations/vibrating_boxes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::vibrating_boxes;

/// omega length^2 sqrt(rho h/D) of the lowest modes.
std::vector<double> lambda_of(const Mesh& mesh, const ElasticBody& body, double length, double h, double nu, int count,
                              bool plate = true) {
  const VibratingBody vibrating(mesh, body, {rho});
  const double D = E * h * h * h / (12.0 * (plate ? 1.0 - nu * nu : 1.0));
  std::vector<double> lambda;
  for (const Mode& mode : lowest_modes(vibrating, count))
    lambda.push_back(mode.omega * length * length * std::sqrt(rho * h / D));
  return lambda;
}

// A quarter of the plate of 0.1778 x 0.254 x 0.0127 m, clamped along the long edges.
TEST(VibratingBodies, PlateClampedAlongTwoEdges) {
  const double a = 0.1778, b = 0.254, h = 0.0127;
  const Mesh mesh = box({a / 2, b / 2, h}, {14, 20, 4});
  const struct {
    double nu, first, second, third;
  } rows[] = {{0.3, 21.484, 23.397, 30.860}, {0.45, 21.198, 22.641, 29.820}};
  for (const auto& [nu, first, second, third] : rows) {
    const auto even =
        lambda_of(mesh, body_of(nu, {clamped("xmin"), symmetry_on("xmax"), symmetry_on("ymax")}), a, h, nu, 2);
    const auto odd =
        lambda_of(mesh, body_of(nu, {clamped("xmin"), symmetry_on("xmax"), antisymmetric("ymax", 1)}), a, h, nu, 1);
    report_row(nu < 0.4 ? "nu = 0.3" : "nu = 0.45",
               {{"first over Ritz", even[0] / first}, {"second", odd[0] / second}, {"third", even[1] / third}});
    EXPECT_NEAR(even[0] / first, 1.0, 0.015);
    EXPECT_NEAR(odd[0] / second, 1.0, 0.015);
    EXPECT_NEAR(even[1] / third, 1.0, 0.015);
  }
}

// Spans of 20 and 50 times the thickness, against Ritz values of thin plates (Kirchhoff; clamped at x = 0, a) over
// sqrt(1 + 2 c (h/a)^2), as shear and rotary inertia lower them; c is what the three-dimensional Ritz values above give
// at a/h = 14.
TEST(VibratingBodies, ThinPlates) {
  const double a = 0.1778, b = 0.254;
  const struct {
    double nu;
    std::array<double, 3> thin, c;
  } rows[] = {{0.3, {22.22, 24.38, 32.61}, {6.83, 8.41, 11.43}}, {0.45, {21.95, 23.68, 31.63}, {7.08, 9.20, 12.26}}};
  for (const auto& row : rows)
    for (const double ratio : {20.0, 50.0}) {
      const double h = a / ratio;
      const Mesh mesh = box({a / 2, b / 2, h}, {14, 20, 4});
      const auto even = lambda_of(mesh, body_of(row.nu, {clamped("xmin"), symmetry_on("xmax"), symmetry_on("ymax")}), a,
                                  h, row.nu, 2);
      const auto odd = lambda_of(
          mesh, body_of(row.nu, {clamped("xmin"), symmetry_on("xmax"), antisymmetric("ymax", 1)}), a, h, row.nu, 1);
      const std::array<double, 3> found{even[0], odd[0], even[1]};
      std::array<double, 3> over{};
      for (std::size_t k = 0; k < 3; ++k) {
        over[k] = found[k] / row.thin[k] * std::sqrt(1.0 + 2.0 * row.c[k] / (ratio * ratio));
        EXPECT_NEAR(over[k], 1.0, 0.015) << row.nu << ", " << ratio << ", " << k;
      }
      report_row(row.nu < 0.4 ? (ratio < 30.0 ? "nu = 0.3, 1:20" : "nu = 0.3, 1:50")
                              : (ratio < 30.0 ? "nu = 0.45, 1:20" : "nu = 0.45, 1:50"),
                 {{"1", over[0]}, {"2", over[1]}, {"3", over[2]}});
    }
}

// Near-incompressible cells carry a pressure. They converge more slowly: 5 layers are too soft by 3 to 5 %, 10 layers
// by 2 %.
TEST(VibratingBodies, NearlyIncompressiblePlate) {
  const double a = 0.1778, b = 0.254, h = 0.0127, nu = 0.49;
  std::vector<double> errors;
  for (const auto& n : {std::array<Index, 3>{12, 17, 5}, std::array<Index, 3>{20, 28, 10}}) {
    const auto even = lambda_of(box({a / 2, b / 2, h}, n),
                                body_of(nu, {clamped("xmin"), symmetry_on("xmax"), symmetry_on("ymax")}), a, h, nu, 2);
    report_row(n[2] == 5 ? "5 layers" : "10 layers",
               {{"first over Ritz", even[0] / 21.119}, {"third", even[1] / 29.546}});
    errors.push_back(std::abs(even[0] / 21.119 - 1.0));
    errors.push_back(std::abs(even[1] / 29.546 - 1.0));
  }
  EXPECT_LT(errors[2], errors[0]);
  EXPECT_LT(errors[3], errors[1]);
  EXPECT_LT(errors[2], 0.025);
  EXPECT_LT(errors[3], 0.03);
}

// Twenty times and fifty times as long as thick; coarse cells do not lock.
TEST(VibratingBodies, BeamsInPlaneStrain) {
  const auto beam = [](double ratio, Index nx, Index nz, bool cantilever) {
    const double length = 0.254, h = length / ratio;
    std::vector<BoundaryCondition> boundary{plane_on("ymin"), plane_on("ymax"), clamped("xmin")};
    if (!cantilever) boundary.push_back(clamped("xmax"));
    return lambda_of(box({length, h, h}, {nx, 1, nz}), body_of(0.0, boundary), length, h, 0.0, 3);
  };
  const auto both = beam(20.0, 80, 8, false), one = beam(20.0, 80, 8, true);
  report_row("1:20, clamped at both ends",
             {{"1", both[0] / 22.0745}, {"2", both[1] / 59.7965}, {"3", both[2] / 114.614}});
  report_row("1:20, cantilever", {{"1", one[0] / 3.51025}, {"2", one[1] / 21.7861}, {"3", one[2] / 60.0850}});
  EXPECT_NEAR(both[0] / 22.0745, 1.0, 0.01);
  EXPECT_NEAR(both[1] / 59.7965, 1.0, 0.01);
  EXPECT_NEAR(both[2] / 114.614, 1.0, 0.01);
  EXPECT_NEAR(one[0] / 3.51025, 1.0, 0.01);
  EXPECT_NEAR(one[1] / 21.7861, 1.0, 0.01);
  EXPECT_NEAR(one[2] / 60.0850, 1.0, 0.01);
  const auto thin = beam(50.0, 50, 6, true);  // cells as long as the beam is thick
  report_row("1:50, h = cell", {{"1", thin[0] / 3.51509}, {"2", thin[1] / 21.9941}, {"3", thin[2] / 61.4290}});
  EXPECT_NEAR(thin[0] / 3.51509, 1.0, 0.015);
  EXPECT_NEAR(thin[1] / 21.9941, 1.0, 0.015);
}

struct PlateRow {
  const char* name;
  Vector size;  // over the thickness, as are frequencies, times sqrt(rho/E)
  std::array<Index, 3> cells;
  double nu;
  bool is_cantilever;
  std::array<double, 6> due;
  double bound;
};

// Four layers, cells 0.6 to 2.4 times as long as the plate is thick, modes that bend and that twist; and two layers.
// The frequencies are those of elements of fourth degree (fifth across the plate), 10 x 10 x 1 of them, which become
// smaller towards all edges; with 8 x 8 elements they differ by up to 4e-4 (the plate clamped along two edges: 7e-4).
const PlateRow plates_of_few_layers[] = {{"cantilever, span 15, 25 x 20 x 4 cells, nu = 0.45",
                                          {15, 12, 1},
                                          {25, 20, 4},
                                          0.45,
                                          true,
                                          {0.00483135, 0.01268611, 0.0287791, 0.0388451, 0.04397482, 0.05197712},
                                          0.01},
                                         {"span 60, 25 x 20 x 4, 0.3",
                                          {60, 48, 1},
                                          {25, 20, 4},
                                          0.3,
                                          true,
                                          {0.00029091, 0.00084224, 0.00180058, 0.00292337, 0.00328074, 0.00509486},
                                          0.015},
                                         {"span 25, width 10, 40 x 16 x 4, 0.2",
                                          {25, 10, 1},
                                          {40, 16, 4},
                                          0.2,
                                          true,
                                          {0.00163648, 0.00863101, 0.01016853, 0.01467521, 0.02719767, 0.0281968},
                                          0.01},
                                         {"clamped along two edges, span 14, width 20, 20 x 28 x 4, 0.45",
                                          {14, 20, 1},
                                          {20, 28, 4},
                                          0.45,
                                          false,
                                          {0.03486225, 0.03721853, 0.04906601, 0.07419656, 0.0913881, 0.09412784},
                                          0.01}};

TEST(VibratingBodies, PlatesOfFewLayers) {
  for (const PlateRow& row : plates_of_few_layers) {
    std::vector<BoundaryCondition> boundary{clamped("xmin")};
    if (!row.is_cantilever) boundary.push_back(clamped("xmax"));
    const Mesh mesh = box(row.size, row.cells);
    const VibratingBody body(mesh, body_of(row.nu, boundary), {rho});
    const std::vector<Mode> modes = lowest_modes(body, 6);
    std::array<double, 6> over{};
    for (std::size_t k = 0; k < 6; ++k) {
      over[k] = modes[k].omega / (row.due[k] * std::sqrt(E / rho));
      EXPECT_NEAR(over[k], 1.0, row.bound) << row.name << ", mode " << k + 1;
    }
    report_row(row.name,
               {{"1", over[0]}, {"2", over[1]}, {"3", over[2]}, {"4", over[3]}, {"5", over[4]}, {"6", over[5]}});
  }
}

// Nothing holds it: its rigid motions, three in the plane and six in space, have no frequency. Timoshenko's beam with
// free ends, in plane strain and in space, where each bending mode comes twice.
TEST(VibratingBodies, FreeFreeBeams) {
  const double length = 0.254, D_over = E / (12.0 * rho);
  const struct {
    const char* name;
    double ratio;
    std::array<Index, 3> cells;
    bool in_space;
    std::array<double, 3> due;
  } rows[] = {{"1:20, free, plane strain", 20.0, {80, 1, 8}, false, {22.1920, 60.3203, 115.965}},
              {"1:50, free, plane strain", 50.0, {100, 1, 8}, false, {22.3439, 61.4488, 120.060}},
              {"1:20, free, in space", 20.0, {40, 8, 6}, true, {22.1920, 43.3610, 60.3203}}};
  for (const auto& row : rows) {
    const double h = length / row.ratio, unit = h / (length * length) * std::sqrt(D_over);
    std::vector<BoundaryCondition> boundary;
    if (!row.in_space) boundary = {plane_on("ymin"), plane_on("ymax")};
    const Mesh mesh = box({length, row.in_space ? 2.0 * h : h, h}, row.cells);
    const VibratingBody body(mesh, body_of(0.0, boundary), {rho}, {.shift = 100.0 * unit * unit});
    const std::size_t n_rigid = row.in_space ? 6 : 3;
    const std::vector<Mode> modes = lowest_modes(body, static_cast<int>(n_rigid + 3));
    for (std::size_t k = 0; k < n_rigid; ++k) EXPECT_EQ(modes[k].omega, 0.0) << row.name;
    std::array<double, 3> found{};
    for (std::size_t k = 0; k < 3; ++k) {
      found[k] = modes[n_rigid + k].omega / (row.due[k] * unit);
      EXPECT_NEAR(found[k], 1.0, 0.015) << row.name;
      EXPECT_LT(modes[n_rigid + k].participation.norm(), 1e-3 * std::sqrt(body.total_mass())) << row.name;
    }
    report_row(row.name, {{"1", found[0]}, {"2", found[1]}, {"3", found[2]}});
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
