#pragma once
// How every kind of fit says what is to be thought of it.

#include "cases/program/session/session.h"
#include "physics/quantity_text.h"
#include "postproc/fits/fit_json.h"

#include <string>

namespace pfdm {

/// Significant digits that tell the ends of an interval apart: three of its width, and no less than `least`.
int digits_of_interval(double lower, double upper, int least);

/// "95 % between 1 and 2", or that there is no interval; values with `digits` significant digits, or as many more as
/// its width takes.
std::string interval_text(double lower, double upper, double confidence = 0.95, int digits = 3);

/// "1 and 2": ends of any interval, with as many digits as its width takes.
std::string ends_text(double lower, double upper, const std::string& between, int digits = 3);

/// An estimate with no more digits than its interval has behind the point, six at most; with four where it has none.
std::string value_text(double value, double lower, double upper);

/// The unit in which people write an estimate, of one in SI: with a prefix where its first symbol takes one, as in
/// "kN/m"; of numbers none.
ScaledUnit unit_of_estimate(double estimate, const std::string& unit);

/// "60.27 GPa, 95 % between 59.98 and 60.56", with the digits that the interval warrants.
std::string estimate_text(const FittedParameter& p, double confidence = 0.95);

/// Why the search for the estimates ended, without the numbers of the optimiser.
std::string end_of_search(const std::string& message);

/// "; finer: +0.21 %" of an estimate that a finer discretisation was tried on, else nothing.
std::string moved_text(const FittedParameter& p);

/// The verdict, and what it means for the intervals: of tables.
std::string verdict_text(const FitFindings& found);

/// Says where the results of a fit are, and the command that runs the fitted case.
void say_fitted_case(const Session& session);

/// The last words of a fit: warnings, reasons, verdict. Throws ComputationError if --strict asks for a sound one.
void say_verdict(const FitFindings& found, const Session& session);

}  // namespace pfdm
