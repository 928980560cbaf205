#include "cases/program/fracture/outcome/law_source.h"

#include "cases/program/fracture/outcome/fracture_files.h"
#include "physics/error.h"
#include "postproc/fits/fit_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

std::string estimate_text(const FittedParameter& p, const std::string& prefix) {
  std::string text = fmt::format("{} = {:.4g} {}", p.name.substr(prefix.size()), p.estimate, p.unit);
  if (p.profile)
    text += fmt::format(", 95 % interval {:.4g} to {:.4g} by profile likelihood", p.profile->lower, p.profile->upper);
  else if (std::isfinite(p.lower) && std::isfinite(p.upper))
    text += fmt::format(", 95 % interval {:.4g} to {:.4g}", p.lower, p.upper);
  return text;
}

std::string fitted_source(const FitReport& fit, std::size_t index) {
  const std::string prefix = fmt::format("interface[{}].", index);
  std::vector<std::string> own;
  for (const FittedParameter& p : fit.found.parameters)
    if (p.name.starts_with(prefix)) own.push_back(estimate_text(p, prefix));
  return fmt::format(
      "Source: fitted to {} curves of case {} (fit.json, verdict {}); {}; what is not named was given",
      fit.experiments.size(), fit.case_name, name_of(fit.found.verdict),
      own.empty() ? std::string("nothing of this interface was estimated") : fmt::format("{}", fmt::join(own, "; ")));
}

std::string validity(const ColumnRecord& record) {
  double opening = 0.0, sliding = 0.0, damage = 0.0;
  for (const std::vector<ColumnSample>& step : record.steps)
    for (const ColumnSample& s : step) {
      opening = std::max(opening, s.separation[0]);
      sliding = std::max(sliding, s.separation.tail<2>().norm());
      damage = std::max(damage, s.largest_damage);
    }
  return fmt::format(
      "Validity: a run of this case ({} steps) opened the interface up to {:.4g} m, slid it up to {:.4g} m and "
      "dissipated up to {:.3g} of its toughness; beyond, the law is not seen to act",
      record.steps.size() - 1, opening, sliding, damage);
}

}  // namespace

std::vector<std::string> source_of_law(const CaseFile& file, std::size_t index, const std::string& name,
                                       const std::string& hash, const Session& session) {
  std::vector<std::string> lines;
  const std::filesystem::path fit = file.directory / "fit.json";
  if (file.stem == "case.fitted" && std::filesystem::exists(fit))
    lines.push_back(fitted_source(read_fit_json(fit), index));
  else
    lines.emplace_back("Source: values of the case file; its README or comments say where they are from");
  try {
    for (const ColumnRecord& record : read_column_record(session.results, hash))
      if (record.is_cohesive && record.name == name) lines.push_back(validity(record));
  } catch (const InputError&) {
    // No run of this case: nothing is known of how far its law acts.
  }
  if (lines.size() == 1) lines.emplace_back("Validity: no run of this case is there that says how far the law acts");
  return lines;
}

}  // namespace pfdm
