#pragma once
// What a code that takes a law does otherwise than the law where modes mix: sentences for the head of its file. Empty
// where there is no difference.

#include "postproc/exports/law/exported_law.h"

#include <string>

namespace pfdm {

/// Of codes whose damage begins where the squares of both tractions over their strengths add up to one.
std::string quadratic_strength_remark(const ExportedLaw& law);

/// Of codes with one stiffness for all modes.
std::string one_stiffness_remark(const ExportedLaw& law);

/// Of codes whose stiffness in shear is `stiffness`, in the law's units, whatever the law's.
std::string shear_stiffness_remark(const ExportedLaw& law, double stiffness);

}  // namespace pfdm
