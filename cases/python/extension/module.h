#pragma once
// The parts of the extension module _pfdm, each defined in the file of its name.

#include <pybind11/pybind11.h>

namespace pfdm {

void define_mass_material(pybind11::module_& module);
void define_endochronic(pybind11::module_& module);
void define_fracture_run(pybind11::module_& module);
void define_homogenization(pybind11::module_& module);
void define_interface_law(pybind11::module_& module);

/// Raises what a signal has asked for, KeyboardInterrupt after Ctrl-C, some twenty times a second. For loops that do
/// not hold the interpreter's lock; a thread other than the main one sees no signal.
void look_for_signals();

}  // namespace pfdm
