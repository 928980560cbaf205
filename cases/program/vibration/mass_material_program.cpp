#include "cases/program/vibration/mass_material_program.h"

#include "cases/program/session/report_parts.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "cases/program/session/whole_run.h"
#include "cases/program/vibration/mass_material_analysis.h"
#include "cases/program/vibration/mass_material_case.h"
#include "cases/program/vibration/mass_material_jobs.h"
#include "cases/program/vibration/mass_material_keys.h"
#include "cases/program/vibration/mass_material_report.h"
#include "postproc/curves/figures_summary.h"
#include "postproc/curves/summary.h"
#include "postproc/records/signal_table.h"
#include "solver/vibration/signals/signals_spectra.h"
#include "solver/vibration/simulation/mass_material_simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

namespace fs = std::filesystem;
using Eigen::VectorXd;

/// Of mass and k1, undamped [Hz].
double linear_resonance(const MassMaterialCase& c) {
  return std::sqrt(c.model.stiffness.front() / c.model.mass) / (2.0 * std::numbers::pi);
}

void say_model(const MassMaterialProgram& program, Log& log) {
  const MassMaterialCase& c = program.parsed;
  log.say(fmt::format("model {}: {}", c.structure, model_structure(c.structure).description));
  if (!c.has_parameters) return;
  log.say(fmt::format("resonance of mass and k1 at {:.4g} Hz", linear_resonance(c)));
  const auto z0 = static_settling_point(c.model, standard_gravity);
  if (z0)
    log.say(
        fmt::format("settles by {:.4g} mm under its weight; the parameters are those about that point", -1e3 * *z0));
  else
    log.warn("with the parameters taken about z = 0 the sample does not carry the mass's weight");
}

void say_passivity(const MassMaterialCase& c, const VibrationTest& test, Log& log) {
  const Passivity p = passivity(c.model, 2.0 * std::numbers::pi * test.band_low,
                                2.0 * std::numbers::pi * test.band_high, c.model.reference_velocity);
  if (!p.passive)
    log.warn(fmt::format(
        "test {}: the model is not passive: it supplies energy to the shaker (damping {:.3g} N s/m at {:.4g} Hz)",
        test.name, p.least_damping, p.worst_omega / (2.0 * std::numbers::pi)));
}

void check(const MassMaterialProgram& program, Session& session) {
  const MassMaterialCase& c = program.parsed;
  Log& log = session.log;
  log.say(fmt::format("{}: {}", program.name, c.title));
  say_model(program, log);
  if (c.has_parameters) require_parameters(c);
  for (const VibrationTest& test : c.tests) {
    if (test.excitation)
      log.say(fmt::format("test {:<16} {:g} s at {:g} samples/s, {:g} to {:g} Hz", test.name, test.excitation->duration,
                          c.rate, test.band_low, test.band_high));
    if (test.record) {
      const VibrationRecord record = read_record(test, *test.record, log);
      log.say(fmt::format("test {:<16} record of {:g} s at {:g} samples/s", test.name, record.duration(), record.rate));
    }
    if (c.has_parameters) say_passivity(c, test, log);
  }
  log.say(fmt::format("results go to {}", session.results.string()));
  log.say("the input is valid");
}

struct SimulatedTest {
  VibrationRecord record;
  Motion motion;
  double seconds = 0.0;
};

SimulatedTest simulate_test(const MassMaterialCase& c, std::size_t number) {
  const VibrationTest& test = c.tests[number];
  const Stopwatch watch;
  SimulatedTest result;
  result.motion = simulate(sample_of_test(c, number), *test.excitation, c.rate);
  if (!result.motion.bounded)
    throw ComputationError(fmt::format(
        "test {}: the motion is unbounded: the restoring force does not hold the mass at this level", test.name));
  result.seconds = watch.seconds();
  result.record.name = test.name;
  result.record.rate = c.rate;
  result.record.base = result.motion.base;
  result.record.relative = result.motion.acceleration;
  result.record.band_low = test.band_low;
  result.record.band_high = test.band_high;
  if (c.signal_to_noise) add_noise(result.record, *c.signal_to_noise, c.noise_seed + number);
  return result;
}

std::string remark_on(const MassMaterialProgram& program, const VibrationTest& test) {
  const MassMaterialCase& c = program.parsed;
  return fmt::format("synthetic: simulated, not measured; case {}, test {}, model {}{}", program.name, test.name,
                     c.structure, c.signal_to_noise ? fmt::format(", noise at -{:g} dB", *c.signal_to_noise) : "");
}

VectorXd sample_times(Eigen::Index n, double rate) {
  return VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)) / rate;
}

void write_record(const fs::path& path, const std::string& remark, const SimulatedTest& test) {
  write_signals_csv(path, {.remark = remark,
                           .columns = {{"time", "s", sample_times(test.record.n(), test.record.rate)},
                                       {"base_acceleration", "m/s^2", test.record.base},
                                       {"relative_acceleration", "m/s^2", test.record.relative}}});
}

/// Response at the driving frequency and its second and third multiple along a sweep, forty times a second.
void write_harmonics(const fs::path& path, const std::string& remark, const VibrationRecord& r,
                     const Excitation& excitation) {
  const TrackedResponse t = tracked_response(r, 3, tracker_bandwidth(r));
  const VectorXd frequency = t.time.unaryExpr([&](double at) { return excitation.frequency(at); });
  write_signals_csv(path, {.remark = remark,
                           .columns = {{"time", "s", t.time},
                                       {"driving_frequency", "Hz", frequency},
                                       {"base_amplitude", "m/s^2", t.base},
                                       {"first_harmonic", "m/s^2", t.harmonics.col(0)},
                                       {"second_harmonic", "m/s^2", t.harmonics.col(1)},
                                       {"third_harmonic", "m/s^2", t.harmonics.col(2)},
                                       {"envelope", "m/s^2", t.envelope}}});
}

/// Densities, H1 from base to relative acceleration with its bounds, coherence; segments of 8192, half overlapping.
void write_spectra(const fs::path& path, const std::string& remark, const VibrationRecord& r) {
  SegmentSettings segments;
  segments.length = std::min<Eigen::Index>(segments.length, r.n());
  const Spectra s = spectra(r.base, r.relative, r.rate, segments);
  const Eigen::VectorXcd H = frequency_response(s, ResponseEstimator::h1);
  const Bounds bounds = response_bounds(s);
  write_signals_csv(path, {.remark = remark,
                           .columns = {{"frequency", "Hz", s.frequency},
                                       {"base_density", "m^2/s^4/Hz", s.Sxx},
                                       {"relative_density", "m^2/s^4/Hz", s.Syy},
                                       {"H1_magnitude", "1", H.cwiseAbs()},
                                       {"H1_phase", "rad", H.cwiseArg()},
                                       {"H1_lower", "1", bounds.lower},
                                       {"H1_upper", "1", bounds.upper},
                                       {"coherence", "1", coherence(s)}}});
}

NamedFigures figures_of(const SimulatedTest& t) {
  const double duration = t.record.duration();
  return {t.record.name,
          {{"duration_s", duration},
           {"rms_base_acceleration_m_per_s2", t.record.base.norm() / std::sqrt(static_cast<double>(t.record.n()))},
           {"peak_base_acceleration_m_per_s2", t.record.base.lpNorm<Eigen::Infinity>()},
           {"peak_relative_acceleration_m_per_s2", t.record.relative.lpNorm<Eigen::Infinity>()},
           {"peak_relative_displacement_m", t.motion.displacement.lpNorm<Eigen::Infinity>()},
           {"peak_relative_velocity_m_per_s", t.motion.velocity.lpNorm<Eigen::Infinity>()},
           {"times_real_time", duration / std::max(t.seconds, 1e-9)}},
          {{"samples", t.record.n()}}};
}

/// What a run left there, of tests that the case no longer has as well.
std::vector<std::string> files_of_earlier(const fs::path& results) {
  std::vector<std::string> files;
  for (const std::string& test : tests_of_figures_summary(results / summary_file))
    for (const std::string_view ending : {std::string_view(), result_endings[0], result_endings[1]})
      files.push_back(fmt::format("{}{}.csv", test, ending));
  return files;
}

void run_tests(const MassMaterialProgram& program, Session& session, const fs::path& folder, FiguresSummary& summary) {
  const MassMaterialCase& c = program.parsed;
  for (std::size_t i = 0; i < c.tests.size(); ++i) {
    const VibrationTest& test = c.tests[i];
    if (!test.excitation) {
      session.log.say(fmt::format("test {} has a record and no excitation: nothing to simulate", test.name));
      continue;
    }
    const SimulatedTest simulated = simulate_test(c, i);
    const std::string says = remark_on(program, test);
    write_record(folder / (test.name + ".csv"), says, simulated);
    if (test.excitation->frequency)
      write_harmonics(folder / fmt::format("{}{}.csv", test.name, result_endings[0]), says, simulated.record,
                      *test.excitation);
    else
      write_spectra(folder / fmt::format("{}{}.csv", test.name, result_endings[1]), says, simulated.record);
    summary.tests.push_back(figures_of(simulated));
    session.log.step(fmt::format("test {:<16} {:g} s simulated in {:.2f} s, largest displacement {:.4g} mm", test.name,
                                 simulated.record.duration(), simulated.seconds,
                                 1e3 * simulated.motion.displacement.lpNorm<Eigen::Infinity>()));
  }
}

void run_case(const MassMaterialProgram& program, Session& session) {
  const MassMaterialCase& c = program.parsed;
  require_parameters(c);
  const auto compute = [&](const fs::path& folder, const Stopwatch& watch) -> std::string {
    say_model(program, session.log);
    FiguresSummary summary = complete_summary(program.name, program.hash, session);
    run_tests(program, session, folder, summary);
    const auto z0 = static_settling_point(c.model, standard_gravity);
    summary.figures = {{"mass_kg", c.model.mass},
                       {"linear_resonance_Hz", linear_resonance(c)},
                       {"static_stiffness_N_per_m", static_stiffness(c.model)},
                       {"static_settling_point_m", z0 ? *z0 : std::nan("")}};
    summary.wall_seconds = watch.seconds();
    write_figures_summary(folder / summary_file, summary);
    return summary.status;
  };
  run_whole({.file = program.file,
             .name = program.name,
             .title = c.title,
             .hash = program.hash,
             .compute = compute,
             .results = files_of_earlier(session.results),
             .remove_more = [&] { remove_analysis(session.results); }},
            session);
}

/// What the run of this case did, in sentences; none without one, as where only records of tests were analysed since
/// the case was changed.
std::vector<std::string> headline_of(const MassMaterialProgram& program, const fs::path& results) {
  const fs::path file = results / summary_file;
  const auto summary = fs::exists(file) ? read_summary(file) : std::nullopt;
  if (!summary || summary->case_hash != program.hash) return {};
  std::vector<std::string> sentences{fmt::format("Mass and sample resonate at {}, where they are linear.",
                                                 shown(summary->number("linear_resonance_Hz"), "Hz"))};
  constexpr std::size_t most = 4;
  const std::vector<NamedFigures> tests = read_test_figures(file);
  for (std::size_t i = 0; i < std::min(tests.size(), most); ++i) {
    const auto figure = [&](const char* name) { return tests[i].figures.at(name); };
    sentences.push_back(fmt::format("{}: the base shakes with up to {:.4g} g0, the mass moves up to {} against it.",
                                    tests[i].name, figure("peak_base_acceleration_m_per_s2") / standard_gravity,
                                    shown(figure("peak_relative_displacement_m"), "m")));
  }
  if (tests.size() > most) sentences.push_back(fmt::format("{} more tests.", tests.size() - most));
  return sentences;
}

CasePage page_of(const MassMaterialProgram& program, const Session& session) {
  return {.report = mass_material_page(program, session),
          .extras = {.hash = program.hash, .headline = headline_of(program, session.results)}};
}

RunnableCase read_program(const CaseFile& file) {
  auto program =
      std::make_shared<MassMaterialProgram>(MassMaterialProgram{.file = file, .parsed = {}, .name = {}, .hash = {}});
  program->parsed = read_mass_material_case(file.config.root(), file.directory);
  program->name = case_name(file);
  constexpr std::string_view not_of_the_run[] = {"analysis"};
  program->hash = case_hash(file, program->parsed.data_files, not_of_the_run);
  return {.title = program->parsed.title,
          .check = [program](Session& session) { check(*program, session); },
          .run = [program](Session& session) { run_case(*program, session); },
          .fit = [program](Session& session) { fit_mass_material(*program, session); },
          .analyse = [program](Session& session) { analyse_mass_material(*program, session); },
          .report =
              [program](Session& session) {
                write_report(page_of(*program, session), session);
                write_test_pages(*program, session);
              },
          .page = [program](const Session& session) { return page_of(*program, session); },
          .data_files = program->parsed.data_files};
}

std::vector<LawTable> laws() {
  return {law_table("mass-material models ([model] structure)", model_structures()),
          law_table("excitations ([[test]] excitation.type)", excitation_types()),
          law_table("identification ([fit] method)", fit_methods())};
}

}  // namespace

CaseKind mass_material_kind() {
  return {.name = "mass_material",
          .description = "mass on a sample on a shaker: simulation and identification",
          .read = read_program,
          .laws = laws,
          .keys = [] { return std::vector<const KeyTable*>{&mass_material_keys()}; }};
}

}  // namespace pfdm
