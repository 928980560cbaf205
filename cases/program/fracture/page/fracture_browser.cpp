#include "cases/program/fracture/page/fracture_browser.h"

#include "cases/program/fracture/outcome/end_of_run.h"
#include "cases/program/fracture/outcome/fracture_files.h"
#include "cases/program/fracture/outcome/mean_curve.h"
#include "cases/program/fracture/page/debonding_charts.h"
#include "cases/program/studies/sweep/sweep_changes.h"
#include "postproc/browser/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// Of a box its mean strain and stress.
std::vector<std::string> words_of_steps(const FractureCase& fracture, const CurveUnits& units,
                                        const std::vector<CurveRow>& curve, const fs::path& results) {
  MeanCurve mean;
  if (fracture.box) mean = read_mean_curve(results, fracture.interfaces, fracture.box->component);
  std::vector<std::string> words;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const CurveRow& row = curve[i];
    std::string text = fmt::format("Step {} of {}", row.step, curve.back().step);
    if (!fracture.box)
      text += fmt::format(": displacement {}, force {}", shown_in(units.displacement, row.displacement),
                          shown_in(units.force, row.force[fracture.output.curve.component]));
    else if (mean.strain.size() == curve.size())
      text += fmt::format(": strain {} {}, stress {}", name_of_component(fracture.box->component),
                          shown(mean.strain[i]), shown(mean.stress[i], "Pa"));
    words.push_back(in_print(std::move(text)));
  }
  return words;
}

/// From 0 on, by what of the whole load and of the whole energy of cracks has come.
std::vector<double> progress_of(const std::vector<CurveRow>& rows) {
  const auto spent = [](const CurveRow& row) { return row.energy.fracture + row.energy.interface_dissipation; };
  double most_moved = 0.0, most_spent = 0.0;
  for (const CurveRow& row : rows) {
    most_moved = std::max(most_moved, std::abs(row.load - rows.front().load));
    most_spent = std::max(most_spent, spent(row) - spent(rows.front()));
  }
  std::vector<double> progress;
  double way = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0) {
      if (most_moved > 0.0) way += std::abs(rows[i].load - rows[i - 1].load) / most_moved;
      if (most_spent > 0.0) way += std::abs(spent(rows[i]) - spent(rows[i - 1])) / most_spent;
    }
    progress.push_back(way);
  }
  return progress;
}

int direction_of_load(const FractureCase& fracture) {
  return fracture.box ? fracture.box->component[0] : fracture.output.curve.component;
}

/// None without frames, or where they do not say how points have moved.
std::optional<Body> body_of(const FractureCase& fracture, const std::vector<CurveRow>& curve, const fs::path& results) {
  if (!fs::exists(results / "mesh.vtu")) return std::nullopt;
  BodySettings settings{.frames = {}, .mesh = results / "mesh.vtu"};
  std::vector<CurveRow> rows;
  for (const StoredStep& stored : stored_steps(results)) {
    const auto row = std::ranges::find(curve, stored.step, &CurveRow::step);
    if (row == curve.end()) continue;
    settings.frames.push_back({.step = static_cast<Index>(row - curve.begin()), .file = stored.file});
    rows.push_back(*row);
  }
  if (settings.frames.empty()) return std::nullopt;
  settings.progress = progress_of(rows);
  settings.cut_at = fracture.output.slices_through;
  settings.component = direction_of_load(fracture);
  return read_body(settings);
}

}  // namespace

BrowserExtras fracture_extras(const FractureCase& fracture, const std::optional<ExperimentSettings>& experiment,
                              const CaseFile& file, const std::string& hash, const fs::path& results) {
  BrowserExtras extras{.hash = hash};
  if (!has_results(results)) return extras;
  const CurveUnits units = read_curve_units(file, fracture.output.curve);
  const std::vector<CurveRow> curve = read_curve_record(results, hash);
  if (auto summary = find_summary(results)) {
    summary->figures = headlines(curve, fracture.output.curve.component);
    for (std::string& sentence : as_sentences(what_happened(fracture, file, *summary, results)))
      extras.headline.push_back(in_print(std::move(sentence)));
    extras.headline.push_back(in_print(words_of_error(results, summary->figures->peak_force)));
    extras.figures = run_figures(fracture, units, *summary, results);
  }
  extras.steps = words_of_steps(fracture, units, curve, results);
  if (!fracture.box) extras.more = debonding_charts(fracture, experiment, curve, find_column_record(results));
  extras.body = body_of(fracture, curve, results);
  extras.beside = {std::string(fracture.box ? "Mean stress against mean strain" : "Force against displacement"),
                   "Figures"};
  return extras;
}

}  // namespace pfdm
