#pragma once
// [fit.bounds] of bulk tests: modulus_1 = ["0.1 MPa", "10 MPa"], time_1 = ["1 ms", "1 s"] ...

#include "cases/program/input/config/config.h"
#include "solver/point/viscoelastic_identification.h"

namespace pfdm {

/// Reads the bounds of parameters that are estimated into the limits of the settings. Throws InputError for other
/// names, wrong dimensions, empty intervals, and times that contradict the numbers of their branches.
void read_limits(const ConfigTable& fit, const PronyLaw& law, ViscoelasticSettings& settings);

}  // namespace pfdm
