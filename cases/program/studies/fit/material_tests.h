#pragma once
// What [[fit.experiments]] and [fit.bounds] of tests on a material point have in common, whatever its law.

#include "cases/program/input/config/config.h"
#include "postproc/fits/record_doubts.h"
#include "solver/calibration/calibration.h"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// The file of the results that has an experiment's curve; names that differ may have the same.
std::string fit_curve_file(const std::string& experiment);

/// Throws InputError if the curve of the experiment `test` would have the file of the experiment called `other`.
void require_own_file(const ConfigTable& test, const std::string& other);

/// Standard deviation of a column in SI, of this dimension; zero where none is given.
double read_noise(const ConfigTable& column, const Dimension& due);

/// Throws InputError if noise is given for some of `all` measured columns and not for others. `called`: "curves".
void require_noise_of_all_or_none(const ConfigTable& fit, std::size_t with, std::size_t all, std::string_view called);

/// [fit.bounds], which has to be there, of the parameters that are estimated, found by name: C_1 = ["1 GPa", "100
/// GPa"]. `read`: an end of the bounds of a parameter in SI. Throws InputError for other names and empty intervals.
std::vector<FitParameter> read_fit_bounds(
    const ConfigTable& fit, const std::vector<FitParameter>& parameters,
    const std::function<double(const FitParameter& parameter, const ConfigValue& end)>& read);

/// A measured column of a test beside the law's answer, in SI.
struct AnsweredColumn {
  std::string_view test, quantity, unit;  ///< "relaxation", "stress", "Pa"
  std::span<const double> measured, answered{};
  double usual = 1.0;                            ///< rms by which sizes of columns are comparable
  std::function<double(std::size_t)> deviation;  ///< by which the residual of a row was divided
  std::function<std::string(std::size_t)> at;    ///< where a row is: "12.3 ms"
};

/// As doubts about rows want it (postproc/fits/record_doubts.h). Names and what was measured have to outlive it.
FittedRecord record_of(const AnsweredColumn& column);

}  // namespace pfdm
