#pragma once
// What every exported file says of itself before its first card.

#include "postproc/exports/law/exported_law.h"
#include "postproc/exports/law/unit_systems.h"

#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// The same law in another system of units; its remarks stay in SI.
ExportedLaw in_units(ExportedLaw law, const UnitSystem& units);

/// Source, units, frame, range, the figures with what they rest on, the tables' tolerance; of a law in these units.
std::vector<std::string> export_head(const ExportedLaw& law, const UnitSystem& units);

/// A line of comment, broken before 80 characters.
std::string comment_lines(std::string_view text, std::string_view prefix);

}  // namespace pfdm
