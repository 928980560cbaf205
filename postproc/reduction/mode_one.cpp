#include "physics/quantity_text.h"
#include "postproc/reduction/beam_terms.h"
#include "postproc/reduction/test_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

/// F/N of a point.
double correction(const TestDimensions& s, double displacement, double crack_length) {
  return large_displacement_factor(displacement, crack_length, s.block_offset) /
         block_factor(displacement, crack_length, s.block_offset, s.block_length);
}

/// Crack lengths of the rows, and compliances over N.
struct Calibration {
  std::vector<double> lengths{}, compliances{};
};
Calibration calibration_of(const CalibrationData& data) {
  Calibration found;
  for (const std::size_t i : data.grown) {
    const double a = data.record.crack_length[i], d = data.record.displacement[i];
    const double n = block_factor(d, a, data.specimen.block_offset, data.specimen.block_length);
    found.lengths.push_back(a);
    found.compliances.push_back(d / data.record.force[i] / n);
  }
  return found;
}

std::vector<double> each(const std::vector<double>& values, double (*f)(double)) {
  std::vector<double> result;
  std::ranges::transform(values, std::back_inserter(result), f);
  return result;
}

CalibratedMethod without_lengths() {
  return {.missing = "needs crack lengths at two points of growth or more (crack_length of the record)"};
}

/// Of a line whose root lies behind the load line, at `shift` < 0: no crack acts shorter than it is.
std::string remark_on_shift(double shift) {
  if (!(shift < 0.0)) return "";
  return fmt::format(
      "the crack lengths look too long: the line of (C/N)^(1/3) meets zero at a = {}; Delta of modified_beam_theory "
      "counts as zero (ISO 15024)",
      quantity_text(-shift, "m", 3));
}

CalibratedMethod opening_modified_beam_theory(const CalibrationData& data) {
  const Calibration points = calibration_of(data);
  const FittedLine line = fitted_line(points.lengths, each(points.compliances, std::cbrt));
  if (std::isnan(line.slope)) return without_lengths();
  const double shift = line.intercept / line.slope, delta = std::max(shift, 0.0);
  const TestDimensions& s = data.specimen;
  const double h = s.arm(), m = line.slope, modulus = 8.0 / (m * m * m * s.width * h * h * h);
  return {.at =
              [=](double P, double d, double a) {
                return Reduced{1.5 * P * d / (s.width * (a + delta)) * correction(s, d, a), a};
              },
          .constants = {{"Delta", "m", delta}, {"E_flexural", "Pa", modulus}},
          .remark = remark_on_shift(shift)};
}

CalibratedMethod opening_compliance_calibration(const CalibrationData& data) {
  const Calibration points = calibration_of(data);
  const FittedLine line = fitted_line(each(points.lengths, std::log), each(points.compliances, std::log));
  if (std::isnan(line.slope)) return without_lengths();
  const TestDimensions& s = data.specimen;
  return {.at =
              [=, n = line.slope](double P, double d, double a) {
                return Reduced{0.5 * n * P * d / (s.width * a) * correction(s, d, a), a};
              },
          .constants = {{"n", "1", line.slope}}};
}

CalibratedMethod opening_modified_compliance_calibration(const CalibrationData& data) {
  const Calibration points = calibration_of(data);
  const FittedLine line = fitted_line(each(points.compliances, std::cbrt), points.lengths);
  if (std::isnan(line.slope)) return without_lengths();
  const TestDimensions& s = data.specimen;
  const double a1 = line.slope / s.thickness;
  return {.at =
              [=](double P, double d, double a) {
                const double root = std::cbrt(d / P / block_factor(d, a, s.block_offset, s.block_length));
                const double G = 1.5 * P * P * root * root / (a1 * s.width * s.thickness);
                return Reduced{G * large_displacement_factor(d, a, s.block_offset), a};
              },
          .constants = {{"A1", "(N/m)^(1/3)", a1}}};
}

/// E of the initial compliance, with the root rotation that itself depends on E.
struct OpeningModulus {
  double modulus, delta;
};
OpeningModulus opening_flexural_modulus(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  const double a0 = s.crack_length, h = s.arm(), b = s.width;
  OpeningModulus found{8.0 * a0 * a0 * a0 / (data.straight.compliance * b * h * h * h), 0.0};
  for (int k = 0; k < 200; ++k) {
    found.delta = h * root_rotation(found.modulus, s.transverse_modulus, s.shear_modulus);
    const double a = a0 + found.delta, before = found.modulus;
    found.modulus =
        8.0 * a * a * a / (b * h * h * h) / (data.straight.compliance - 12.0 * a / (5.0 * b * h * s.shear_modulus));
    if (std::abs(found.modulus / before - 1.0) < 1e-13) break;
  }
  return found;
}

/// The length with alpha a^3 + beta a = C.
double equivalent_length(double alpha, double beta, double compliance) {
  double a = std::cbrt(std::max(compliance, 0.0) / alpha);
  for (int k = 0; k < 100; ++k) {
    const double step = (alpha * a * a * a + beta * a - compliance) / (3.0 * alpha * a * a + beta);
    a -= step;
    if (std::abs(step) <= 1e-15 * std::abs(a)) break;
  }
  return a;
}

CalibratedMethod opening_equivalent_crack(const CalibrationData& data) {
  const TestDimensions s = data.specimen;
  const std::string missing = missing_dimensions({{"crack_length", s.crack_length},
                                                  {"transverse_modulus", s.transverse_modulus},
                                                  {"shear_modulus", s.shear_modulus}});
  if (!missing.empty()) return {.missing = missing};
  const OpeningModulus flexural = opening_flexural_modulus(data);
  const double h = s.arm(), E = flexural.modulus;
  if (!(E > 0.0)) return {.missing = "the initial compliance is less than that of the arms' shear alone"};
  return {.at =
              [=](double P, double d, double) {
                const double a = equivalent_length(8.0 / (E * s.width * h * h * h),
                                                   12.0 / (5.0 * s.width * h * s.shear_modulus), d / P);
                const double G =
                    6.0 * P * P / (s.width * s.width * h) * (2.0 * a * a / (h * h * E) + 1.0 / (5.0 * s.shear_modulus));
                return Reduced{G, a - flexural.delta};
              },
          .constants = {{"E_flexural", "Pa", E}, {"Delta", "m", flexural.delta}}};
}

constexpr ReductionMethod opening_methods[] = {
    {"modified_beam_theory",
     "ASTM D5528 (MBT), ISO 15024 (CBT): G = 3 P d/(2 b (a + Delta)) F/N, Delta >= 0 by the line of (C/N)^(1/3) over a",
     true, opening_modified_beam_theory},
    {"compliance_calibration", "ASTM D5528 (CC; Berry): G = n P d/(2 b a) F/N, n the slope of log C/N over log a", true,
     opening_compliance_calibration},
    {"modified_compliance_calibration",
     "ASTM D5528 (MCC): G = 3 P^2 (C/N)^(2/3)/(2 A1 b 2h) F, A1 the slope of a/(2h) over (C/N)^(1/3)", true,
     opening_modified_compliance_calibration},
    {"equivalent_crack",
     "CBBM; de Moura, Morais, Dourado, Eng. Fract. Mech. 75 (2008) 3852: G = 6 P^2/(b^2 h) (2 a_e^2/(h^2 E_f) + "
     "1/(5 G13)), a_e by C = 8 a_e^3/(E_f b h^3) + 12 a_e/(5 b h G13)",
     false, opening_equivalent_crack},
};

}  // namespace

std::span<const ReductionMethod> double_cantilever_beam_methods() { return opening_methods; }

}  // namespace pfdm
