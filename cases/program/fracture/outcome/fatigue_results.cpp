#include "cases/program/fracture/outcome/fatigue_results.h"

namespace pfdm {

std::vector<std::string> columns_of_fatigue() {
  return {"step", "load", "cycles", "jumped_cycles", "greatest_energy_over_threshold", "least_toughness_factor"};
}

std::vector<double> row_of_fatigue(const StepReport& report) {
  const FatigueReport fatigue = report.fatigue.value_or(FatigueReport());
  return {static_cast<double>(report.step), report.load,         fatigue.cycles, fatigue.jumped_cycles,
          fatigue.greatest_energy,          fatigue.least_factor};
}

}  // namespace pfdm
