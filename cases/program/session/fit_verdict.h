#pragma once
// How every kind of fit says what is to be thought of it.

#include "cases/program/session/session.h"
#include "postproc/fits/fit_json.h"

#include <string>

namespace pfdm {

/// "95 % between 1 and 2", or that there is no interval; values with `digits` significant digits.
std::string interval_text(double lower, double upper, double confidence = 0.95, int digits = 6);

/// "; finer: +0.21 %" of an estimate that a finer discretisation was tried on, else nothing.
std::string moved_text(const FittedParameter& p);

/// The verdict, and what it means for the intervals: of tables.
std::string verdict_text(const FitFindings& found);

/// The last words of a fit: warnings, reasons, verdict. Throws ComputationError if --strict asks for a sound one.
void say_verdict(const FitFindings& found, const Session& session);

}  // namespace pfdm
