#pragma once
// What the report's iteration did on the way, as files: its iterations, the Prony series, the kernel's responses.

#include "cases/program/session/terminal/log.h"
#include "solver/vibration/identification/identification_ten_steps.h"

#include <filesystem>
#include <optional>

namespace pfdm {

inline constexpr const char* ten_steps_folder = "ten_steps";

/// Writes results/ten_steps/ and says how well the kernel's response is met: by the whole series, by the terms that
/// were kept, and by as many poles of the series' impulse response by the matrix pencil. Removes an earlier one.
/// `rate`: of the record [Hz].
void write_ten_steps(const std::filesystem::path& results, const std::optional<TenSteps>& steps, double rate, Log& log);

}  // namespace pfdm
