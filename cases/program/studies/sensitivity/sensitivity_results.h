#pragma once
// What pfdm sensitivity has found, in files and words.

#include "cases/program/input/case_files/case_parameter.h"
#include "cases/program/studies/sensitivity/curve_sensitivity.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// Elasticities by one parameter.
struct ParameterSensitivity {
  CaseParameter parameter;
  std::string failure{};                          ///< why there are none; else empty
  std::vector<Elasticity> curve{};                ///< at each row of the curve
  std::vector<std::vector<Elasticity>> events{};  ///< of each event, each quantity

  /// Over the rows where they are known and not doubtful.
  struct Overview {
    std::optional<std::size_t> largest;  ///< row of the largest in magnitude
    double mean = 0.0;                   ///< of the magnitude, over the displacement
    double error = 0.0;                  ///< the largest
    std::size_t n_doubtful = 0, n_unknown = 0;
  };
  Overview overview(const SampledCurve& curve) const;
};

struct CaseSensitivity {
  std::string name, title, version, hash;  ///< of the case
  std::string method, doubt;               ///< in words: how it was found, why some of it is doubtful
  SampledCurve curve;
  std::vector<BaseEvent> events;
  std::vector<ParameterSensitivity> parameters;  ///< that which moves the curve most first
  std::vector<std::string> remarks;              ///< sentences
};

inline constexpr const char* sensitivity_csv = "sensitivity.csv";
inline constexpr const char* sensitivity_json = "sensitivity.json";

/// Brings the parameters into their order, and adds remarks on what is doubtful or missing.
void conclude(CaseSensitivity& found);

/// sensitivity.json and sensitivity.csv. Throws ComputationError.
void write_sensitivity(const std::filesystem::path& folder, const CaseSensitivity& found);

/// Lines of a table of the parameters, and of one for each event.
std::vector<std::string> words_of(const CaseSensitivity& found);

/// Its name, of joined keys as "materials.concrete.toughness + 1 more".
std::string full_name(const CaseParameter& parameter);

/// The same without the table where it is one of a material or a region.
std::string short_name(const CaseParameter& parameter);

/// "0.512 +- 0.002", with a question mark where it is doubtful; "-" where there is none.
std::string text_of(const Elasticity& elasticity);

}  // namespace pfdm
