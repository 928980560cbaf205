#pragma once
// Terms of beam theory for specimens with two arms.

#include "postproc/reduction/test_record.h"

#include <vector>

namespace pfdm {

inline double square(double x) { return x * x; }
inline double cube(double x) { return x * x * x; }

/// chi of the root rotation, by which a crack acts as if it were chi h longer: ASTM D6671, after Hashemi, Kinloch,
/// Williams, Proc. R. Soc. A 427 (1990) 173:
///   chi^2 = E/(11 G13) (3 - 2 (Gamma/(1 + Gamma))^2),  Gamma = 1.18 (E E33)^(1/2)/G13
double root_rotation(double young_modulus, double transverse_modulus, double shear_modulus);

/// Its share in shear: the ENF's crack acts as if it were 0.42 chi h longer (Wang, Williams, Compos. Sci. Technol. 43
/// (1992) 251; ASTM D6671).
inline constexpr double root_rotation_in_shear = 0.42;

/// Least squares y = intercept + slope x.
struct FittedLine {
  double slope = not_given, intercept = not_given;
};
/// NaN of fewer than two different x.
FittedLine fitted_line(const std::vector<double>& x, const std::vector<double>& y);

/// The crack length at which `compliance_of`, which rises with it, is `compliance`; an end of low to high where that is
/// outside.
double crack_of(const auto& compliance_of, double compliance, double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (compliance_of(middle) < compliance ? low : high) = middle;
  }
  return high;
}

/// F for large displacements (ASTM D5528, annex A1): 1 - 3/10 (d/a)^2 - 3/2 d t/a^2. Without t the last term is left
/// out.
double large_displacement_factor(double displacement, double crack_length, double block_offset);

/// N for end blocks (ASTM D5528, annex A1): 1 - (L'/a)^3 - 9/8 (1 - (L'/a)^2) d t/a^2 - 9/35 (d/a)^2. 1 where no block
/// is given.
double block_factor(double displacement, double crack_length, double block_offset, double block_length);

}  // namespace pfdm
