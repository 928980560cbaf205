#pragma once
// Formulas in the input: functions of the place and of the load parameter. The only place that knows muParser.

#include "physics/tensor.h"

#include <map>
#include <memory>
#include <string>

namespace pfdm {

/// A formula in x, y, z [m] and t [-], with pi and the usual functions (sin, exp, sqrt, min, if: c ? a : b ...).
/// It may be copied and called from several threads at once.
class Expression {
 public:
  /// Throws InputError that says what is wrong with the text.
  explicit Expression(const std::string& text);
  /// Throws InputError if the value is not finite.
  double operator()(const Vector& x, double t) const;
  bool uses_load() const;  ///< whether t occurs in it

 private:
  struct Parsed;
  std::shared_ptr<Parsed> parsed_;
};

/// Of a formula in variables of other names, with pi, the usual functions, ceil and floor. Throws InputError that says
/// what is wrong with the text, or that its value is not finite.
double evaluated(const std::string& text, const std::map<std::string, double>& variables);

}  // namespace pfdm
