#pragma once
// Strains of a material point as they are plotted.

#include "postproc/files/csv_table.h"

#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// Whether a component, as "xy", is one of shear.
bool is_shear(std::string_view component);

/// The column of a component [%], of shear the engineering one; its name has `before` in front, as "measured_".
std::vector<double> plotted_strain(const CsvTable& table, std::string_view component, std::string_view before = {});

/// The title of its axis.
std::string strain_title(std::string_view component);

}  // namespace pfdm
