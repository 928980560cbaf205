#include "cases/program/point/endochronic_loading.h"

#include "cases/program/point/control_values.h"
#include "cases/program/point/endochronic_case_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pfdm {
namespace {

/// A segment while it is read.
struct Draft {
  const ConfigTable& table;
  const std::filesystem::path& directory;
  std::vector<std::filesystem::path>& files;
  LoadSegment segment;
  std::vector<LoadSegment::Condition> conditions;
  std::array<bool, 6> named{};  // pairs of stress and strain that something was said about
};

std::optional<ConfigTable> control_table(const Draft& draft) {
  if (!draft.table.has("control")) return std::nullopt;
  return draft.table.table("control");
}

/// From duration and increments, or the times of the file that a component follows.
std::vector<double> segment_times(const Draft& draft) {
  if (!draft.table.has("duration") && !draft.table.has("increments"))
    if (const auto control = control_table(draft))
      for (const auto& [key, value] : control->entries())
        if (value.is_table() && value.table().has("csv")) return control_times(value.table(), draft.directory);
  const double duration = draft.table.quantity("duration");
  const auto n = draft.table.integer("increments");
  std::vector<double> times;
  for (std::int64_t i = 0; i <= n; ++i) times.push_back(duration * static_cast<double>(i) / static_cast<double>(n));
  return times;
}

void read_components(Draft& draft) {
  const auto control = control_table(draft);
  if (!control) return;
  for (const auto& [key, value] : control->entries()) {
    const ControlledComponent component = value.in_context([&name = key] { return controlled_component(name); });
    LoadSegment::Condition condition{.condition = component.condition, .pace = Pace::ramp, .values = {}};
    read_control_value(value, component.is_stress, draft.segment.times, draft.directory, draft.files, condition);
    draft.conditions.push_back(std::move(condition));
    draft.named[component.pair] = true;
  }
}

/// { sum = { stress_xx = 1, strain_yy = "100 GPa" }, change = ... }
void read_linear_condition(Draft& draft, const ConfigTable& table) {
  const auto terms = table.table("sum").entries();
  const bool has_stress = std::ranges::any_of(terms, [](const auto& term) { return term.first.starts_with("stress"); });
  LoadSegment::Condition condition{.condition = {}, .pace = Pace::increment, .values = {}};
  for (const auto& [key, value] : terms) {
    const ControlledComponent component = value.in_context([&name = key] { return controlled_component(name); });
    const bool modulus = has_stress && !component.is_stress;
    const double factor = modulus ? value.quantity(dimension::stress) : value.number();
    condition.condition.on_stress += factor * component.condition.on_stress;
    condition.condition.on_strain += factor * component.condition.on_strain;
    draft.named[component.pair] = true;
  }
  if (const auto change = table.find("change"))
    read_control_value(*change, has_stress, draft.segment.times, draft.directory, draft.files, condition);
  else
    condition.values.assign(draft.segment.times.size(), 0.0);
  if (condition.pace == Pace::ramp) {  // a plain value: the change over the whole segment
    const double all = condition.values.back();
    condition.values.clear();
    for (const double t : draft.segment.times) condition.values.push_back(all * t / draft.segment.times.back());
  }
  condition.pace = Pace::increment;
  draft.conditions.push_back(std::move(condition));
}

/// Pairs that nothing is said about are free of stress.
void complete(Draft& draft) {
  if (draft.table.has("free")) {
    for (const ConfigValue& entry : draft.table.at("free").list()) {
      const std::string name = entry.choice();
      draft.named[std::ranges::find(component_names, name) - component_names.begin()] = true;
    }
  }
  for (std::size_t k = 0; k < 6; ++k) {
    if (draft.named[k]) continue;
    const std::string key = fmt::format("stress_{}", component_names[k]);
    draft.conditions.push_back({controlled_component(key).condition, Pace::ramp, {0.0}});
  }
  if (draft.conditions.size() != 6)
    throw draft.table.error(
        fmt::format("expected 6 conditions on stress and strain, found {} (a pair that is not named counts as free of "
                    "stress; free = [\"yy\"] omits that condition)",
                    draft.conditions.size()));
  std::ranges::move(draft.conditions, draft.segment.conditions.begin());
}

LoadSegment read_segment(const ConfigTable& table, const EndochronicLaw& law, const std::filesystem::path& directory,
                         std::vector<std::filesystem::path>& files) {
  Draft draft{.table = table, .directory = directory, .files = files, .segment = {}, .conditions = {}};
  draft.segment.times = segment_times(draft);
  read_components(draft);
  for (const ConfigTable& condition : table.tables("conditions")) read_linear_condition(draft, condition);
  complete(draft);
  std::array<ControlCondition, 6> conditions;
  std::ranges::transform(draft.segment.conditions, conditions.begin(), [](const auto& c) { return c.condition; });
  if (const auto why = dependent_conditions(law, conditions)) throw table.error(*why);
  return std::move(draft.segment);
}

}  // namespace

ControlledComponent controlled_component(std::string_view name) {
  for (int k = 0; k < n_components; ++k) {
    const std::string_view component = component_names[k];
    const Mandel unit = Mandel::Unit(k) / mandel_factor(k);
    if (name == fmt::format("stress_{}", component)) return {{unit, Mandel::Zero()}, k, true};
    if (name == fmt::format("strain_{}", component)) return {{Mandel::Zero(), unit}, k, false};
    if (k >= 3 && name == fmt::format("gamma_{}", component)) return {{Mandel::Zero(), 2.0 * unit}, k, false};
  }
  const std::vector<std::string>& keys = point_component_keys();
  throw InputError(fmt::format("\"{}\" is not a component of stress or strain{} (available: {})", name,
                               did_you_mean(name, keys), fmt::join(keys, ", ")));
}

double read_component_value(const ConfigValue& value, bool is_stress) {
  if (is_stress) return value.quantity(dimension::stress);
  return value.is_string() ? value.quantity(dimension::number) : value.number();
}

EndochronicLoading read_endochronic_loading(const ConfigTable& loading, const EndochronicLaw& law,
                                            const std::filesystem::path& case_directory) {
  EndochronicLoading result;
  std::vector<LoadSegment> once;
  for (const ConfigTable& table : loading.tables("segments"))
    once.push_back(read_segment(table, law, case_directory, result.data_files));
  if (once.empty()) throw loading.at("segments").error("at least one [[loading.segments]] is required");
  const auto repeat = loading.integer("repeat", std::int64_t{1});
  for (std::int64_t i = 0; i < repeat; ++i) result.segments.insert(result.segments.end(), once.begin(), once.end());
  result.settings.largest_increment = loading.number("largest_strain_increment", result.settings.largest_increment);
  return result;
}

}  // namespace pfdm
