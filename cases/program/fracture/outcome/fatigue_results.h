#pragma once
// What a run writes of fatigue: a table by load step.

#include "solver/fracture/model/state.h"

#include <string>
#include <vector>

namespace pfdm {

inline constexpr const char* fatigue_file = "fatigue.csv";

std::vector<std::string> columns_of_fatigue();  ///< of fatigue_file
std::vector<double> row_of_fatigue(const StepReport& report);

}  // namespace pfdm
