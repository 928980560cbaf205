// Fracture runs in process, step by step, with views of their fields.

#include "cases/python/extension/array_mesh.h"
#include "cases/python/extension/arrays.h"
#include "cases/python/extension/module.h"
#include "cases/python/extension/script_law.h"
#include "cases/python/extension/stepped_run.h"
#include "postproc/fields/frame.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace pfdm {
namespace {

constexpr py::ssize_t bytes = sizeof(double);

template <class Owner>
py::array view(std::shared_ptr<Owner> owner, const CellField<double>* field) {
  return view_of(std::move(owner), field->data(), {field->size()});
}
template <class Owner>
py::array view(std::shared_ptr<Owner> owner, const CellField<Vector>* field) {
  return view_of(std::move(owner), field->data()->data(), {field->size(), 3});
}
/// Eigen's tensors stand column by column.
template <class Owner>
py::array view(std::shared_ptr<Owner> owner, const CellField<Tensor>* field) {
  return view_of(std::move(owner), field->data()->data(), {field->size(), 3, 3}, {9 * bytes, bytes, 3 * bytes});
}
template <class Owner>
py::array view(std::shared_ptr<Owner> owner, const CellField<Index>* field) {
  return view_of(std::move(owner), field->data(), {field->size()});
}

std::unique_ptr<SteppedRun> open(const std::filesystem::path& where, const std::vector<std::string>& values,
                                 const std::optional<MeshTuple>& given, std::map<std::string, py::object> interfaces,
                                 std::map<std::string, py::object> materials) {
  const std::optional<MeshArrays> arrays = arrays_of(given);
  const ScriptLaws laws{std::move(interfaces), std::move(materials)};
  SteppedRun::Laws put{.change = {}, .words = words_of(laws)};
  if (!put.words.empty())
    put.change = [&laws](const Mesh& mesh, FractureModel& model) { put_into_model(laws, mesh, model); };
  const py::gil_scoped_release others_run;
  std::optional<Mesh> mesh;
  if (arrays) mesh = mesh_of(*arrays);
  return std::make_unique<SteppedRun>(where, values, std::move(mesh), put);
}

void step(SteppedRun& run, const py::object& on_iteration) {
  const bool is_watched = !on_iteration.is_none();
  const py::gil_scoped_release others_run;
  run.step([&](const IterationReport& at) {
    look_for_signals();
    if (!is_watched || (at.in_balance && at.remark.empty())) return;
    const py::gil_scoped_acquire lock;
    on_iteration(py::dict(py::arg("step") = at.step, py::arg("iteration") = at.iteration, py::arg("load") = at.load,
                          py::arg("damage_change") = at.damage_change, py::arg("energy_change") = at.energy_change,
                          py::arg("remark") = at.remark));
  });
}

/// Those of a frame, by their names in its file.
py::dict fields(SteppedRun& run) {
  std::shared_ptr<const OutputFields> output;
  {
    const py::gil_scoped_release others_run;
    output = run.fields();
  }
  const std::shared_ptr<const Mesh>& mesh = run.mesh();
  const NamedField::Values regions = &mesh->region;
  py::dict result;
  for (const NamedField& field : frame_fields(*mesh, *output)) {
    const auto view_of_field = [&](const auto* values) {
      return field.values == regions ? view(mesh, values) : view(output, values);
    };
    result[py::str(field.name)] = std::visit(view_of_field, field.values);
  }
  return result;
}

/// The mesh in the order of the fields.
py::dict mesh(const SteppedRun& run) {
  const std::shared_ptr<const Mesh>& owner = run.mesh();
  const Mesh& mesh = *owner;
  const auto indices = [&](const std::vector<Index>& all, std::size_t from) -> py::array {
    return view_of(owner, all.data() + from, {static_cast<py::ssize_t>(all.size() - from)});
  };
  py::dict result;
  result["points"] = view_of(owner, mesh.points.front().data(), {static_cast<py::ssize_t>(mesh.points.size()), 3});
  result["connectivity"] = indices(mesh.cell_points, 0);
  result["offsets"] = indices(mesh.cell_offsets, 1);
  result["cell_centres"] = view(owner, &mesh.cell_centre);
  result["cell_volumes"] = view(owner, &mesh.cell_volume);
  result["region"] = view(owner, &mesh.region);
  result["regions"] = mesh.region_names;
  std::vector<std::string> patches;
  for (const Patch& patch : mesh.patches) patches.push_back(patch.name);
  result["patches"] = patches;
  return result;
}

std::vector<double> components(const Vector& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

void define_fracture_run(py::module_& module) {
  py::class_<RunState, std::shared_ptr<RunState>>(module, "State")
      .def_property_readonly("step", [](const RunState& s) { return s.state.step; })
      .def_property_readonly("load", [](const RunState& s) { return s.state.load; });
  py::class_<SteppedRun>(module, "FractureRun")
      .def(py::init(&open), py::arg("where"), py::arg("values"), py::arg("mesh"), py::arg("interfaces"),
           py::arg("materials"))
      .def_property_readonly("title", &SteppedRun::title)
      .def_property_readonly("is_complete", &SteppedRun::is_complete)
      .def_property_readonly("remarks", [](const SteppedRun& run) { return run.state()->report.remarks; })
      .def_property_readonly("state",
                             [](const SteppedRun& run) { return std::const_pointer_cast<RunState>(run.state()); })
      .def(
          "restore", [](SteppedRun& run, std::shared_ptr<RunState> state) { run.restore(std::move(state)); },
          py::arg("state"))
      .def("step", &step, py::arg("on_iteration"))
      .def("row", &SteppedRun::row)
      .def("fields", &fields)
      .def("mesh", &mesh)
      .def(
          "reaction", [](const SteppedRun& run, const std::string& patch) { return components(run.reaction(patch)); },
          py::arg("patch"))
      .def(
          "patch_displacement",
          [](const SteppedRun& run, const std::string& patch) { return components(run.displacement(patch)); },
          py::arg("patch"));
}

}  // namespace pfdm
