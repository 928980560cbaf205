#include "cases/program/homogenization/load_case_frames.h"

#include "physics/elasticity/mandel.h"
#include "postproc/fields/point_displacement.h"
#include "postproc/files/atomic_file.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr double strain_shown = 0.01;

template <class T>
CellField<T> times(double factor, CellField<T> field) {
  for (T& value : field) value *= factor;
  return field;
}

}  // namespace

LoadCaseFrames::LoadCaseFrames(std::filesystem::path folder, const Mesh& mesh)
    : folder_(std::move(folder)),
      mesh_(mesh),
      writer_(mesh),
      series_((make_folder(folder_ / load_case_folder), folder_ / load_case_frames_file)) {}

void LoadCaseFrames::add(std::size_t k, const LoadCase& one, const LoadCaseFields& fields) {
  const double factor = strain_shown / one.strain.norm();
  OutputFields output{.displacement = times(factor, fields.displacement),
                      .damage = CellField<double>(mesh_.n_cells(), 0.0),
                      .stress = times(factor, fields.stress),
                      .strain = times(factor, fields.strain),
                      .gradient = times(factor, fields.gradient),
                      .energy_density = {},
                      .driving_energy = {},
                      .fracture_energy_density = {},
                      .traction = {}};
  const SplitPoints points = point_displacement(mesh_, {}, output, 0.0);
  const std::string file = fmt::format("{}/load_case_{}.vtu", load_case_folder, component_names[k]);
  constexpr Precision single = Precision::single_precision;
  const auto time = static_cast<double>(k + 1);
  writer_.write(folder_ / file,
                {{"displacement", &output.displacement, single, "m"},
                 {"stress", &output.stress, single, "Pa"},
                 {"strain", &output.strain, single, "1"},
                 {"material", &mesh_.region}},
                time, &points);
  series_.add(time, file);
}

std::optional<Body> load_case_body(const std::filesystem::path& results) {
  if (!std::filesystem::exists(results / load_case_frames_file)) return std::nullopt;
  BodySettings settings{.frames = {}, .mesh = results / "mesh.vtu", .component = 0};
  for (const Frame& frame : read_pvd(results / load_case_frames_file)) {
    settings.frames.push_back({.step = static_cast<Index>(std::lround(frame.time)) - 1, .file = results / frame.file});
    settings.progress.push_back(frame.time);
  }
  return settings.frames.empty() ? std::nullopt : std::optional(read_body(settings));
}

std::vector<std::string> words_of_load_cases() {
  std::vector<std::string> words;
  words.reserve(component_names.size());
  for (const std::string_view name : component_names)
    words.push_back(fmt::format("Load case {} of six, at 1 % of strain", name));
  return words;
}

}  // namespace pfdm
