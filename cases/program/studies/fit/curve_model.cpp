#include "cases/program/studies/fit/curve_model.h"

namespace pfdm {

CaseVariant CurveModel::variant(const std::vector<double>& values) const {
  return {with_values(file_, parameters_, values), pfdm::shown(parameters_, values)};
}

std::optional<SampledCurve> CurveModel::respond(const std::vector<double>& values, std::optional<double> until) {
  const DoneRun done = runs_.run({variant(values)}, until).front();
  return done.went_well() ? std::optional(read_(done.folder)) : std::nullopt;
}

std::shared_ptr<const FieldHistory> CurveModel::history(const std::vector<double>& values,
                                                        std::optional<double> until) {
  constexpr std::size_t most_kept = 64;
  const DoneRun done = runs_.run({variant(values)}, until).front();
  if (!done.went_well()) return nullptr;
  const std::pair key(done.folder.string(), until);
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  if (known_.size() >= most_kept) known_.clear();
  return known_[key] = std::make_shared<const FieldHistory>(history_(done.folder));
}

void CurveModel::prepare(const std::vector<std::vector<double>>& points, std::optional<double> until) {
  std::vector<CaseVariant> variants;
  for (const std::vector<double>& values : points) variants.push_back(variant(values));
  runs_.run(variants, until);
}

}  // namespace pfdm
