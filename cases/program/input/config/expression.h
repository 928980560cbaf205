#pragma once
// Formulas in the input: functions of the place and of the load parameter. The only place that knows muParser.

#include "physics/tensor.h"

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

}  // namespace pfdm
