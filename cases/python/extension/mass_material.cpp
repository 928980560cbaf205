// The mass-material system in process: parameters as case.toml has them, forces, motions.

#include "cases/program/input/case_files/case_override.h"
#include "cases/program/vibration/mass_material_case.h"
#include "cases/program/vibration/mass_material_keys.h"
#include "cases/python/extension/arrays.h"
#include "cases/python/extension/module.h"
#include "physics/error.h"
#include "solver/vibration/simulation/mass_material_simulation.h"

#include <fmt/format.h>
#include <pybind11/complex.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <complex>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

constexpr const char* shown_as = "MassMaterial";

MassMaterialCase simulable(MassMaterialCase read) {
  require_parameters(read);
  return read;
}

/// model = { ... }, and sample = { ... } where Young's modulus is given.
MassMaterialCase model_of_text(const std::string& toml) {
  return simulable(read_sample_model(Config(toml, shown_as, BareNumbers::in_si).root()));
}

MassMaterialCase model_of_case(const std::filesystem::path& where, const std::vector<std::string>& values) {
  const CaseFile file = with_overrides(open_case(where), values);
  const ConfigValue kind = file.config.root().at("kind");
  if (kind.string() != "mass_material") throw kind.error(fmt::format("\"{}\" is not \"mass_material\"", kind.string()));
  return simulable(read_mass_material_case(file.config.root(), file.directory));
}

void require_rate(double rate) {
  if (!(rate > 0.0)) throw InputError(fmt::format("rate: {} Hz must be positive", rate));
}

py::dict motion_of(const MassMaterialCase& c, Excitation excitation, double rate, double tolerance) {
  excitation.acceleration = [acceleration = std::move(excitation.acceleration)](double time) {
    look_for_signals();
    return acceleration(time);
  };
  Motion motion;
  {
    const py::gil_scoped_release others_run;
    motion = simulate(c.model, excitation, rate, tolerance);
  }
  if (!motion.bounded)
    throw ComputationError("the motion is unbounded: the restoring force does not hold the mass at this level");
  py::dict result;
  result["base_acceleration"] = copy_of(motion.base);
  result["relative_displacement"] = copy_of(motion.displacement);
  result["relative_velocity"] = copy_of(motion.velocity);
  result["relative_acceleration"] = copy_of(motion.acceleration);
  return result;
}

/// Samples of the base's acceleration at `base_rate` [Hz], the motion's at `rate`.
py::dict motion_by_record(const MassMaterialCase& c, const ArrayOf<double>& base, double base_rate, double low,
                          double high, double rate, double tolerance) {
  const std::vector<double> samples = numbers_of(base, "base");
  const Eigen::VectorXd signal = Eigen::VectorXd::Map(samples.data(), static_cast<Eigen::Index>(samples.size()));
  if (samples.size() < 2 || !signal.allFinite())
    throw InputError("base: at least two samples are expected, all of them finite");
  require_rate(rate);
  require_rate(base_rate);
  if (!(low > 0.0 && low < high && high <= highest_frequency(rate)))
    throw InputError(
        fmt::format("band: {} to {} Hz must rise from above 0 to at most {:.4g} Hz at {} samples per second", low, high,
                    highest_frequency(rate), rate));
  return motion_of(c, sampled_excitation(signal, base_rate, low, high), rate, tolerance);
}

/// test = [{ name = "...", excitation = { ... } }]
py::dict motion_by_excitation(const MassMaterialCase& c, const std::string& toml,
                              const std::filesystem::path& directory, double rate, double tolerance) {
  require_rate(rate);
  const ConfigTable root = Config(toml, shown_as, BareNumbers::in_si).root().with_keys(mass_material_keys());
  std::vector<std::filesystem::path> data_files;
  const Excitation excitation =
      read_excitation(root.tables("test").front().table("excitation"), directory, rate, data_files);
  return motion_of(c, excitation, rate, tolerance);
}

double omega_of(double frequency) { return 2.0 * std::numbers::pi * frequency; }

/// Values of the model's functions, of arrays.
void define_functions(py::class_<MassMaterialCase>& of) {
  using Model = MassMaterialCase;
  of.def(
        "stiffness_force",
        [](const Model& c, const py::array_t<double>& z) {
          return py::vectorize([&c](double at) { return stiffness_force(c.model, at); })(z);
        },
        py::arg("displacement"))
      .def(
          "damping_force",
          [](const Model& c, const py::array_t<double>& v) {
            return py::vectorize([&c](double at) { return damping_force(c.model, at); })(v);
          },
          py::arg("velocity"))
      .def(
          "kernel",
          [](const Model& c, const py::array_t<double>& t) {
            return py::vectorize([&c](double at) { return kernel_value(c.model, at); })(t);
          },
          py::arg("time"))
      .def(
          "complex_stiffness",
          [](const Model& c, const py::array_t<double>& frequency, double velocity) {
            return py::vectorize(
                [&c, velocity](double at) { return complex_stiffness(c.model, omega_of(at), velocity); })(frequency);
          },
          py::arg("frequency"), py::arg("velocity"));
}

}  // namespace

void define_mass_material(py::module_& module) {
  using Model = MassMaterialCase;
  py::class_<Model> of(module, "MassMaterial");
  of.def_static("from_text", &model_of_text, py::arg("toml"))
      .def_static("from_case", &model_of_case, py::arg("where"), py::arg("values"))
      .def_readonly("structure", &Model::structure)
      .def_property_readonly("mass", [](const Model& c) { return c.model.mass; })
      .def_property_readonly("stiffness", [](const Model& c) { return copy_of(c.model.stiffness); })
      .def_property_readonly("damping", [](const Model& c) { return c.model.damping; })
      .def_property_readonly("static_stiffness", [](const Model& c) { return static_stiffness(c.model); })
      .def("text", [](const Model& c) { return model_text(c.structure, c.model); })
      .def(
          "settling_point", [](const Model& c, double gravity) { return static_settling_point(c.model, gravity); },
          py::arg("gravity"))
      .def("respond", &motion_by_record, py::arg("base"), py::arg("base_rate"), py::arg("low"), py::arg("high"),
           py::arg("rate"), py::arg("tolerance"))
      .def("respond_to", &motion_by_excitation, py::arg("toml"), py::arg("directory"), py::arg("rate"),
           py::arg("tolerance"));
  define_functions(of);
}

}  // namespace pfdm
