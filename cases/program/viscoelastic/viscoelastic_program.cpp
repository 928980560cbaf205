#include "cases/program/viscoelastic/viscoelastic_program.h"

#include "cases/program/input/laws/prony_reader.h"
#include "cases/program/input/laws/temperature_shift_reader.h"
#include "cases/program/session/fit_verdict.h"
#include "cases/program/session/report_parts.h"
#include "cases/program/session/whole_run.h"
#include "cases/program/viscoelastic/viscoelastic_case.h"
#include "cases/program/viscoelastic/viscoelastic_fit_results.h"
#include "cases/program/viscoelastic/viscoelastic_keys.h"
#include "cases/program/viscoelastic/viscoelastic_report.h"
#include "physics/quantity_text.h"
#include "postproc/curves/summary.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/folder_lock.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

struct ViscoelasticProgram {
  CaseFile file;
  ViscoelasticCase tested;
  std::string name;
  std::string hash;
};

void say_series(const PronyLaw& law, Log& log) {
  const RelaxationModulus E = young_modulus(law), mu = shear_modulus(law);
  log.say(fmt::format("  Young's modulus {}, shear modulus {}: relaxed and at once",
                      quantities_text({E.relaxed, E.instantaneous()}, "Pa", " and "),
                      quantities_text({mu.relaxed, mu.instantaneous()}, "Pa", " and ")));
  for (const auto& [what, branches] : {std::pair("shear", &law.shear), std::pair("bulk", &law.bulk)})
    for (const PronyBranch& branch : *branches)
      log.say(fmt::format("  {} branch {}, {}", what, quantity_text(branch.modulus, "Pa"),
                          quantity_text(branch.time, "s")));
  if (law.shift) log.say("  temperature shift: " + words_of(*law.shift));
}

void say_tests(const ViscoelasticFitCase& fit, const PronyLaw& law, Log& log) {
  const ViscoelasticSettings& settings = fit.settings;
  log.say(fmt::format("fit to {} tests of {} values; relaxation times of {} can be seen", fit.experiments.size(),
                      n_measured(fit.experiments), text_of(time_window(at_reference(fit.experiments, law.shift)))));
  log.say(settings.least_branches > 0
              ? fmt::format("  {} to {} shear branches are tried", settings.least_branches, settings.most_branches)
              : fmt::format("  {} shear branches, beginning with those of [material]", law.shear.size()));
}

void check(const ViscoelasticProgram& program, Session& session) {
  const ViscoelasticCase& c = program.tested;
  session.log.say(fmt::format("{}: {}", program.name, c.title));
  say_series(c.law, session.log);
  if (c.loading)
    session.log.say(fmt::format("{} in {} over {}, {} rows", c.loading->is_stress ? "a stress" : "a strain",
                                name_of(c.loading->deformation), quantity_text(c.loading->times.back(), "s"),
                                c.loading->times.size()));
  if (c.sweep)
    session.log.say(fmt::format("complex moduli at {} frequencies, {:g} to {:g} Hz", frequencies_of(*c.sweep).size(),
                                c.sweep->from, c.sweep->to));
  if (c.fit) say_tests(*c.fit, c.law, session.log);
  session.log.say(fmt::format("results go to {}", session.results.string()));
  session.log.say("the input is valid");
}

CsvTable history_of(const BulkLoading& loading, const PronyLaw& law) {
  const RelaxationModulus modulus = modulus_in(law, loading.deformation);
  const std::vector<double> answer = loading.is_stress
                                         ? strain_response(creep_compliance(modulus), loading.times, loading.values)
                                         : stress_response(modulus, loading.times, loading.values);
  CsvTable table;
  table.comments.emplace_back(loading.deformation == Deformation::shear
                                  ? "shear: engineering shear strain and shear stress"
                                  : "tension: uniaxial stress and its strain");
  table.add("time_s", loading.times);
  table.add("strain", loading.is_stress ? answer : loading.values);
  table.add("stress_Pa", loading.is_stress ? loading.values : answer);
  return table;
}

CsvTable moduli_of(const FrequencyRange& range, const PronyLaw& law) {
  CsvTable table;
  const std::vector<double> frequencies = frequencies_of(range);
  std::vector<double> angular = frequencies;
  for (double& w : angular) w *= 2.0 * std::numbers::pi;
  table.add("frequency_Hz", frequencies);
  table.add("angular_frequency_rad_per_s", angular);
  for (const auto& [what, modulus] : {std::pair("shear", shear_modulus(law)), std::pair("young", young_modulus(law))}) {
    std::vector<double> storage, loss, factor;
    for (const double w : angular) {
      const std::complex<double> M = complex_modulus(modulus, w);
      storage.push_back(M.real()), loss.push_back(M.imag()), factor.push_back(M.imag() / M.real());
    }
    table.add(fmt::format("{}_storage_modulus_Pa", what), storage);
    table.add(fmt::format("{}_loss_modulus_Pa", what), loss);
    table.add(fmt::format("{}_loss_factor", what), factor);
  }
  return table;
}

std::map<std::string, double> figures_of(const PronyLaw& law, const CsvTable* history, const CsvTable* moduli) {
  const RelaxationModulus E = young_modulus(law), mu = shear_modulus(law);
  std::map<std::string, double> figures{{"relaxed_young_modulus_Pa", E.relaxed},
                                        {"instantaneous_young_modulus_Pa", E.instantaneous()},
                                        {"relaxed_shear_modulus_Pa", mu.relaxed},
                                        {"instantaneous_shear_modulus_Pa", mu.instantaneous()}};
  if (history != nullptr) {
    const std::vector<double>& stress = history->column("stress_Pa");
    figures["largest_stress_Pa"] = std::ranges::max(stress, {}, [](double s) { return std::abs(s); });
    figures["final_stress_Pa"] = stress.back();
    figures["final_strain"] = history->column("strain").back();
    figures["final_time_s"] = history->column("time_s").back();
  }
  if (moduli != nullptr) {
    const std::vector<double>& factor = moduli->column("shear_loss_factor");
    const auto at = std::ranges::max_element(factor);
    figures["largest_shear_loss_factor"] = *at;
    figures["largest_shear_loss_factor_at_Hz"] = moduli->column("frequency_Hz")[at - factor.begin()];
  }
  return figures;
}

void run_case(const ViscoelasticProgram& program, Session& session) {
  const ViscoelasticCase& c = program.tested;
  const auto compute = [&](const std::filesystem::path& folder, const Stopwatch& watch) -> std::string {
    say_series(c.law, session.log);
    std::optional<CsvTable> history, moduli;
    if (c.loading) write_csv(folder / "history.csv", history.emplace(history_of(*c.loading, c.law)));
    if (c.sweep) write_csv(folder / "complex_modulus.csv", moduli.emplace(moduli_of(*c.sweep, c.law)));
    RunSummary summary = complete_run(program.name, program.hash, session, watch.seconds());
    summary.steps = history ? static_cast<Index>(history->n_rows() - 1) : 0;
    summary.other_figures = figures_of(c.law, history ? &*history : nullptr, moduli ? &*moduli : nullptr);
    write_summary(folder / summary_file, summary);
    if (history)
      session.log.say(fmt::format("  largest stress {}; at the end {} at a strain of {:.4g}",
                                  quantity_text(summary.other_figures["largest_stress_Pa"], "Pa"),
                                  quantity_text(summary.other_figures["final_stress_Pa"], "Pa"),
                                  summary.other_figures["final_strain"]));
    return "complete";
  };
  run_whole({.file = program.file,
             .name = program.name,
             .title = c.title,
             .hash = program.hash,
             .compute = compute,
             .results = {"history.csv", "complex_modulus.csv"}},
            session);
}

void say_material(const PronyLaw& law, Log& log) {
  log.say("as a material of a fracture case, to be pasted below [materials.NAME] (all digits: case.fitted.toml):");
  log.say_lines("law = \"prony\"\n" + to_toml(law, 6), "  ");
}

void fit_case(const ViscoelasticProgram& program, Session& session) {
  const Stopwatch watch;
  Log& log = session.log;
  ViscoelasticFitCase fit = *program.tested.fit;
  log.say(fmt::format("pfdm {}, fit of {}: {}", session.version, program.name, program.tested.title));
  const FolderLock lock(session.results);
  say_tests(fit, program.tested.law, log);
  fit.settings.say = [&log](const std::string& message) { log.say(message); };
  const ViscoelasticIdentification found = identify(program.tested.law, fit.experiments, fit.settings);
  const double seconds = watch.seconds();
  log.open_file(session.results / "fit.log", false);  // not before: it belongs to the estimates that are there
  const FitFindings findings = write_fit_results(session.results, program.file, fit, found,
                                                 {program.name, program.hash, session.version, seconds});
  for (const FittedParameter& p : findings.parameters) log.say(fmt::format("  {:<14} {}", p.name, estimate_text(p)));
  log.say(fmt::format("largest misfit {:.3g} % of what was measured; {:.1f} s; {}",
                      100.0 * relative_misfit(found.fit.law, fit.experiments), seconds,
                      end_of_search(found.fit.result.message)));
  say_fitted_case(session);
  say_material(found.fit.law, log);
  say_verdict(findings, session);
}

RunnableCase read_program(const CaseFile& file) {
  auto program =
      std::make_shared<ViscoelasticProgram>(ViscoelasticProgram{.file = file, .tested = {}, .name = {}, .hash = {}});
  program->tested = read_viscoelastic_case(file.config.root(), file.directory);
  program->name = case_name(file);
  std::vector<std::filesystem::path> of_run;
  if (program->tested.loading) of_run = program->tested.loading->data_files;
  std::vector<std::filesystem::path> data = of_run;
  if (program->tested.fit)
    data.insert(data.end(), program->tested.fit->data_files.begin(), program->tested.fit->data_files.end());
  program->hash = case_hash(file, data);
  RunnableCase runnable{
      .title = program->tested.title,
      .check = [program](Session& session) { check(*program, session); },
      .run = [program](Session& session) { run_case(*program, session); },
      .page =
          [program](const Session& session) {
            return CasePage{
                .report = viscoelastic_page(program->tested, program->name, program->hash, session.results),
                .extras = {.hash = program->hash, .headline = viscoelastic_headline(program->hash, session.results)}};
          },
      .data_files = of_run};
  runnable.fit = [program](Session& session) { fit_case(*program, session); };
  if (!program->tested.fit)
    runnable.fit =
        job_without_table(file, "fit", "[[fit.experiments]] with tests on the bulk material", "prony_calibration");
  return runnable;
}

}  // namespace

CaseKind viscoelastic_kind() {
  return {.name = "viscoelastic",
          .description = "tests on linear viscoelastic bulk material: relaxation, creep, any strain, DMA",
          .read = read_program,
          .keys = [] { return std::vector<const KeyTable*>{&viscoelastic_case_keys()}; }};
}

}  // namespace pfdm
