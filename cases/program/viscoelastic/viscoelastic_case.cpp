#include "cases/program/viscoelastic/viscoelastic_case.h"

#include "cases/program/input/laws/prony_reader.h"
#include "cases/program/point/control_values.h"
#include "cases/program/viscoelastic/viscoelastic_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double logarithmic_span = 1e6;  // of a segment's duration over its first increment

ConfigValue value_of(const ConfigTable& segment) {
  if (segment.has("strain") == segment.has("stress"))
    throw segment.error("a segment has either a strain or a stress, as in strain = \"2 %\"");
  return segment.at(segment.has("strain") ? "strain" : "stress");
}

/// From zero to the segment's end.
std::vector<double> times_of_segment(const ConfigTable& segment, const std::filesystem::path& directory) {
  const ConfigValue value = value_of(segment);
  const bool has_times = segment.has("duration") || segment.has("increments");
  if (!has_times && value.is_table() && value.table().has("csv")) return control_times(value.table(), directory);
  const double duration = segment.quantity("duration");
  const auto n = segment.integer("increments");
  const bool logarithmic = segment.choice("spacing", "even") == "logarithmic";
  std::vector<double> times{0.0};
  for (std::int64_t i = 1; i <= n; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(n);
    const double decades = n > 1 ? static_cast<double>(i - n) / static_cast<double>(n - 1) : 0.0;
    times.push_back(duration * (logarithmic ? std::pow(logarithmic_span, decades) : part));
  }
  return times;
}

void add_segment(const ConfigTable& segment, const std::filesystem::path& directory, BulkLoading& loading) {
  const std::vector<double> times = times_of_segment(segment, directory);
  LoadSegment::Condition condition;
  read_control_value(value_of(segment), loading.is_stress, times, directory, loading.data_files, condition);
  const bool is_first = loading.times.empty();
  const double start = is_first ? 0.0 : loading.times.back(), before = is_first ? 0.0 : loading.values.back();
  const bool follows = condition.pace == Pace::follow;
  if (!is_first && follows && std::abs(condition.values[0] - before) > 1e-6 * std::abs(condition.values[0]))
    throw value_of(segment).error(fmt::format(
        "the segment begins at {:.6g} and the one before ends at {:.6g}: a jump needs a short segment of its "
        "own",
        condition.values[0], before));
  for (std::size_t i = is_first ? 0 : 1; i < times.size(); ++i) {
    loading.times.push_back(start + times[i]);
    loading.values.push_back(follows ? condition.values[i]
                                     : before + (condition.values.back() - before) * times[i] / times.back());
  }
}

/// Beyond, double precision cannot tell branches from each other.
void require_size(const ConfigTable& material, const PronyLaw& law) {
  const auto require = [&](std::string_view what, double value, double least, std::string_view unit) {
    if (!(value >= least && value <= 1e15))
      throw material.error(
          fmt::format("{} of {:.3g} {}: must be between {:g} and 1e15 {}", what, value, unit, least, unit));
  };
  require("young_modulus", law.relaxed.young_modulus(), 1e-3, "Pa");
  for (const auto& [key, branches] : {std::pair("shear_branches", &law.shear), std::pair("bulk_branches", &law.bulk)})
    for (const PronyBranch& branch : *branches) {
      require(fmt::format("{}: a modulus", key), branch.modulus, 1e-3, "Pa");
      require(fmt::format("{}: a time", key), branch.time, 1e-15, "s");
    }
}

BulkLoading read_loading(const ConfigTable& table, const std::filesystem::path& directory) {
  BulkLoading loading;
  loading.deformation = table.choice("deformation", "tension") == "shear" ? Deformation::shear : Deformation::tension;
  const std::vector<ConfigTable> segments = table.tables("segments");
  if (segments.empty()) throw table.at("segments").error("at least one [[loading.segments]] is required");
  loading.is_stress = segments.front().has("stress");
  for (const ConfigTable& segment : segments) {
    if (segment.has("stress") != loading.is_stress)
      throw segment.error("all segments prescribe the strain, or all the stress: the first one prescribes the other");
    add_segment(segment, directory, loading);
  }
  return loading;
}

FrequencyRange read_range(const ConfigTable& table) {
  FrequencyRange range{.from = table.quantity("from"), .to = table.quantity("to")};
  range.points_per_decade = static_cast<int>(table.integer("points_per_decade", std::int64_t{10}));
  if (!(range.from < range.to)) throw table.at("to").error("must be above \"from\"");
  return range;
}

}  // namespace

std::vector<double> frequencies_of(const FrequencyRange& range) {
  const double decades = std::log10(range.to / range.from);
  const int n = std::max(1, static_cast<int>(std::ceil(decades * range.points_per_decade - 1e-9)));
  std::vector<double> frequencies;
  for (int i = 0; i <= n; ++i) frequencies.push_back(range.from * std::pow(10.0, decades * i / n));
  return frequencies;
}

ViscoelasticCase read_viscoelastic_case(const ConfigTable& root, const std::filesystem::path& case_directory) {
  root.with_keys(viscoelastic_case_keys());
  ViscoelasticCase result;
  result.title = root.line("title");
  result.law = read_prony_series(root.table("material"));
  require_size(root.table("material"), result.law);
  if (root.has("loading")) result.loading = read_loading(root.table("loading"), case_directory);
  if (root.has("frequency_sweep")) result.sweep = read_range(root.table("frequency_sweep"));
  if (root.has("fit")) result.fit = read_viscoelastic_fit(root.table("fit"), result.law, case_directory);
  if (!result.loading && !result.sweep)
    throw root.error("[loading] or [frequency_sweep] is required: what pfdm run computes");
  return result;
}

}  // namespace pfdm
