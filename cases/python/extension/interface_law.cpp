// Laws of cohesive interfaces and of softening in process, as functions of arrays.

#include "physics/interfaces/interface_law.h"

#include "cases/program/fracture/body/body_keys.h"
#include "cases/program/fracture/body/interface_reader.h"
#include "cases/python/extension/arrays.h"
#include "cases/python/extension/module.h"
#include "physics/damage/softening_law.h"
#include "physics/error.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {
namespace {

/// The keys of [[interface]] that do not say where it is.
UniformInterface interface_of_text(const std::string& toml, const std::filesystem::path& directory) {
  const Config config(toml, "InterfaceLaw", BareNumbers::in_si);
  return read_uniform_interface(config.root().with_keys(interface_keys()), directory);
}

InterfaceResponse response(const UniformInterface& face, const Vector& separation, const InterfaceHistory& before) {
  return face.law.respond(face.at, Vector::UnitX(), separation, before);
}

/// On a virgin interface that has opened.
double traction_in_opening(const UniformInterface& face, double opening) {
  return response(face, {opening, 0.0, 0.0}, {}).traction.x();
}

/// Separations one after the other, (n, 3): along the normal and twice across it.
py::dict follow(const UniformInterface& face, const ArrayOf<double>& separation) {
  if (separation.ndim() != 2 || separation.shape(1) != 3)
    throw InputError(fmt::format("separation: its shape is {}; (n, 3) is expected", shape_words(separation)));
  const py::ssize_t n = separation.shape(0);
  py::array_t<double> traction({n, py::ssize_t{3}}), damage(n), dissipated(n), stored(n);
  InterfaceHistory history;
  const double* d = separation.data();
  for (py::ssize_t i = 0; i < n; ++i, d += 3) {
    const Vector now(d[0], d[1], d[2]);
    if (!now.allFinite()) throw InputError(fmt::format("separation: row {} is not finite", i));
    const InterfaceResponse r = response(face, now, history);
    history = r.history;
    for (int k = 0; k < 3; ++k) traction.mutable_at(i, k) = r.traction[k];
    damage.mutable_at(i) = face.law.damage(face.at, Vector::UnitX(), now, history);
    dissipated.mutable_at(i) = history.dissipated;
    stored.mutable_at(i) = r.stored;
  }
  py::dict result;
  result["traction"] = traction;
  result["damage"] = damage;
  result["dissipated"] = dissipated;
  result["stored"] = stored;
  return result;
}

/// strength = ..., toughness = ...
py::object softening(const std::string& law, const std::string& toml, const py::array_t<double>& opening) {
  const SofteningLaw& chosen = softening_law(law);
  const ConfigTable values = Config(toml, "softening", BareNumbers::in_si).root().with_keys({"strength", "toughness"});
  const double strength = values.quantity("strength", dimension::stress, range::positive),
               toughness = values.quantity("toughness", dimension::toughness, range::positive);
  return py::vectorize([&](double w) { return strength * chosen.traction(std::max(w, 0.0) * strength / toughness); })(
      opening);
}

}  // namespace

void define_interface_law(py::module_& module) {
  using Face = UniformInterface;
  py::class_<Face>(module, "InterfaceLaw")
      .def_static("from_text", &interface_of_text, py::arg("toml"), py::arg("directory"))
      .def_property_readonly("name", [](const Face& face) { return face.law.law->name; })
      .def_property_readonly("strength", [](const Face& face) { return face.at.strength; })
      .def_property_readonly("toughness", [](const Face& face) { return face.at.toughness; })
      .def(
          "traction",
          [](const Face& face, const py::array_t<double>& opening) {
            return py::vectorize([&face](double at) { return traction_in_opening(face, at); })(opening);
          },
          py::arg("opening"))
      .def("follow", &follow, py::arg("separation"));
  module.def("softening", &softening, py::arg("law"), py::arg("toml"), py::arg("opening"));
  module.def("interface_laws", [] { return keys::names_of(interface_laws()); });
  module.def("softening_laws", [] { return keys::names_of(softening_laws()); });
}

}  // namespace pfdm
