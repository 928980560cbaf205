#include "postproc/reduction/beam_terms.h"
#include "postproc/reduction/test_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double nearest_to_lever = 0.95;  // of an equivalent crack, over L

/// The specimen as ASTM D6671 has it: C(a) and G(P, a), SI.
struct LeveredBeam {
  double h, L, c, b;
  double chi = not_given, modulus = not_given;  ///< E_1f

  double opening() const { return square(3.0 * c - L); }
  double shear() const { return square(c + L); }
  /// E_1f C(a) [1/m].
  double unit_compliance(double a) const {
    return (8.0 * cube(a + chi * h) * opening() +
            (6.0 * cube(a + root_rotation_in_shear * chi * h) + 4.0 * cube(L)) * shear()) /
           (16.0 * L * L * b * cube(h));
  }
  Reduced reduced(double P, double a) const {
    const double common = P * P / (16.0 * b * b * cube(h) * L * L * modulus);
    const double first = 12.0 * common * opening() * square(a + chi * h);
    const double second = 9.0 * common * shear() * square(a + root_rotation_in_shear * chi * h);
    return {first + second, a, second / (first + second)};
  }
};

/// "", or what a levered beam lacks.
std::string missing_of_lever(const TestDimensions& s) {
  std::string missing =
      missing_dimensions({{"transverse_modulus", s.transverse_modulus}, {"shear_modulus", s.shear_modulus}});
  if (!missing.empty() || s.lever > s.half_span / 3.0) return missing;
  return "needs a lever above a third of half_span: shorter ones close the crack";
}

/// E_1f of the initial compliance; chi of the modulus that is given, and without one of E_1f, by iteration.
LeveredBeam levered_beam(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  LeveredBeam beam{.h = s.arm(), .L = s.half_span, .c = s.lever, .b = s.width};
  const bool is_given = !std::isnan(s.young_modulus);
  beam.chi = is_given ? root_rotation(s.young_modulus, s.transverse_modulus, s.shear_modulus) : 0.0;
  for (int k = 0; k < 200; ++k) {
    const double before = beam.modulus;
    beam.modulus = beam.unit_compliance(s.crack_length) / data.straight.compliance;
    if (is_given || std::abs(beam.modulus / before - 1.0) < 1e-13) break;
    beam.chi = root_rotation(beam.modulus, s.transverse_modulus, s.shear_modulus);
  }
  return beam;
}

/// "", or that cracks have passed the lever's middle load.
std::string remark_on_middle(const CalibrationData& data) {
  double longest = 0.0;
  for (const std::size_t i : data.grown) longest = std::max(longest, data.record.crack_length[i]);
  if (!(longest > data.specimen.half_span)) return "";
  return fmt::format("crack lengths up to {:.4g} mm pass the middle at {:.4g} mm, where beam_theory does not hold",
                     1e3 * longest, 1e3 * data.specimen.half_span);
}

CalibratedMethod mixed_beam_theory(const CalibrationData& data) {
  const std::string missing = missing_of_lever(data.specimen);
  if (!missing.empty()) return {.missing = missing};
  const LeveredBeam beam = levered_beam(data);
  return {.at = [=](double P, double, double a) { return beam.reduced(P, a); },
          .constants = {{"E_flexural", "Pa", beam.modulus}, {"chi", "1", beam.chi}},
          .remark = remark_on_middle(data)};
}

CalibratedMethod mixed_equivalent_crack(const CalibrationData& data) {
  const std::string missing = missing_of_lever(data.specimen);
  if (!missing.empty()) return {.missing = missing};
  const LeveredBeam beam = levered_beam(data);
  return {.at =
              [=, longest = nearest_to_lever * beam.L](double P, double d, double) {
                const double a =
                    crack_of([&](double at) { return beam.unit_compliance(at); }, d / P * beam.modulus, 0.0, longest);
                const bool is_inside = a > 1e-9 * longest && a < (1.0 - 1e-9) * longest;
                return is_inside ? beam.reduced(P, a) : Reduced{not_given, a};
              },
          .constants = {{"E_flexural", "Pa", beam.modulus}}};
}

constexpr ReductionMethod mixed_methods[] = {
    {"beam_theory",
     "ASTM D6671: GI = 12 P^2 (3c - L)^2 (a + chi h)^2/(16 b^2 h^3 L^2 E_1f), GII = 9 P^2 (c + L)^2 (a + 0.42 chi "
     "h)^2/(16 b^2 h^3 L^2 E_1f); chi by E_1f where no modulus is given",
     true, mixed_beam_theory},
    {"equivalent_crack",
     "the same at the crack that the compliance d/P tells, ASTM D6671: C = (8 (a + chi h)^3 (3c - L)^2 + (6 (a + 0.42 "
     "chi h)^3 + 4 L^3) (c + L)^2)/(16 L^2 b h^3 E_1f); up to 0.95 L",
     false, mixed_equivalent_crack},
};

}  // namespace

std::span<const ReductionMethod> mixed_mode_bending_methods() { return mixed_methods; }

}  // namespace pfdm
