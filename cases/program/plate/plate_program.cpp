#include "cases/program/plate/plate_program.h"

#include "cases/program/fracture/outcome/fracture_results.h"
#include "cases/program/plate/plate_browser.h"
#include "cases/program/plate/plate_fit.h"
#include "cases/program/plate/plate_keys.h"
#include "cases/program/plate/plate_report.h"
#include "cases/program/plate/plate_run.h"
#include "cases/program/plate/plate_words.h"
#include "cases/program/session/report_parts.h"
#include "cases/program/session/terminal/stop_signal.h"
#include "cases/program/session/whole_run.h"
#include "mesh/quality.h"
#include "postproc/curves/summary.h"
#include "postproc/files/folder_lock.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view no_part_of_the_run[] = {"fit", "sweep"};

void check(const PlateProgram& program, Session& session) {
  const PlateCase& c = program.parsed;
  const Mesh mesh = c.mesh.make();
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(c, mesh));
  if (c.heating) {
    [[maybe_unused]] const HeatedBody refuses(mesh, c.material.heat, c.heating->boundary);
    mesh.patch(c.heating->surface);
  }
  Log& log = session.log;
  log.say(fmt::format("{}: {}", program.name, c.title));
  log.say(
      fmt::format("cells {}, unknowns {}", mesh.n_cells(), 3 * unknowns.n_nodes() + unknowns.pressure_cells.size()));
  log.say(fmt::format("frequency response at {} frequencies from {:g} to {:g} Hz, {} modes", c.n_frequencies, c.from,
                      c.to, c.n_modes));
  if (c.heating) log.say(fmt::format("heating for {:g} s in steps of {:g} s", c.heating->duration, c.heating->step));
  if (const auto words = words_on_layers(mesh, unknowns)) log.warn(*words);
  log.say(fmt::format("results go to {}", session.results.string()));
  log.say("the input is valid");
}

void mesh_only(const PlateProgram& program, Session& session) {
  const Mesh mesh = program.parsed.mesh.make();
  place_unknowns(mesh, elastic_body(program.parsed, mesh));
  const FolderLock lock(session.results);
  session.log.say(describe(mesh_quality(mesh)));
  write_mesh(session.results, mesh);
  session.log.say(fmt::format("written to {}", (session.results / "mesh.vtu").string()));
}

/// Heats the body and writes what comes of it; figures of the end join the others.
void run_heating(const PlateCase& c, const PlateRun& run, const Mesh& mesh, double frequency, const fs::path& folder,
                 Session& session, std::map<std::string, double>& figures) {
  PlateFrames frames(folder, mesh);
  if (c.excitation.type == "harmonic") frames.set_motion(run.motion(frequency, c.heating->surroundings), c.direction);
  std::vector<HeatingRow> rows;
  std::vector<double> surface;
  const LooksForStop looks;
  run.heat(frequency, [&](const HeatingRow& row, const HeatedBody& body, const CellField<double>& source) {
    stop_if_asked();
    rows.push_back(row);
    const double share = row.time / c.heating->duration * c.n_frames;
    const bool due =
        row.time == 0.0 ||
        std::floor(share + 1e-9) > std::floor((rows[rows.size() - 2].time) / c.heating->duration * c.n_frames + 1e-9);
    if (due) {
      frames.add(row.time, source, body.rise());
      session.log.step(fmt::format("{:6.1f} min: surface warmer by {:.4g} K in the mean, {:.4g} K at most",
                                   row.time / 60.0, row.surface.mean, row.surface.largest));
    }
    surface = body.face_rise(c.heating->surface);
  });
  write_heating(folder, rows);
  write_surface(folder, mesh, c.heating->surface, surface);
  const HeatingRow &first = rows.front(), &last = rows.back();
  const double missing = last.account.heat - last.account.stored - last.account.lost;
  figures.insert({{"mechanical_power_W", first.power},
                  {"heat_source_correction", first.correction},
                  {"surface_mean_rise_K", last.surface.mean},
                  {"surface_largest_rise_K", last.surface.largest},
                  {"mean_rise_K", last.mean_rise},
                  {"largest_rise_K", last.largest_rise},
                  {"first_resonance_at_end_Hz", last.resonance},
                  {"mechanical_work_J", last.work},
                  {"heat_J", last.account.heat},
                  {"heat_stored_J", last.account.stored},
                  {"heat_lost_J", last.account.lost},
                  {"heat_balance_error", missing / last.work}});
}

void compute(const PlateProgram& program, Session& session, const fs::path& folder, FiguresSummary& summary) {
  const PlateCase& c = program.parsed;
  const Mesh mesh = c.mesh.make();
  const PlateRun run(c, mesh, c.n_modes);
  Log& log = session.log;
  log.say(fmt::format("cells {}, {}, {} vectors of the frequency response", mesh.n_cells(), run.body().method(),
                      run.dimension()));
  if (const auto words = words_on_layers(mesh, run.body().unknowns())) log.say(*words);
  const double temperature = c.heating ? c.heating->surroundings : c.material.reference;
  const std::vector<Resonance> resonances = run.resonances(temperature);
  write_resonances(folder, resonances);
  for (std::size_t k = 0; k < resonances.size(); ++k)
    log.say(fmt::format("mode {}: {:.5g} Hz, damping ratio {:.3g}, effective mass {:.1f} %", k + 1,
                        resonances[k].frequency, 0.5 * resonances[k].loss_factor,
                        100.0 * resonances[k].effective_mass.dot(c.direction)));
  if (const auto words = words_on_half_waves(run, resonances, c.to)) log.warn(*words);
  write_response(folder, c, run.response());
  summary.figures = {{"cells", mesh.n_cells()},
                     {"mass_kg", run.body().total_mass()},
                     {"first_resonance_Hz", resonances.front().frequency}};
  double frequency = 0.0;
  if (c.excitation.type == "harmonic") {
    frequency = run.driving_frequency(temperature);
    summary.figures["driving_frequency_Hz"] = frequency;
    log.say(fmt::format("driven at {:.5g} Hz", frequency));
  }
  if (c.heating) run_heating(c, run, mesh, frequency, folder, session, summary.figures);
}

void run_case(const PlateProgram& program, Session& session) {
  const auto compute_all = [&](const fs::path& folder, const Stopwatch& watch) -> std::string {
    FiguresSummary summary = complete_summary(program.name, program.hash, session);
    compute(program, session, folder, summary);
    summary.wall_seconds = watch.seconds();
    write_figures_summary(folder / summary_file, summary);
    return summary.status;
  };
  run_whole({.file = program.file,
             .name = program.name,
             .title = program.parsed.title,
             .hash = program.hash,
             .compute = compute_all,
             .results = {response_file, modes_file, temperature_file, surface_file, "fields.pvd", "fields"}},
            session);
}

RunnableCase read_program(const CaseFile& file) {
  auto program = std::make_shared<PlateProgram>(PlateProgram{.file = file, .parsed = {}, .name = {}, .hash = {}});
  program->parsed = read_plate_case(file.config.root(), file.directory);
  program->fit = read_plate_fit(file, program->parsed);
  program->name = case_name(file);
  program->hash = case_hash(file, program->parsed.data_files, no_part_of_the_run);
  RunnableCase runnable{.title = program->parsed.title,
                        .check = [program](Session& session) { check(*program, session); },
                        .mesh = [program](Session& session) { mesh_only(*program, session); },
                        .run = [program](Session& session) { run_case(*program, session); },
                        .fit = [program](Session& session) { fit_plate(*program, session); },
                        .page =
                            [program](const Session& session) {
                              return CasePage{.report = plate_page(*program, session),
                                              .extras = plate_extras(*program, session.results)};
                            },
                        .data_files = program->parsed.data_files};
  if (!program->fit)
    runnable.fit = job_without_table(file, "fit",
                                     "[[fit.parameters]] with their bounds, and the measured curves as "
                                     "[[fit.responses]] or [[fit.temperatures]]",
                                     "plate_fit");
  return runnable;
}

std::vector<LawTable> laws() {
  return {law_table("supports ([[support]] type)", support_types()),
          law_table("motions of the base ([base] motion)", base_motions()),
          law_table("cooling of the surface ([[cooling]] type)", cooling_types())};
}

}  // namespace

CaseKind plate_kind() {
  return {.name = "plate",
          .description = "viscoelastic plate or other body on a shaker: modes, frequency response, heating",
          .read = read_program,
          .laws = laws,
          .keys = [] { return std::vector<const KeyTable*>{&plate_keys()}; }};
}

}  // namespace pfdm
