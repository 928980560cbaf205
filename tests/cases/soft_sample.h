#pragma once
// A small case of kind "mass_material", and what its jobs leave.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/vibration/mass_material_case.h"
#include "tests/cases/temporary_case.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace pfdm {

inline std::string soft_case() {
  return R"(kind = "mass_material"
title = "a soft sample"

[model]
structure = "2"
mass = "1.12 kg"
stiffness = ["54 kN/m", "-1.0e6 N/m^2", "1.3e8 N/m^3"]
damping = "40 N s/m"

[sample]
length = "76.2 mm"
area = "45.6 cm^2"

[sampling]
rate = "1 kHz"
signal_to_noise_dB = 80

[[test]]
name = "up"
excitation = { type = "swept_sine", level = "2 g0", from = "10 Hz", to = "70 Hz", duration = "6 s" }

[[test]]
name = "down"
predicted = true
excitation = { type = "swept_sine", level = "1.5 g0", from = "70 Hz", to = "10 Hz", duration = "6 s", law = "logarithmic" }

[fit]
replicates = 50
)";
}

inline nlohmann::json parsed(const std::filesystem::path& file) { return nlohmann::json::parse(content_of(file)); }

}  // namespace pfdm
