#include "postproc/reduction/beam_terms.h"
#include "postproc/reduction/test_methods.h"

#include <cmath>

namespace pfdm {
namespace {

constexpr double nearest_to_nose = 0.95;  // of an equivalent crack, over L

/// Compliance that the beam's shear adds, 3 L/(10 b h G13) [m/N]; 0 where the modulus is not given.
double shear_compliance(const TestDimensions& s) {
  return std::isnan(s.shear_modulus) ? 0.0 : 3.0 * s.half_span / (10.0 * s.width * s.arm() * s.shear_modulus);
}

CalibratedMethod shear_compliance_calibration(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  std::vector<double> cubes, compliances = s.calibration_compliances;
  for (const double a : s.calibration_lengths) cubes.push_back(cube(a));
  if (cubes.empty())
    for (const std::size_t i : data.grown) {
      cubes.push_back(cube(data.record.crack_length[i]));
      compliances.push_back(data.record.displacement[i] / data.record.force[i]);
    }
  const FittedLine line = fitted_line(cubes, compliances);
  if (std::isnan(line.slope))
    return {.missing =
                "needs compliances at two crack lengths or more (calibration_lengths, calibration_compliances), "
                "or crack lengths at two points of growth"};
  return {.at =
              [b = s.width, m = line.slope](double P, double, double a) {
                return Reduced{1.5 * m * P * P * a * a / b, a};
              },
          .constants = {{"A", "m/N", line.intercept}, {"m", "1/(N m^2)", line.slope}}};
}

CalibratedMethod shear_direct_beam_theory(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  return {.at = [b = s.width, L = s.half_span](double P, double d, double a) {
    return Reduced{4.5 * a * a * P * d / (b * (2.0 * cube(L) + 3.0 * cube(a))), a};
  }};
}

/// E and the length that the crack acts longer by: of the initial compliance, but for an E that is given.
struct ShearModulus {
  double modulus, delta;
};
ShearModulus shear_flexural_modulus(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  const double h = s.arm(), bending = data.straight.compliance - shear_compliance(s);
  const auto of_length = [&](double a) {
    return (2.0 * cube(s.half_span) + 3.0 * cube(a)) / (8.0 * s.width * cube(h) * bending);
  };
  ShearModulus found{std::isnan(s.young_modulus) ? of_length(s.crack_length) : s.young_modulus, 0.0};
  for (int k = 0; k < 200; ++k) {
    found.delta = root_rotation_in_shear * h * root_rotation(found.modulus, s.transverse_modulus, s.shear_modulus);
    if (!std::isnan(s.young_modulus)) break;
    const double before = found.modulus;
    found.modulus = of_length(s.crack_length + found.delta);
    if (std::abs(found.modulus / before - 1.0) < 1e-13) break;
  }
  return found;
}

CalibratedMethod shear_corrected_beam_theory(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  const std::string missing =
      missing_dimensions({{"transverse_modulus", s.transverse_modulus}, {"shear_modulus", s.shear_modulus}});
  if (!missing.empty()) return {.missing = missing};
  const ShearModulus flexural = shear_flexural_modulus(data);
  const double E = flexural.modulus, delta = flexural.delta;
  if (!(E > 0.0)) return {.missing = "the initial compliance is less than that of the beam's shear alone"};
  return {.at =
              [=, b = s.width, h = s.arm()](double P, double, double a) {
                return Reduced{9.0 * P * P * (a + delta) * (a + delta) / (16.0 * b * b * cube(h) * E), a};
              },
          .constants = {{"E_flexural", "Pa", E}, {"Delta", "m", delta}}};
}

CalibratedMethod shear_equivalent_crack(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  const std::string missing = missing_dimensions({{"shear_modulus", s.shear_modulus}});
  if (!missing.empty()) return {.missing = missing};
  const double h = s.arm(), L = s.half_span, shear = shear_compliance(s), b = s.width;
  const double bending = data.straight.compliance - shear;
  if (!(bending > 0.0)) return {.missing = "the initial compliance is less than that of the beam's shear alone"};
  const double E = (3.0 * cube(s.crack_length) + 2.0 * cube(L)) / (8.0 * b * cube(h) * bending);
  return {.at =
              [=, a0 = s.crack_length](double P, double d, double) {
                const double ratio = (d / P - shear) / bending;
                const double a = std::cbrt(ratio * cube(a0) + 2.0 / 3.0 * (ratio - 1.0) * cube(L));
                if (a > nearest_to_nose * L) return Reduced{not_given, a};  // beams of another kind
                return Reduced{9.0 * P * P * a * a / (16.0 * b * b * cube(h) * E), a};
              },
          .constants = {{"E_flexural", "Pa", E}}};
}

constexpr ReductionMethod shear_methods[] = {
    {"compliance_calibration", "ASTM D7905 (CC): C = A + m a^3, G = 3 m P^2 a^2/(2 b)", true,
     shear_compliance_calibration},
    {"direct_beam_theory", "beam theory with the displacement: G = 9 a^2 P d/(2 b (2 L^3 + 3 a^3))", true,
     shear_direct_beam_theory},
    {"corrected_beam_theory",
     "Wang, Williams, Compos. Sci. Technol. 43 (1992) 251: G = 9 P^2 (a + 0.42 chi h)^2/(16 b^2 h^3 E), E by the "
     "initial "
     "compliance where it is not given",
     true, shear_corrected_beam_theory},
    {"equivalent_crack",
     "CBBM; de Moura, de Morais, Eng. Fract. Mech. 75 (2008) 2584; Xavier et al., Constr. Build. Mater. 71 (2014) 109: "
     "G = "
     "9 P^2 a_e^2/(16 b^2 h^3 E_f), a_e^3 = C/C0 a0^3 + 2/3 (C/C0 - 1) L^3 without the compliance of shear",
     false, shear_equivalent_crack},
};

}  // namespace

std::span<const ReductionMethod> end_notched_flexure_methods() { return shear_methods; }

}  // namespace pfdm
