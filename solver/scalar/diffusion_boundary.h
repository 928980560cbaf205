#pragma once
// What is prescribed of a diffusing field on the surface of a body.

#include <string>

namespace pfdm {

/// What is prescribed on a patch; patches that are not named are insulated.
struct DiffusionBoundary {
  enum class Kind {
    value,     ///< u
    flux,      ///< per area, into the body
    exchange,  ///< Robin: per area, out of the body, coefficient (u - value), as by convection
  };
  std::string patch;
  Kind kind = Kind::value;
  double value = 0.0;        ///< of u at the face or beyond it; of the flux [W/m^2]
  double coefficient = 0.0;  ///< of an exchange [W/(m^2 K)], positive
};

}  // namespace pfdm
