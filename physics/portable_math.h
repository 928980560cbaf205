#pragma once
// Elementary functions with the same bits on every processor. The C library has code of its own for processors with
// FMA, whose results differ in the last bit. These are rounded once from long double, for which there is one code;
// results agree but for one argument in some thousands, where long double itself has other widths (arm64).

#include <cmath>

namespace pfdm::portable {

inline double sin(double x) { return static_cast<double>(::sinl(x)); }
inline double cos(double x) { return static_cast<double>(::cosl(x)); }
inline double atan2(double y, double x) { return static_cast<double>(::atan2l(y, x)); }
inline double exp(double x) { return static_cast<double>(::expl(x)); }
inline double log(double x) { return static_cast<double>(::logl(x)); }
inline double log1p(double x) { return static_cast<double>(::log1pl(x)); }
inline double cbrt(double x) { return static_cast<double>(::cbrtl(x)); }
inline double pow(double x, double y) { return static_cast<double>(::powl(x, y)); }

}  // namespace pfdm::portable
