#pragma once
// pfdm fit of plates: the values of the case with which H1 and temperatures are those measured.

#include "cases/program/plate/plate_fit_case.h"
#include "cases/program/plate/plate_results.h"
#include "cases/program/session/session.h"

namespace pfdm {

inline constexpr const char* fit_file = "fit.json";

/// The curve of a measured one, with the first guess and the estimates beside it.
std::string plate_fit_curve_file(const std::string& name);

/// Writes fit.json, a curve for each measured one and case.fitted.toml to session.results. The program has a fit.
void fit_plate(const PlateProgram& program, Session& session);

}  // namespace pfdm
