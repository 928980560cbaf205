#pragma once
// A case of kind "viscoelastic": a Prony series, what it is asked for, and what is to be estimated.

#include "cases/program/viscoelastic/viscoelastic_fit_case.h"
#include "physics/materials/prony_response.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// A strain (engineering in shear) or a stress [Pa], linear between the times [s], from material at rest.
struct BulkLoading {
  Deformation deformation = Deformation::tension;
  bool is_stress = false;
  std::vector<double> times{}, values{};
  std::vector<std::filesystem::path> data_files{};
};

struct FrequencyRange {
  double from = 0.0, to = 0.0;  ///< [Hz]
  int points_per_decade = 10;
};
/// Evenly on the logarithmic scale, both ends among them [Hz].
std::vector<double> frequencies_of(const FrequencyRange& range);

struct ViscoelasticCase {
  std::string title;
  PronyLaw law;
  std::optional<BulkLoading> loading{};
  std::optional<FrequencyRange> sweep{};
  std::optional<ViscoelasticFitCase> fit{};
};

/// Throws InputError for whatever is wrong with it.
ViscoelasticCase read_viscoelastic_case(const ConfigTable& root, const std::filesystem::path& case_directory);

}  // namespace pfdm
