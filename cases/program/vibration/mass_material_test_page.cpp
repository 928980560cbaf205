// write_test_pages() of mass_material_analysis.h: a test report of each record, as figures A1, 16 and 17 of the report
// AFRL-RW-EG-TR-2016-088 have them.

#include "cases/program/session/report_parts.h"
#include "cases/program/vibration/mass_material_analysis.h"
#include "cases/program/vibration/vibration_charts.h"
#include "postproc/vibration/analysis_json.h"
#include "solver/vibration/identification/identification_responses.h"
#include "solver/vibration/signals/signals_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

namespace fs = std::filesystem;
using Eigen::VectorXd;

struct TestStory {
  const MassMaterialProgram& program;
  const VibrationTest& test;
  const VibrationRecord& record;
  const RecordAnalysis& analysis;
  std::span<const NamedModel> models;
  const AnalysisStamp& stamp;
};

std::string schedule_text(const ScheduledRun& run) {
  const std::string level =
      run.density > 0.0 ? shown(run.density / g0_squared) + " g0²/Hz" : shown(run.level / standard_gravity) + " g0";
  return fmt::format("day {}, run {}, {}{}", run.day(), run.run, level, run.fractured ? ", sample fractured" : "");
}

Table test_table(const TestStory& s) {
  const VibrationRecord& r = s.record;
  const MassMaterialCase& c = s.program.parsed;
  Table table{.caption = "Test", .rows = {{"record", r.name}, {"date of the test", s.test.date.value_or("-")}}};
  if (s.test.schedule) table.rows.push_back({"schedule", schedule_text(*s.test.schedule)});
  table.rows.push_back({"mass", shown(c.model.mass) + " kg"});
  if (c.sample)
    table.rows.push_back(
        {"sample length, area", fmt::format("{}, {}", shown(c.sample->length, "m"), shown(c.sample->area, "m^2"))});
  table.rows.push_back({"excitation", fmt::format("{}, {} to {} Hz", s.analysis.tracked ? "sine" : "random",
                                                  shown(r.band_low), shown(r.band_high))});
  table.rows.push_back({"sampling", fmt::format("{} at {} samples/s", shown(r.duration(), "s"), shown(r.rate))});
  return table;
}

Table level_table(const TestStory& s) {
  const TestLevel& level = s.analysis.level;
  Table table{.caption = "Level", .rows = {}};
  const auto add = [&](std::string what, double acceleration, const char* unit) {
    table.rows.push_back({std::move(what), fmt::format("{} {}", shown(acceleration), unit)});
  };
  add("base: mean density in the band", level.base_density / g0_squared, "g0²/Hz");
  if (s.analysis.tracked)
    add("base: amplitude of the sine", s.analysis.tracked->median_base() / standard_gravity, "g0");
  add("base: rms", level.rms_base / standard_gravity, "g0");
  add("base: peak", level.peak_base / standard_gravity, "g0");
  add("relative: rms", level.rms_relative / standard_gravity, "g0");
  add("relative: peak", level.peak_relative / standard_gravity, "g0");
  return table;
}

Table estimation_table(const TestStory& s) {
  const RecordAnalysis& a = s.analysis;
  return {.caption = "Spectral estimates",
          .rows = {{"window", "Hann"},
                   {"segments", fmt::format("{} of {} samples", a.spectra.segments, a.segments.length)},
                   {"overlap", fmt::format("{:g} %", 100.0 * a.segments.overlap)},
                   {"independent averages", shown(a.spectra.averages)},
                   {"resolution", shown(s.record.rate / static_cast<double>(a.segments.length)) + " Hz"},
                   {"analysed", s.stamp.analysed}}};
}

Chart magnitude_chart(const TestStory& s, const BandSpectra& b) {
  return {.caption = fmt::format("Base to relative acceleration, where coherence > {:g}", least_coherence),
          .x = frequency_axis(s.record),
          .y = {.title = "magnitude [-]", .logarithmic = true},
          .series = {{.label = "95 % of H1",
                      .x = b.frequency,
                      .y = b.lower,
                      .style = SeriesStyle::band,
                      .colour = 7,
                      .upper = b.upper},
                     {.label = "H2", .x = b.frequency, .y = b.magnitude_h2, .colour = 2},
                     {.label = "Hv", .x = b.frequency, .y = b.magnitude_hv, .colour = 1},
                     {.label = "H1", .x = b.frequency, .y = b.magnitude}}};
}

Chart phase_chart(const TestStory& s, const BandSpectra& b) {
  return {.caption = "Phase",
          .x = frequency_axis(s.record),
          .y = {.title = "phase [degrees]"},
          .series = {{.label = {}, .x = b.frequency, .y = b.phase}}};
}

/// "model_of_the_case" as "model of the case".
std::string readable(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// Over the driving frequency, between its ends or about the largest response.
Chart envelope_chart(const TestStory& s, bool near_resonance) {
  const TrackedResponse& t = *s.analysis.tracked;
  const double resonance = t.frequency[t.at_resonance()];
  const auto least = near_resonance ? std::optional(std::max(0.8 * resonance, s.record.band_low)) : std::nullopt;
  const auto most = near_resonance ? std::optional(std::min(1.2 * resonance, s.record.band_high)) : std::nullopt;
  Chart chart{.caption = near_resonance ? "Envelopes about the largest response" : "Envelopes, recorded and of models",
              .x = {.title = "driving frequency [Hz]", .from = least, .to = most},
              .y = {.title = "relative acceleration [g0]"},
              .series = {}};
  const double ramp = 0.5 * t.median_base();
  const auto add = [&](std::string label, const VectorXd& hull, int colour) {
    Series series{.label = std::move(label), .x = {}, .y = {}, .colour = colour};
    for (Eigen::Index i = 0; i < t.time.size(); ++i) {
      if (t.base[i] < ramp || t.frequency[i] < least.value_or(0.0) || t.frequency[i] > most.value_or(1e300)) continue;
      series.x.push_back(t.frequency[i]);
      series.y.push_back(hull[i] / standard_gravity);
    }
    chart.series.push_back(std::move(series));
  };
  add("recorded", t.envelope, 0);
  int colour = 1;
  for (const NamedModel& model : s.models) {
    const VectorXd response = predicted_response(model.parameters, s.record);
    if (!response.allFinite()) continue;
    add(readable(model.name),
        envelope(response)(Eigen::seqN(Eigen::Index{0}, t.time.size(), tracker_stride(s.record.rate))), colour++);
  }
  return chart;
}

ReportPage test_page(const TestStory& s, const std::string& version) {
  const VibrationRecord& r = s.record;
  BandSpectra b = in_band(s.analysis.spectra, r);
  blank_incoherent(b, b.coherence);
  ReportPage page{
      .title = fmt::format("{}, test {}", s.program.name, r.name),
      .subtitle = fmt::format("pfdm {}, case {}{}{}", version, s.program.hash, r.remark.empty() ? "" : ", record ",
                              r.remark.substr(0, r.remark.find_first_of(";\n"))),
      .rows = {}};
  page.rows.push_back({.blocks = {test_table(s), level_table(s), estimation_table(s)}, .widths = {1.1, 1.1, 1.0}});
  page.rows.push_back({.blocks = {base_chart(r), response_chart(r)}});
  page.rows.push_back({.blocks = {density_chart(r, b), coherence_chart(r, b)}});
  page.rows.push_back({.blocks = {magnitude_chart(s, b), phase_chart(s, b)}});
  const auto& tracked = s.analysis.tracked;
  const double highest = std::min(0.5 * r.rate, tracked ? 3.5 * r.band_high : 1.25 * r.band_high);
  page.rows.push_back({.blocks = {spectrogram_picture(s.analysis.spectrogram, highest)}, .height = 1.2});
  if (!tracked) return page;
  page.rows.back().blocks.emplace_back(harmonics_chart(*tracked));
  page.rows.push_back({.blocks = {envelope_chart(s, false), envelope_chart(s, true)}, .height = 1.2});
  return page;
}

}  // namespace

void write_test_pages(const MassMaterialProgram& program, Session& session) {
  const MassMaterialCase& c = program.parsed;
  const auto stamp = find_of_case(session.results / analysis_folder / analysis_file, program.hash, read_analysis_stamp);
  if (!stamp) return;
  const std::vector<NamedModel> models = models_at_hand(c, session.results);
  for (const VibrationTest& test : c.tests) {
    const VibrationRecord record = record_of(test, session.results, session.log);
    const RecordAnalysis analysis = analysed(record, c.analysis);
    const TestStory story{program, test, record, analysis, models, *stamp};
    const fs::path folder = session.results / "report" / test.name;
    const LargestResponse largest = largest_response(record, analysis);
    write_pages(folder, test_page(story, session.version), session,
                {.headline = {fmt::format("Largest response {:.4g} times the base at {:.4g} Hz.", largest.response,
                                          largest.frequency)}});
  }
}

}  // namespace pfdm
