#pragma once
// [loading] of a case of kind "endochronic": six conditions on stress and strain, segment by segment.

#include "cases/program/input/config/config.h"
#include "solver/point/mixed_control.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace pfdm {

struct EndochronicLoading {
  std::vector<LoadSegment> segments;
  ControlSettings settings;
  std::vector<std::filesystem::path> data_files;
};

/// A component that may be prescribed: stress_xx ... stress_xy, strain_xx ... strain_xy, gamma_yz, gamma_xz, gamma_xy.
struct ControlledComponent {
  ControlCondition condition;
  int pair = 0;  ///< 0 ... 5, which component of stress and strain
  bool is_stress = false;
};
/// Throws InputError that names those there are.
ControlledComponent controlled_component(std::string_view name);

/// Stress as a quantity; strain as a number or a quantity, as in 0.01 or "1 %".
double read_component_value(const ConfigValue& value, bool is_stress);

/// The law tells whether conditions are independent. Throws InputError with the place of what is wrong.
EndochronicLoading read_endochronic_loading(const ConfigTable& loading, const EndochronicLaw& law,
                                            const std::filesystem::path& case_directory);

}  // namespace pfdm
