#pragma once
// The values of a case by which its curve is differentiated.

#include "cases/program/input/case_files/case_parameter.h"

#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// The values that `words` name, each a key of the case, or several joined by "+" that keep their ratios. Throws
/// InputError for what is no such key, is named twice, or is not positive.
std::vector<CaseParameter> named_parameters(std::span<const std::string> words, const CaseFile& file);

/// Positive physical constants that a fracture case states for its materials, regions and interfaces and of its phase
/// field, in the order of the text; numbers that set a mesh, a seed or a place are none. A phase-field length that the
/// mesh follows is left out and noted in `remarks`: its differences would be those of two meshes.
std::vector<CaseParameter> stated_constants(const CaseFile& file, std::vector<std::string>& remarks);

}  // namespace pfdm
