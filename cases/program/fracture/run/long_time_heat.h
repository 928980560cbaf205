#pragma once
// After cycles of load: the long time that their mean heat warms.

#include "cases/program/fracture/run/running_case.h"

#include <map>
#include <string>

namespace pfdm {

/// Warns of cycles that do not repeat. With [heat] time, writes heat_over_time_file and heated_file, the rises at its
/// end, says what came out, and returns the figures; nothing before a whole cycle.
std::map<std::string, double> heat_at_the_end(RunningCase& running);

}  // namespace pfdm
