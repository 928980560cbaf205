#include "cases/python/extension/script_law.h"

#include "physics/error.h"
#include "physics/interfaces/interface_law.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

thread_local int depth = 0;  // of calls of laws in this thread

std::string type_of(const py::object& object) { return py::str(py::type::of(object).attr("__qualname__")); }

std::string shape_text(const std::vector<py::ssize_t>& shape) {
  return fmt::format("({}{})", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
}

CohesiveSurface& surface_named(const std::string& name, FractureModel& model) {
  std::vector<std::string> names;
  for (CohesiveSurface& surface : model.interfaces) {
    if (surface.name == name) return surface;
    names.push_back(surface.name);
  }
  throw InputError(fmt::format("interfaces: there is no interface \"{}\" (there are: {})", name,
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

void put_on_interface(const std::string& name, const py::object& law, FractureModel& model) {
  InterfaceLaw& known = surface_named(name, model).law;
  if (known.friction > 0.0 || known.rate.any() || !known.branches.empty())
    throw InputError(
        fmt::format("interfaces[\"{}\"]: friction, rate and branches of the case belong to the law that this one takes "
                    "the place of: leave them out",
                    name));
  known.own_law = make_script_interface(fmt::format("interfaces[\"{}\"]", name), law, model.is_finite_strain());
}

bool is_hyperelastic(const py::object& law) {
  return py::isinstance(law, py::module_::import("pfdm.own_laws").attr("OwnHyperelastic"));
}

std::shared_ptr<const Material> material_of(const std::string& place, const py::object& law,
                                            const RegionModel& region) {
  const bool is_finite = region.material && region.material->is_finite_strain();
  if (!is_hyperelastic(law)) {
    if (is_finite)
      throw InputError(fmt::format(
          "{}: the case has a material of finite strain there; derive the law from pfdm.OwnHyperelastic", place));
    return make_script_material(place, law, region.elasticity);
  }
  if (!is_finite)
    throw InputError(
        fmt::format("{}: the case has no material of finite strain there, whose place a law derived from "
                    "pfdm.OwnHyperelastic takes; give it law = \"neo_hookean\"",
                    place));
  if (region.strength.is_chosen())
    throw InputError(
        fmt::format("{}: a law derived from pfdm.OwnHyperelastic cannot be combined with a model of "
                    "strength (fracture.model)",
                    place));
  return make_script_hyperelastic(place, law, *region.material);
}

void put_in_region(const std::string& name, const py::object& law, const Mesh& mesh, FractureModel& model) {
  const auto found = std::ranges::find(mesh.region_names, name);
  if (found == mesh.region_names.end())
    throw InputError(
        fmt::format("materials: there is no region \"{}\" (there are: {})", name, fmt::join(mesh.region_names, ", ")));
  const auto r = static_cast<Index>(found - mesh.region_names.begin());
  RegionModel& region = model.regions[r];
  const std::string place = fmt::format("materials[\"{}\"]", name);
  region.material = material_of(place, law, region);
  for (Index c = 0; c < model.cells.size(); ++c) {
    if (mesh.region[c] != r) continue;
    if (model.cells[c].elasticity != region.elasticity)
      throw InputError(fmt::format("{}: its elasticity must not vary from place to place", place));
    model.cells[c].material = region.material;
  }
}

}  // namespace

bool is_within_script_law() { return depth > 0; }

void put_into_model(const ScriptLaws& laws, const Mesh& mesh, FractureModel& model) {
  const py::gil_scoped_acquire lock;
  for (const auto& [name, law] : laws.interfaces) put_on_interface(name, law, model);
  for (const auto& [name, law] : laws.materials) put_in_region(name, law, mesh, model);
}

std::string words_of(const ScriptLaws& laws) {
  std::string words;
  for (const auto& [name, law] : laws.interfaces) words += fmt::format("interfaces[\"{}\"]: {} ", name, type_of(law));
  for (const auto& [name, law] : laws.materials) words += fmt::format("materials[\"{}\"]: {} ", name, type_of(law));
  return words;
}

ScriptLaw::ScriptLaw(std::string place, const py::object& law, std::size_t most_numbers, std::size_t n_entries)
    : place_(fmt::format("{} ({})", place, type_of(law))),
      respond_(law.attr("respond")),
      n_entries_(n_entries),
      depends_on_rate_(py::bool_(py::getattr(law, "depends_on_rate", py::bool_(false)))) {
  const py::object size = py::getattr(law, "history_size", py::int_(0));
  const Py_ssize_t n = PyIndex_Check(size.ptr()) ? PyNumber_AsSsize_t(size.ptr(), nullptr) : -1;
  if (n < 0 || static_cast<std::size_t>(n) > most_numbers)
    throw InputError(fmt::format("{}: history_size is {}; a whole number from 0 to {} is expected", place_,
                                 std::string(py::repr(size)), most_numbers));
  history_size_ = static_cast<std::size_t>(n);
}

ScriptLaw::~ScriptLaw() {
  const py::gil_scoped_acquire lock;
  respond_.release().dec_ref();
}

ScriptLaw::Turn::Turn() { ++depth; }
ScriptLaw::Turn::~Turn() { --depth; }

ScriptLaw::Answer ScriptLaw::answer(const py::object& returned) const {
  if (!py::isinstance<py::tuple>(returned) || py::len(returned) != n_entries_)
    throw InputError(fmt::format("{}: respond() has returned {}; a tuple of {} entries is expected", place_,
                                 std::string(py::repr(returned)), n_entries_));
  return {*this, returned.cast<py::tuple>()};
}

void ScriptLaw::Answer::read(std::size_t entry, const char* name, const std::vector<py::ssize_t>& shape,
                             double* to) const {
  const auto array = ArrayOf<double>::ensure(entries_[entry]);
  if (!array) {
    PyErr_Clear();
    throw InputError(fmt::format("{}: the {} that respond() returns is no array of numbers", law_.place_, name));
  }
  const bool fits = std::ranges::equal(std::span(array.shape(), static_cast<std::size_t>(array.ndim())), shape);
  if (!fits)
    throw InputError(fmt::format("{}: the {} that respond() returns has the shape {}; {} is expected", law_.place_,
                                 name, shape_words(array), shape_text(shape)));
  std::copy_n(array.data(), array.size(), to);
}

void ScriptLaw::Answer::read_finite(std::size_t entry, const char* name, const std::vector<py::ssize_t>& shape,
                                    double* to) const {
  read(entry, name, shape, to);
  std::size_t size = 1;
  for (const py::ssize_t n : shape) size *= static_cast<std::size_t>(n);
  if (!std::ranges::all_of(std::span(to, size), [](double value) { return std::isfinite(value); }))
    throw InputError(fmt::format("{}: the {} that respond() returns is not finite", law_.place_, name));
}

double ScriptLaw::Answer::number(std::size_t entry, const char* name) const {
  double value = 0.0;
  read_finite(entry, name, {}, &value);
  return value;
}

double ScriptLaw::Answer::any_number(std::size_t entry, const char* name) const {
  double value = 0.0;
  read(entry, name, {}, &value);
  return value;
}

double ScriptLaw::Answer::dissipated(std::size_t entry, double rounding) const {
  const double value = number(entry, "dissipated energy");
  if (value < -rounding)
    throw InputError(fmt::format("{}: the dissipated energy that respond() returns is {:g}; it must not be negative",
                                 law_.place_, value));
  return value;
}

}  // namespace pfdm
