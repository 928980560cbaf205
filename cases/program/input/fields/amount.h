#pragma once
// Prescribed values and material parameters, plain or as an expression with its unit; points, directions.

#include "cases/program/input/config/config.h"
#include "physics/tensor.h"

#include <functional>
#include <optional>
#include <string>

namespace pfdm {

/// SI value at x [m] and the load parameter t [-]. Throws InputError, with the place in the file, where there is none.
using ScalarField = std::function<double(const Vector& x, double t)>;

struct Amount {
  ScalarField value;
  std::optional<double> at_full_load;  ///< of a plain quantity, which is reached linearly at t = 1; SI
  ScalarField from_start{};            ///< the same where what grows linearly acts from the first step on
};

/// "800 um" or a field out of a file, reached linearly at t = 1, or { expr = "0.1*t", unit = "um" } or a field with
/// times, used as it stands.
Amount read_amount(const ConfigValue& value, const Dimension& due);
Amount read_amount(const ConfigValue& value);  ///< of the dimension that the row of its key says

/// A value that may depend on the place: of a material, or at the beginning.
struct Parameter {
  /// SI value at x [m]. Throws InputError, with the place in the file, where it is out of range.
  std::function<double(const Vector& x)> at;
  bool varies = false;
  std::string text{};  ///< what the file says; equal texts are equal functions
};

/// "75 MPa" or { expr = "75 + 1e4*x", unit = "MPa" }; of a plain number 0.3 or { expr = "0.3 + 20*x" }; or a field out
/// of a file without times.
Parameter read_parameter(const ConfigValue& value, const Dimension& due, const Range& allowed);
Parameter read_parameter(const ConfigValue& value);  ///< of the dimension and range that the row of its key says

/// Three numbers that are not all zero.
Vector read_direction(const ConfigValue& value);

/// Three lengths [m].
Vector read_point(const ConfigValue& value, const Range& allowed = range::any);

}  // namespace pfdm
