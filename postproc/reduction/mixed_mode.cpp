#include "postproc/reduction/beam_terms.h"
#include "postproc/reduction/test_methods.h"

#include <cmath>

namespace pfdm {
namespace {

/// ASTM D6671: E_1f of the initial compliance, the modes by the loads on the arms.
CalibratedMethod mixed_beam_theory(const CalibrationData& data) {
  const TestDimensions& s = data.specimen;
  const std::string missing = missing_dimensions({{"young_modulus", s.young_modulus},
                                                  {"transverse_modulus", s.transverse_modulus},
                                                  {"shear_modulus", s.shear_modulus}});
  if (!missing.empty()) return {.missing = missing};
  const double h = s.arm(), L = s.half_span, c = s.lever, b = s.width;
  if (!(c > L / 3.0)) return {.missing = "needs a lever above a third of half_span: shorter ones close the crack"};
  const double chi = root_rotation(s.young_modulus, s.transverse_modulus, s.shear_modulus);
  const double opening = square(3.0 * c - L), shear = square(c + L);
  const double E = (8.0 * cube(s.crack_length + chi * h) * opening +
                    (6.0 * cube(s.crack_length + root_rotation_in_shear * chi * h) + 4.0 * cube(L)) * shear) /
                   (16.0 * L * L * b * cube(h) * data.straight.compliance);
  return {.at =
              [=](double P, double, double a) {
                const double common = P * P / (16.0 * b * b * cube(h) * L * L * E);
                const double first = 12.0 * common * opening * square(a + chi * h);
                const double second = 9.0 * common * shear * square(a + root_rotation_in_shear * chi * h);
                return Reduced{first + second, a, second / (first + second)};
              },
          .constants = {{"E_flexural", "Pa", E}, {"chi", "1", chi}}};
}

constexpr ReductionMethod mixed_methods[] = {
    {"beam_theory",
     "ASTM D6671: GI = 12 P^2 (3c - L)^2 (a + chi h)^2/(16 b^2 h^3 L^2 E_1f), GII = 9 P^2 (c + L)^2 (a + 0.42 chi "
     "h)^2/(16 b^2 h^3 L^2 E_1f)",
     true, mixed_beam_theory},
};

}  // namespace

std::span<const ReductionMethod> mixed_mode_bending_methods() { return mixed_methods; }

}  // namespace pfdm
