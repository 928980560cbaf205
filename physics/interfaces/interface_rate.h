#pragma once
// Factor by which the rate of opening raises the traction of an interface: T = (1 + r(v)) T_0, with T_0 of the law
// without rate (interface_law.h) and v = d lambda/dt the rate of the equivalent separation, while it grows; r = 0 at
// rest and where it falls. Strength and toughness grow by the same factor:
//
//   power         r = (v/v_0)^m   the toughness of rubbers and adhesives over the speed (Maugis, Barquins,
//                 J. Phys. D 11 (1978) 1989), as a law of the interface (Corigliano, Ricci,
//                 Int. J. Solids Struct. 38 (2001) 547)
//   logarithmic   r = c ln(1 + v/v_0)   adhesives at impact (Marzi, Hesebeck, Brede, Kleiner,
//                 J. Adhes. Sci. Technol. 23 (2009) 881), here without a lower limit of the rate
//
// With m < 1 the first has an infinite slope at rest: below 1e-12 v_0 it is straight. Where a face hardly moves its
// overstress follows from its balance, and the rate from that.

#include "physics/law_parameters.h"

#include <span>
#include <string_view>

namespace pfdm {

/// r, and its derivative by the rate [s/m].
struct Overstress {
  double value = 0.0;
  double slope = 0.0;
};

/// A row of the table. `p`: the parameters in their order.
struct InterfaceRateLaw {
  std::string_view name;
  std::string_view description;
  std::span<const LawParameter> parameters;
  Overstress (*overstress)(const LawParameters& p, double rate);
  double (*rate)(const LawParameters& p, double overstress);  ///< its inverse [m/s]
};
std::span<const InterfaceRateLaw> interface_rate_laws();

/// A law with its parameters, or none.
struct InterfaceRate {
  const InterfaceRateLaw* law = nullptr;
  LawParameters p{};

  bool any() const { return law != nullptr; }
  /// Overstress at a rate of the separation [m/s]; nothing where it does not grow.
  Overstress at(double rate) const { return rate > 0.0 ? law->overstress(p, rate) : Overstress{}; }
  /// The rate of the separation that has this overstress [m/s]; zero of none.
  double rate_of(double overstress) const { return overstress > 0.0 ? law->rate(p, overstress) : 0.0; }
};

}  // namespace pfdm
