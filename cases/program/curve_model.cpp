#include "cases/program/curve_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfdm {

std::string CurveModel::shown(const std::vector<double>& values) const {
  std::vector<std::string> texts;
  for (std::size_t j = 0; j < values.size(); ++j)
    texts.push_back(fmt::format("{} = {}", parameters_[j].short_name(), parameters_[j].shown(values[j])));
  return fmt::format("{}", fmt::join(texts, ", "));
}

CaseVariant CurveModel::variant(const std::vector<double>& values) const {
  return {with_values(file_, parameters_, values), shown(values)};
}

std::optional<SampledCurve> CurveModel::respond(const std::vector<double>& values, std::optional<double> until) {
  const DoneRun done = runs_.run({variant(values)}, until).front();
  return done.went_well() ? std::optional(read_(done.folder)) : std::nullopt;
}

void CurveModel::prepare(const std::vector<std::vector<double>>& points, std::optional<double> until) {
  std::vector<CaseVariant> variants;
  for (const std::vector<double>& values : points) variants.push_back(variant(values));
  runs_.run(variants, until);
}

}  // namespace pfdm
