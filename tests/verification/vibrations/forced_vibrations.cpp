// Forced response of vibrating bodies: a strip on a shaker against Timoshenko's beam, a rod with hysteretic damping
// against its closed form (Ebenezer et al., J. Sound Vib. 302 (2007) 892), the power of a plate against its heat.

#include "solver/dynamics/base_response.h"
#include "solver/dynamics/modes.h"
#include "tests/verification/support.h"
#include "tests/verification/vibrations/vibrating_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <span>
#include <vector>

namespace pfdm::verification::this_file {
namespace {

using namespace verification::vibrating_boxes;

using Complex = std::complex<double>;

// A strip in cylindrical bending, 50 times as long as thick, eta = 0.1, on a base that moves across it: both its first
// two symmetric resonances, at 13.92 and 74.46 Hz.
TEST(VibratingBodies, StripOnAShaker) {
  const double length = 0.2, h = 0.004, nu = 0.3;
  const struct {
    double frequency;
    Complex exact;  // acceleration of the middle over the base's
  } rows[] = {{6, {1.296047, -0.036486}},   {10, {2.359574, -0.283988}},  {13, {6.668620, -4.669969}},
              {15, {-5.772073, -3.984263}}, {30, {-0.766866, -0.034658}}, {60, {-1.243672, 0.242299}},
              {70, {-2.575075, 1.988464}},  {80, {2.373371, 1.662730}}};
  const Mesh mesh = box({length / 2, h, h}, {240, 1, 20});
  const VibratingBody body(
      mesh, body_of(nu, {plane_on("ymin"), plane_on("ymax"), clamped("xmin"), symmetry_on("xmax")}), {rho});
  std::vector<Harmonic> harmonics;
  for (const auto& row : rows) harmonics.push_back({.omega = 2.0 * pi * row.frequency, .factor = {1.0, 0.1}});
  const BaseResponse response(body, Vector::UnitZ(), harmonics);
  // Faces of the symmetry plane, the middle layers.
  const Patch& middle = mesh.patch("xmax");
  Index best = middle.first_face;
  for (Index f = middle.first_face; f < middle.first_face + middle.n_faces; ++f)
    if (std::abs(mesh.face_centre[f].z() - h / 2) < std::abs(mesh.face_centre[best].z() - h / 2)) best = f;
  double worst_amplitude = 0.0, worst_phase = 0.0;
  for (std::size_t i = 0; i < harmonics.size(); ++i) {
    const Complex found = response.transmission(harmonics[i], body.unknowns().node_of_face[best]);
    worst_amplitude = std::max(worst_amplitude, std::abs(std::abs(found / rows[i].exact) - 1.0));
    worst_phase = std::max(worst_phase, std::abs(std::arg(found / rows[i].exact)));
  }
  report_row("strip", {{"amplitude, relative", worst_amplitude},
                       {"phase, rad", worst_phase},
                       {"vectors", static_cast<double>(response.dimension())}});
  EXPECT_LT(worst_amplitude, 0.01);
  EXPECT_LT(worst_phase, 0.01 * pi);
}

// A rod that is shaken along its axis at x = 0, free at its end: u = -A/omega^2 cos k(L - x)/cos kL in space, k =
// omega sqrt(rho/E*). Lateral strain is held off by nu = 0.
struct Rod {
  double length = 0.3, eta = 0.15;
  Complex modulus() const { return {E, E * eta}; }
  Complex k(double omega) const { return omega * std::sqrt(rho / modulus()); }
  Complex tip(double omega) const { return 1.0 / std::cos(k(omega) * length); }
  /// Heat per volume and (m/s^2)^2: 1/2 omega Im(E*) |u'|^2.
  double heat(double omega, double x) const {
    const Complex slope = k(omega) * std::sin(k(omega) * (length - x)) / std::cos(k(omega) * length) / (omega * omega);
    return 0.5 * omega * modulus().imag() * std::norm(slope);
  }
  /// Power at the base per area.
  double power(double omega) const {
    const Complex force = modulus() * k(omega) * std::tan(k(omega) * length) / (omega * omega);  // -E* u'(0) / A
    return 0.5 * std::real(force * std::conj(Complex(0.0, -1.0 / omega)));
  }
};

/// A rod of 120 cells along it, shaken along its axis from 0.3 to 3.5 of its first frequency without damping.
struct RodOfCells {
  Rod rod;
  double side = 0.01, first = 0.5 * pi / rod.length * std::sqrt(E / rho);
  Mesh mesh = box({rod.length, side, side}, {120, 2, 2});
  VibratingBody body{mesh,
                     body_of(0.0, {clamped("xmin"), symmetry_on("ymin"), symmetry_on("ymax"), symmetry_on("zmin"),
                                   symmetry_on("zmax")}),
                     {rho}};
  std::vector<Harmonic> harmonics = all_harmonics();
  BaseResponse response{body, Vector::UnitX(), harmonics};

  Harmonic harmonic(double omega) const { return {.omega = omega, .factor = {1.0, rod.eta}}; }

 private:
  std::vector<Harmonic> all_harmonics() const {
    std::vector<Harmonic> all;
    for (double part = 0.3; part < 3.5; part += 0.05) all.push_back(harmonic(part * first));
    return all;
  }
};

TEST(VibratingBodies, RodWithHystereticDamping) {
  const RodOfCells cells;
  const Rod& rod = cells.rod;
  const Index tip = cells.body.unknowns().node_of_face[cells.mesh.patch("xmax").first_face];
  double amplitude = 0.0, phase = 0.0, power = 0.0;
  for (const Harmonic& at : cells.harmonics) {
    const Complex ratio = cells.response.transmission(at, tip) / rod.tip(at.omega);
    amplitude = std::max(amplitude, std::abs(std::abs(ratio) - 1.0));
    phase = std::max(phase, std::abs(std::arg(ratio)));
    power = std::max(power, std::abs(cells.response.power(at) / (rod.power(at.omega) * cells.side * cells.side) - 1.0));
  }
  report_row("rod, 0.3 to 3.5 of the first resonance",
             {{"amplitude, relative", amplitude}, {"phase, rad", phase}, {"power, relative", power}});
  EXPECT_LT(amplitude, 0.01);
  EXPECT_LT(phase, 0.01 * pi);
  EXPECT_LT(power, 0.01);
}

TEST(VibratingBodies, RodWithHystereticDampingIsHeatedByItsPower) {
  const RodOfCells cells;
  const Harmonic at = cells.harmonic(3.0 * cells.first);
  const CellField<double> strain = strain_power(cells.body, cells.response.displacement(at));
  double error = 0.0, largest = 0.0, sum = 0.0;
  for (Index c = 0; c < cells.mesh.n_cells(); ++c) {
    const double exact = cells.rod.heat(at.omega, cells.mesh.cell_centre[c].x()),
                 heat = 0.5 * at.omega * cells.rod.eta * strain[c];
    error = std::max(error, std::abs(heat - exact));
    largest = std::max(largest, exact);
    sum += heat * cells.mesh.cell_volume[c];
  }
  report_row("at the second resonance", {{"heat, of the largest", error / largest},
                                         {"heat over mechanical power less 1", sum / cells.response.power(at) - 1.0}});
  EXPECT_LT(error / largest, 0.01);
  EXPECT_NEAR(sum / cells.response.power(at), 1.0, 1e-9);
}

TEST(VibratingBodies, RodWithHystereticDampingTakesMostPowerInResonance) {
  const RodOfCells cells;
  const double first = cells.first;
  const auto peak = [&](const auto& of) {
    double best = 0.5 * first;
    for (double omega = 0.5 * first; omega < 1.5 * first; omega += 1e-3 * first)
      if (of(omega) > of(best)) best = omega;
    return best;
  };
  const double exact = peak([&](double omega) { return cells.rod.power(omega); });
  const double found = peak([&](double omega) { return cells.response.power(cells.harmonic(omega)); });
  report_row("largest power", {{"frequency over the closed form's", found / exact}});
  EXPECT_NEAR(found / exact, 1.0, 0.002);
}

// In three dimensions the operator is not symmetric: what the power at the base and the heat differ by.
TEST(VibratingBodies, PowerOfAPlateIsItsHeat) {
  const double a = 0.1778, b = 0.254, h = 0.0127, eta = 0.2;
  const Mesh mesh = box({a / 2, b / 2, h}, {16, 22, 6});
  const VibratingBody body(mesh, body_of(0.45, {clamped("xmin"), symmetry_on("xmax"), symmetry_on("ymax")}), {rho});
  const double omega1 = lowest_modes(body, 1).front().omega;
  for (const double part : {0.8, 1.0, 1.2}) {
    const Harmonic at{.omega = part * omega1, .factor = {1.0, eta}};
    const BaseResponse response(body, Vector::UnitZ(), std::span(&at, 1), 1e-10);
    const Eigen::VectorXcd u = response.displacement(at);
    const CellField<double> strain = strain_power(body, u);
    double heat = 0.0;
    for (Index c = 0; c < mesh.n_cells(); ++c) heat += 0.5 * at.omega * eta * strain[c] * mesh.cell_volume[c];
    report_row(part < 1.0   ? "0.8 f1"
               : part > 1.0 ? "1.2 f1"
                            : "f1",
               {{"heat over power less 1", heat / response.power(at) - 1.0}});
    EXPECT_NEAR(heat / response.power(at), 1.0, 5e-3);
    // Mode 1 alone (reference/closed form): P = 1/2 m_eff/(eta omega1), to within what the other modes add.
    const Mode mode = lowest_modes(body, 1).front();
    if (part == 1.0) {
      const double effective = mode.participation.z() * mode.participation.z();
      EXPECT_NEAR(response.power(at) / (0.5 * effective / (eta * omega1)), 1.0, 0.02);
    }
    // The system itself, solved at once.
    const Eigen::SparseMatrix<Complex> whole =
        (Complex(1.0, eta) * body.stiffness().cast<Complex>() -
         Eigen::SparseMatrix<Complex>((at.omega * at.omega * body.mass()).cast<Complex>().asDiagonal()));
    const Eigen::VectorXcd direct =
        SparseLu<Complex>(whole).solve(-body.mass().cwiseProduct(body.rigid(Vector::UnitZ())).cast<Complex>());
    EXPECT_LT((direct - u).head(3 * mesh.n_cells()).norm(), 1e-8 * direct.head(3 * mesh.n_cells()).norm());
  }
}

}  // namespace
}  // namespace pfdm::verification::this_file
