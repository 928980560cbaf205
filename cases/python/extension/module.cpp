// The extension module _pfdm: pieces of the library for the Python package pfdm, which documents them. Its stub is
// cases/python/_pfdm.pyi.

#include "cases/python/extension/module.h"

#include "cases/python/extension/script_law.h"
#include "physics/error.h"
#include "postproc/curves/instruction_set.h"
#include "solver/parallel.h"
#include "solver/parallel_forks.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace py = pybind11;

namespace pfdm {
namespace {

/// Sets the package's own exception.
void set_error(const char* type, const std::string& message) {
  const py::object exception = py::module_::import("pfdm.errors").attr(type);
  PyErr_SetObject(exception.ptr(), exception(message).ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const InputError& error) {
    set_error("InputError", error.what());
  } catch (const ComputationError& error) {
    set_error("ComputationError", error.what());
  }
}

/// A law that is asked within a loop would wait for that loop's end.
void set_threads_of_loops(int n) {
  if (is_within_script_law()) throw std::runtime_error("set_threads() cannot be called within a law");
  set_threads(n);
}

}  // namespace

void look_for_signals() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds patience(50);  // for the lock one may wait while other threads compute in Python
  thread_local Clock::time_point last{};
  if (Clock::now() - last < patience) return;
  last = Clock::now();
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace pfdm

PYBIND11_MODULE(_pfdm, module) {
  if (!pfdm::processor_has_instruction_set())
    throw py::import_error(
        fmt::format("_pfdm was compiled for {}, which this processor lacks: build it here, as ./pfdm python does",
                    pfdm::instruction_set()));
  module.doc() = "Pieces of pfdm in process. Use the package pfdm, which documents them.";
  py::register_local_exception_translator(pfdm::translate);
  pfdm::keep_threads_out_of_forks();
  module.def("set_threads", &pfdm::set_threads_of_loops, py::arg("n"), py::call_guard<py::gil_scoped_release>());
  module.def("n_threads", &pfdm::n_threads);
  pfdm::define_mass_material(module);
  pfdm::define_endochronic(module);
  pfdm::define_fracture_run(module);
  pfdm::define_homogenization(module);
  pfdm::define_interface_law(module);
}
