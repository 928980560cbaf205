#pragma once
// Endochronic laws and their histories in the words of the log, in units that leave few digits before the point.

#include "cases/program/session/terminal/log.h"
#include "solver/point/mixed_control.h"

#include <map>
#include <string>
#include <vector>

namespace pfdm {

/// "346.6 MPa" of a stress [Pa]; "41.5 MJ/m^3" of an energy density [J/m^3].
std::string stress_shown(double stress);
std::string energy_density_shown(double density);

/// Kernel, hardening, rate factor, saturation stress, initial slope.
void say_law(const EndochronicLaw& law, Log& log);

/// Stresses, work and dissipation of a computed history, by the names and values of its summary.
void say_history(const std::map<std::string, double>& figures, Log& log);

/// The same as two sentences of a page.
std::vector<std::string> history_sentences(const std::map<std::string, double>& figures);

}  // namespace pfdm
