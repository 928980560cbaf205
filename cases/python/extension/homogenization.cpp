// The effective stiffness of a linear composite in process.

#include "cases/program/homogenization/debonding_case.h"
#include "cases/program/homogenization/homogenization_case.h"
#include "cases/program/homogenization/homogenized_results.h"
#include "cases/program/input/case_files/case_override.h"
#include "cases/python/extension/array_mesh.h"
#include "cases/python/extension/module.h"
#include "postproc/files/json.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {
namespace {

HomogenizationCase read_linear(const std::filesystem::path& where, const std::vector<std::string>& values,
                               MeshOf mesh) {
  const CaseFile file = with_overrides(open_case(where), values);
  const ConfigValue kind = file.config.root().at("kind");
  if (kind.string() != "homogenize") throw kind.error(fmt::format("\"{}\" is not \"homogenize\"", kind.string()));
  if (has_mean_path(file.config.root()))
    throw file.config.root().table("homogenization").at("path").error("a path has steps: pfdm.FractureRun() does them");
  return read_whole_homogenization_case(file, mesh);
}

/// The text of homogenized.json, less its origin.
std::string homogenize_case(const std::filesystem::path& where, const std::vector<std::string>& values,
                            const std::optional<MeshTuple>& given) {
  const std::optional<MeshArrays> arrays = arrays_of(given);
  const pybind11::gil_scoped_release others_run;
  const HomogenizationCase read = read_linear(where, values, arrays ? MeshOf::the_caller : MeshOf::the_case);
  const Mesh mesh = arrays ? mesh_of(*arrays) : read.mesh.make();
  const Homogenized result = homogenize(mesh, composite_on(read, mesh), read.settings,
                                        [](std::size_t, const LoadCase&) { look_for_signals(); });
  return json_text(homogenized_json(read, mesh, result, effective_material(read, mesh, result)));
}

}  // namespace

void define_homogenization(pybind11::module_& module) {
  module.def("homogenize", &homogenize_case, pybind11::arg("where"), pybind11::arg("values"), pybind11::arg("mesh"));
}

}  // namespace pfdm
