#pragma once
// The units in which a case gives displacements and forces, and numbers in them.

#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/input/case_files/case_file.h"

#include <string>
#include <string_view>

namespace pfdm {

/// A unit in which the case gives something; without a name: SI with a prefix.
struct CaseUnit {
  std::string name{};
  std::string si_unit;  ///< "m"
  double in_si = 1.0;   ///< [si_unit]
};

struct CurveUnits {
  CaseUnit displacement{.si_unit = "m"};  ///< in which the case prescribes it, of the curve's patch first
  CaseUnit force{.si_unit = "N"};         ///< of the first measured curve of [experiment]
};
CurveUnits read_curve_units(const CaseFile& file, const CurveSettings& curve);

/// "154.6 um", four digits.
std::string shown_in(const CaseUnit& unit, double si);

/// "154.6 and 157.1 um", with the word between them.
std::string two_shown_in(const CaseUnit& unit, double a, std::string_view between, double b);

}  // namespace pfdm
