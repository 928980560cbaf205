#pragma once
// Values of a case given on the command line: --set KEY=VALUE.

#include "cases/program/input/case_files/case_file.h"

#include <span>
#include <string>

namespace pfdm {

/// The case with other values. A word is as in "materials.steel.young_modulus=200 GPa" or "boundary[1].pressure=2 MPa":
/// a key of the file, or one that a table of it may have in addition, and a text, a number, true, false or a piece of
/// TOML in brackets. Throws InputError for what is no such word, and for keys that cannot be set.
CaseFile with_overrides(const CaseFile& file, std::span<const std::string> words);

}  // namespace pfdm
