#include "cases/program/homogenization/homogenization_program.h"

#include "cases/program/fracture/fracture_program.h"
#include "cases/program/fracture/outcome/fracture_files.h"
#include "cases/program/fracture/outcome/fracture_results.h"
#include "cases/program/homogenization/debonding_case.h"
#include "cases/program/homogenization/homogenization_keys.h"
#include "cases/program/homogenization/homogenization_report.h"
#include "cases/program/homogenization/homogenized_results.h"
#include "cases/program/homogenization/load_case_frames.h"
#include "cases/program/input/fields/field_reader.h"
#include "cases/program/session/report_parts.h"
#include "cases/program/session/whole_run.h"
#include "mesh/quality.h"
#include "physics/quantity_text.h"
#include "postproc/curves/summary.h"
#include "postproc/files/folder_lock.h"

#include <fmt/format.h>

#include <optional>

namespace pfdm {
namespace {

struct HomogenizationProgram {
  CaseFile file;
  HomogenizationCase homogenization;
  std::string name;
  std::string hash;
  std::string mesh_hash;
};

Mesh make_mesh(const HomogenizationProgram& program, Log& log) {
  const Stopwatch watch;
  Mesh mesh = program.homogenization.mesh.make();
  log.say(fmt::format("mesh: {} cells, {} points, {} faces, made in {:.1f} s", mesh.n_cells(), mesh.points.size(),
                      mesh.n_faces(), watch.seconds()));
  return mesh;
}

const Mesh& find_mesh(const HomogenizationProgram& program, MeshStore& meshes, Log& log) {
  return meshes.get(program.mesh_hash, [&] { return make_mesh(program, log); });
}

void check(const HomogenizationProgram& program, Session& session) {
  const HomogenizationCase& homogenization = program.homogenization;
  Log& log = session.log;
  const Mesh mesh = make_mesh(program, log);
  const LinearComposite composite = composite_on(homogenization, mesh);
  const Index unknowns = homogenization_unknowns(mesh, composite, homogenization.settings);
  log.say(fmt::format("{}: {}", program.name, homogenization.title));
  log.say(fmt::format("cells {}, unknowns {}; six load cases, {}", mesh.n_cells(), unknowns,
                      homogenization.settings.loading->name));
  if (const auto warning = warning_of_volume(composite, mesh)) log.warn(*warning);
  log.say(fmt::format("results go to {}", session.results.string()));
  log.say("the input is valid");
}

void mesh_only(const HomogenizationProgram& program, Session& session) {
  const Mesh mesh = make_mesh(program, session.log);
  composite_on(program.homogenization, mesh);
  const FolderLock lock(session.results);
  session.log.say_lines(describe(mesh_quality(mesh)));
  write_mesh(session.results, mesh);
  session.log.say(fmt::format("written to {}", (session.results / "mesh.vtu").string()));
}

void write_summary_of(const HomogenizationProgram& program, const Session& session, const Mesh& mesh,
                      const Homogenized& result, const EffectiveMaterial& material, double seconds,
                      const std::filesystem::path& folder) {
  RunSummary summary = complete_run(program.name, program.hash, session, seconds);
  summary.cells = mesh.n_cells();
  summary.unknowns = result.n_unknowns;
  summary.steps = count_of(result.cases);
  for (const LoadCase& one : result.cases) summary.krylov_iterations += one.iterations;
  summary.other_figures = homogenized_figures(program.homogenization, result, material);
  write_summary(folder / summary_file, summary);
}

void say_bounds(const EffectiveMaterial& material, Log& log) {
  if (!material.hashin_shtrikman) return;
  const ModulusBounds& bounds = *material.hashin_shtrikman;
  log.say(fmt::format("Hashin and Shtrikman's bounds: K {}, G {}",
                      quantities_text({bounds.bulk_lower, bounds.bulk_upper}, "Pa", " to ", 5),
                      quantities_text({bounds.shear_lower, bounds.shear_upper}, "Pa", " to ", 5)));
}

// The bounds of K hold for any arrangement of the phases, periodic or with strains at the sides that hold it stiffer.
// By tractions at the sides a box may be softer.
std::optional<std::string> words_on_bounds(const HomogenizationCase& homogenization,
                                           const EffectiveMaterial& material) {
  constexpr double rounding = 1e-3;
  if (!material.hashin_shtrikman || homogenization.settings.loading->by_traction) return std::nullopt;
  const double K = material.isotropic.bulk_modulus(), least = material.hashin_shtrikman->bulk_lower;
  if (K >= (1.0 - rounding) * least) return std::nullopt;
  return fmt::format(
      "K lies {:.2g} % below Hashin and Shtrikman's lower bound, which holds for any arrangement: the mesh makes at "
      "least this error, and in G more. For less: finer cells, as more triangles on each particle ([mesh])",
      100.0 * (1.0 - K / least));
}

void say_result(const HomogenizationProgram& program, const Homogenized& result, const EffectiveMaterial& material,
                Log& log) {
  const HomogenizationCase& homogenization = program.homogenization;
  for (std::size_t m = 0; m < homogenization.by_name.size(); ++m)
    log.say(fmt::format("  {}: {:.5g} of the volume, {:.4g} of the energy", homogenization.by_name[m].name,
                        material.fraction[m], material.energy_share[m]));
  say_bounds(material, log);
  const IsotropicElasticity& c = material.isotropic;
  log.say(fmt::format("closest isotropic: E = {}, nu = {:.4f}, K = {}, G = {}; anisotropy {:.2g} %",
                      quantity_text(c.young_modulus(), "Pa", 5), c.poisson_ratio(),
                      quantity_text(c.bulk_modulus(), "Pa", 5), quantity_text(c.mu, "Pa", 5),
                      100.0 * material.anisotropy));
  if (material.loss.young > 0.0)
    log.say(fmt::format("loss factors: E {:.4g}, K {:.4g}, G {:.4g}", material.loss.young, material.loss.bulk,
                        material.loss.shear));
  log.say(
      fmt::format("errors: energies against mean stresses {:.1g}, asymmetry of C {:.1g}, mean strains of the cells "
                  "against mean stresses {:.1g}",
                  result.energy_difference(), result.asymmetry, result.constitutive_difference()));
  if (const auto warning = words_on_bounds(homogenization, material)) log.warn(*warning);
}

void run_case(const HomogenizationProgram& program, Session& session) {
  const HomogenizationCase& homogenization = program.homogenization;
  Log& log = session.log;
  MeshStore own_mesh;
  const Mesh& mesh = find_mesh(program, session.meshes != nullptr ? *session.meshes : own_mesh, log);
  const LinearComposite composite = composite_on(homogenization, mesh);
  homogenization_unknowns(mesh, composite, homogenization.settings);  // what is wrong with the body is said before
  if (const auto warning = warning_of_volume(composite, mesh)) log.warn(*warning);
  const auto compute = [&](const std::filesystem::path& folder, const Stopwatch& watch) -> std::string {
    const auto solved = [&](std::size_t k, const LoadCase& one) {
      log.step(
          fmt::format("load case {}: {} iterations, {:.1f} s", component_names[k], one.iterations, watch.seconds()));
      log.progress(fmt::format("load case {} of 6", k + 1));
    };
    std::optional<LoadCaseFrames> frames;
    std::function<void(std::size_t, const LoadCase&, const LoadCaseFields&)> kept;
    if (!session.figures_only) {
      frames.emplace(folder, mesh);
      kept = [&](std::size_t k, const LoadCase& one, const LoadCaseFields& fields) { frames->add(k, one, fields); };
    }
    const Homogenized result = homogenize(mesh, composite, homogenization.settings, solved, kept);
    const EffectiveMaterial material = effective_material(homogenization, mesh, result);
    write_homogenized(folder, homogenization, mesh, result, material, {program.name, program.hash, session.version});
    if (!session.figures_only) write_mesh(folder, mesh);
    write_summary_of(program, session, mesh, result, material, watch.seconds(), folder);
    say_result(program, result, material, log);
    return "complete";
  };
  run_whole({.file = program.file,
             .name = program.name,
             .title = homogenization.title,
             .hash = program.hash,
             .compute = compute,
             .results = {homogenized_file, load_cases_file, "mesh.vtu", load_case_frames_file, load_case_folder,
                         checkpoint_file, means_file},
             .remove_more = [&] { remove_earlier_run(session.results); }},
            session);
}

CasePage page_of(const HomogenizationProgram& program, const Session& session) {
  CasePage page{
      .report = homogenization_page(program.homogenization.title, program.name, program.hash, session.results),
      .extras = {.hash = program.hash}};
  page.extras.headline = {headline_of_composite(session.results)};
  page.extras.body = load_case_body(session.results);
  page.extras.steps = words_of_load_cases();
  for (const PageBlock& block : page.report.rows.front().blocks)
    page.extras.beside.push_back(std::get<Table>(block).caption);
  return page;
}

RunnableCase read_program(const CaseFile& file) {
  if (has_mean_path(file.config.root()))
    return runnable_box(file, read_debonding_case(file.config.root(), file.directory));
  auto program = std::make_shared<HomogenizationProgram>(
      HomogenizationProgram{.file = file, .homogenization = {}, .name = {}, .hash = {}, .mesh_hash = {}});
  program->homogenization = read_homogenization_case(file.config.root(), file.directory);
  program->name = case_name(file);
  const std::vector<std::filesystem::path>& of_mesh = program->homogenization.mesh.data_files;
  std::vector<std::filesystem::path> data = field_files(file);
  data.insert(data.begin(), of_mesh.begin(), of_mesh.end());
  constexpr std::string_view left_out[] = {"sweep"};
  program->hash = case_hash(file, data, left_out);
  program->mesh_hash = table_hash(file, "mesh", of_mesh);
  return {.title = program->homogenization.title,
          .check = [program](Session& session) { check(*program, session); },
          .mesh = [program](Session& session) { mesh_only(*program, session); },
          .run = [program](Session& session) { run_case(*program, session); },
          .page = [program](const Session& session) { return page_of(*program, session); },
          .prepare =
              [program](Session& session) {
                if (session.meshes != nullptr) find_mesh(*program, *session.meshes, session.log);
              },
          .data_files = data};
}

std::vector<LawTable> laws() {
  return {law_table("boundary conditions ([homogenization] boundary)", homogenization_loadings())};
}

}  // namespace

CaseKind homogenization_kind() {
  return {
      .name = "homogenize",
      .description = "effective linear stiffness of a meshed composite, or its stress-strain curve while it debonds",
      .read = read_program,
      .laws = laws,
      .keys =
          [] {
            return std::vector<const KeyTable*>{&composite_keys(), &debonding_keys()};
          },
      .numbers_like =
          [](std::string_view file) { return file == homogenized_file ? homogenized_like() : std::string(); }};
}

}  // namespace pfdm
