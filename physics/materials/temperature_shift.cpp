#include "physics/materials/temperature_shift.h"

#include "physics/portable_math.h"

#include <limits>
#include <numbers>

namespace pfdm {

double TemperatureShift::factor(double temperature) const {
  constexpr double gas_constant = 8.31446261815324;  // [J/(mol K)]
  if (!(temperature > least_temperature())) return std::numeric_limits<double>::infinity();
  if (law == Law::arrhenius)
    return portable::exp(activation_energy / gas_constant * (1.0 / temperature - 1.0 / reference));
  const double warmer = temperature - reference;
  return portable::exp(-std::numbers::ln10 * c1 * warmer / (c2 + warmer));
}

}  // namespace pfdm
