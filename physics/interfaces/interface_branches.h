#pragma once
// Maxwell branches beside the law of an interface: each a spring K and a dashpot K tau in series, stretched by the
// separation p = <delta_n> n + delta_s, with the traction w q,
//
//   q' + q/tau = K p',
//
// exact for a separation that changes linearly in the step (physics/prony_decay.h). w is the share of its stiffness in
// shear that the bond still has, as of friction (interface_law.h). It is 1 at first and 0 in the end, so that the
// branches vanish with debonding (as damage does in Musto, Alfano, Comput. Struct. 118 (2013) 126). At small strain.
//
// w |q|^2/(2 K) is stored. Viscous is what the dashpot takes, with the mean of w at the step's ends, and what springs
// lose as w falls: in balance with the work of the tractions to the second order.

#include "physics/tensor.h"

#include <array>

namespace pfdm {

struct InterfaceBranch {
  double stiffness = 0.0;  ///< K [Pa/m]
  double time = 0.0;       ///< tau [s]
};

inline constexpr std::size_t most_interface_branches = 3;
/// q of each [Pa].
using BranchTractions = std::array<Vector, most_interface_branches>;
inline BranchTractions relaxed_branches() { return {Vector::Zero(), Vector::Zero(), Vector::Zero()}; }

}  // namespace pfdm
