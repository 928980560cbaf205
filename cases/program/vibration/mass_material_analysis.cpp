#include "cases/program/vibration/mass_material_analysis.h"

#include "postproc/files/atomic_file.h"
#include "postproc/files/folder_lock.h"
#include "postproc/records/signal_table.h"
#include "solver/vibration/identification/identification_responses.h"
#include "solver/vibration/signals/signals_filter.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

namespace pfdm {
namespace {

namespace fs = std::filesystem;
using Eigen::VectorXd;

/// What the columns come from, for the head of each file.
std::string head_of(const VibrationRecord& r, const std::string& what) {
  return fmt::format("{} of the record {}{}{}", what, r.name, r.remark.empty() ? "" : "; its file says: ", r.remark);
}

void write_spectra(const fs::path& path, const VibrationRecord& r, const RecordAnalysis& a) {
  const Spectra& s = a.spectra;
  SignalTable table{.remark = head_of(r, "spectral densities and frequency responses, bounds 95 %,"), .columns = {}};
  const auto add = [&table](std::string name, std::string unit, VectorXd values) {
    table.columns.push_back({std::move(name), std::move(unit), std::move(values)});
  };
  add("frequency", "Hz", s.frequency);
  add("base_density", "m^2/s^4/Hz", s.Sxx);
  add("relative_density", "m^2/s^4/Hz", s.Syy);
  add("base_density_g0", "g0^2/Hz", s.Sxx / g0_squared);
  add("relative_density_g0", "g0^2/Hz", s.Syy / g0_squared);
  add("H1_magnitude", "1", a.H1.cwiseAbs());
  add("H1_lower", "1", a.H1_bounds.lower);
  add("H1_upper", "1", a.H1_bounds.upper);
  add("H2_magnitude", "1", a.H2.cwiseAbs());
  add("Hv_magnitude", "1", a.Hv.cwiseAbs());
  add("phase", "rad", a.H1.cwiseArg());  // that of H2 and Hv as well
  add("phase_deviation", "rad", a.phase_deviation);
  add("coherence", "1", a.coherence);
  add("coherence_lower", "1", a.coherence_bounds.lower);
  add("coherence_upper", "1", a.coherence_bounds.upper);
  write_signals_csv(path, table);
}

double highest_shown(const VibrationRecord& r, int harmonics, bool swept) {
  return std::min(0.5 * r.rate, swept ? (harmonics + 0.5) * r.band_high : 1.25 * r.band_high);
}

/// A row for each time, a column for each frequency.
void write_spectrogram(const fs::path& path, const VibrationRecord& r, const Spectrogram& s, double highest) {
  SignalTable table{.remark = head_of(r, "density of the relative acceleration over time; columns: frequencies in Hz;"),
                    .columns = {{"time", "s", s.time}}};
  for (Eigen::Index k = 0; k < s.frequency.size() && s.frequency[k] <= highest; ++k)
    table.columns.push_back({fmt::format("{:.10g}", s.frequency[k]), "m^2/s^4/Hz", s.density.row(k)});
  write_signals_csv(path, table);
}

void write_harmonics(const fs::path& path, const VibrationRecord& r, const TrackedResponse& t) {
  SignalTable table{
      .remark =
          head_of(r, fmt::format("amplitudes that move with the driving frequency, within {:g} Hz,", t.bandwidth)),
      .columns = {
          {"time", "s", t.time}, {"driving_frequency", "Hz", t.frequency}, {"base_amplitude", "m/s^2", t.base}}};
  for (Eigen::Index h = 0; h < t.harmonics.cols(); ++h)
    table.columns.push_back({fmt::format("harmonic_{}", h + 1), "m/s^2", t.harmonics.col(h)});
  write_signals_csv(path, table);
}

/// Of the recorded relative acceleration and of each model's, with the base's as recorded.
std::vector<ModelMisfit> write_envelopes(const fs::path& path, const VibrationRecord& r, const TrackedResponse& t,
                                         std::span<const NamedModel> models, double crop) {
  SignalTable table{
      .remark = head_of(r, "envelopes of the relative acceleration, recorded and of models,"),
      .columns = {{"time", "s", t.time}, {"driving_frequency", "Hz", t.frequency}, {"recorded", "m/s^2", t.envelope}}};
  std::vector<ModelMisfit> misfits;
  for (const NamedModel& model : models) {
    misfits.push_back({model.name, prediction_misfit(model.parameters, r, crop)});
    const VectorXd response = predicted_response(model.parameters, r);
    const VectorXd hull = response.allFinite() ? envelope(response) : response;
    table.columns.push_back(
        {model.name, "m/s^2", hull(Eigen::seqN(Eigen::Index{0}, t.time.size(), tracker_stride(r.rate)))});
  }
  write_signals_csv(path, table);
  return misfits;
}

AnalysedRecord summary_of(const VibrationTest& test, const VibrationRecord& r, const RecordAnalysis& a) {
  AnalysedRecord s{.name = r.name,
                   .file = test.record ? test.record->file.string() : r.name + ".csv",
                   .date = test.date,
                   .remark = r.remark,
                   .motion = a.tracked ? "sine" : "random",
                   .rate = r.rate,
                   .duration = r.duration(),
                   .samples = r.n(),
                   .band_low = r.band_low,
                   .band_high = r.band_high,
                   .level = a.level,
                   .sine_amplitude = {},
                   .resonance = {},
                   .segment = a.segments.length,
                   .overlap = a.segments.overlap,
                   .segments = a.spectra.segments,
                   .averages = a.spectra.averages,
                   .resolution = r.rate / static_cast<double>(a.segments.length),
                   .misfits = {}};
  if (a.tracked) s.sine_amplitude = a.tracked->median_base();
  s.resonance = largest_response(r, a);
  return s;
}

void say_record(const AnalysedRecord& s, Log& log) {
  log.say(
      fmt::format("{}: {:.10g} s at {:g} samples/s, {} to {} Hz; base {:.4g} g0 rms, mean density {:.4g} g0^2/Hz{}",
                  s.name, s.duration, s.rate, s.band_low, s.band_high, s.level.rms_base / standard_gravity,
                  s.level.base_density / g0_squared,
                  s.sine_amplitude ? fmt::format(", sine of {:.4g} g0", *s.sine_amplitude / standard_gravity) : ""));
  log.say(fmt::format("  Hann window, {} segments of {} with {:g} % overlap ({:.4g} independent), resolution {:.4g} Hz",
                      s.segments, s.segment, 100.0 * s.overlap, s.averages, s.resolution));
  log.say(fmt::format("  largest response {:.4g} times the base at {:.5g} Hz", s.resonance.response,
                      s.resonance.frequency));
  for (const ModelMisfit& m : s.misfits) log.say(fmt::format("  {}: misfit {:.3g} %", m.name, 100.0 * m.relative));
}

std::string now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

}  // namespace

LargestResponse largest_response(const VibrationRecord& record, const RecordAnalysis& a) {
  if (a.tracked) {
    const Eigen::Index at = a.tracked->at_resonance();
    return {a.tracked->frequency[at], a.tracked->harmonics(at, 0) / a.tracked->base[at]};
  }
  LargestResponse largest;
  for (Eigen::Index i = 0; i < a.spectra.frequency.size(); ++i)
    if (const double f = a.spectra.frequency[i], H = std::abs(a.H1[i]);
        f >= record.band_low && f <= record.band_high && a.coherence[i] > 0.5 && H > largest.response)
      largest = {f, H};
  return largest;
}

void remove_analysis(const fs::path& results) {
  const fs::path folder = results / analysis_folder;
  std::error_code ignored;
  if (!fs::exists(folder / analysis_file)) return;
  std::vector<fs::path> own{folder / analysis_file};
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".csv") own.push_back(entry.path());
  for (const fs::path& file : own) fs::remove(file, ignored);
  fs::remove(folder, ignored);  // unless there is something else in it
}

std::vector<NamedModel> models_at_hand(const MassMaterialCase& c, const fs::path& results) {
  std::vector<NamedModel> models;
  if (c.has_parameters) models.push_back({"model_of_the_case", c.model});
  std::vector<fs::path> fitted;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(results, none)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("case.fitted") && name.ends_with(".toml")) fitted.push_back(entry.path());
  }
  std::ranges::sort(fitted);
  for (const fs::path& path : fitted) {
    const CaseFile file = open_case(path);
    std::string name = path.stem().string().substr(std::string("case.").size());
    std::ranges::replace(name, '.', '_');
    models.push_back({std::move(name), read_mass_material_case(file.config.root(), file.directory).model});
  }
  return models;
}

void analyse_mass_material(const MassMaterialProgram& program, Session& session) {
  const MassMaterialCase& c = program.parsed;
  AnalysisReport report{.case_name = program.name,
                        .case_hash = program.hash,
                        .version = session.version,
                        .analysed = now(),
                        .records = {}};
  std::vector<VibrationRecord> records;
  records.reserve(c.tests.size());
  for (const VibrationTest& test : c.tests) records.push_back(record_of(test, session.results, session.log));
  const std::vector<NamedModel> models = models_at_hand(c, session.results);
  std::vector<RecordAnalysis> analyses;
  for (const VibrationRecord& r : records) analyses.push_back(analysed(r, c.analysis));
  const FolderLock lock(session.results);
  const fs::path folder = session.results / analysis_folder;
  remove_analysis(session.results);  // only now that there is something in its place
  make_folder(folder);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const VibrationRecord& r = records[i];
    const auto file = [&](const char* what) { return folder / fmt::format("{}_{}.csv", r.name, what); };
    const RecordAnalysis& a = analyses[i];
    AnalysedRecord summary = summary_of(c.tests[i], r, a);
    write_spectra(file("spectra"), r, a);
    write_spectrogram(file("spectrogram"), r, a.spectrogram,
                      highest_shown(r, c.analysis.harmonics, a.tracked.has_value()));
    if (a.tracked) {
      write_harmonics(file("harmonics"), r, *a.tracked);
      summary.misfits = write_envelopes(file("envelopes"), r, *a.tracked, models, c.fit.crop);
    }
    say_record(summary, session.log);
    report.records.push_back(std::move(summary));
  }
  write_analysis_json(folder / analysis_file, report);
  session.log.say(fmt::format("written to {}", folder.string()));
}

}  // namespace pfdm
