#pragma once
// A case of kind "endochronic": a material point, its loading, and what is to be estimated.

#include "cases/program/input/laws/endochronic_reader.h"
#include "cases/program/point/endochronic_fit_case.h"
#include "cases/program/point/endochronic_loading.h"

#include <filesystem>
#include <optional>
#include <string>

namespace pfdm {

struct EndochronicCase {
  std::string title;
  EndochronicLaw law;
  EndochronicLoading loading;
  std::optional<EndochronicFit> fit;
};

/// Throws InputError for whatever is wrong with it.
EndochronicCase read_endochronic_case(const ConfigTable& root, const std::filesystem::path& case_directory);

}  // namespace pfdm
