// What a plate's model may lack, each as a direction in which the residuals would move.

#include "cases/program/plate/plate_fit_model.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

using Derivatives = std::vector<double>;

// The modulus and the loss factor times powers of the frequency, over the range of the response.
PlateCase with_powers(PlateCase c, double of_modulus, double of_loss) {
  constexpr int n = 40;
  const double middle = std::sqrt(c.from * c.to), first = 0.5 * c.from, ratio = 4.0 * c.to / c.from;
  std::vector<ModulusAt> rows;
  for (int i = 0; i <= n; ++i) {
    const double f = first * std::pow(ratio, static_cast<double>(i) / n);
    const Harmonic there = c.material.at(f, c.material.reference);
    const double storage = there.factor.real() * c.material.young_modulus();
    rows.push_back({.frequency = f,
                    .storage = storage * std::pow(f / middle, of_modulus),
                    .loss_factor = there.factor.imag() / there.factor.real() * std::pow(f / middle, of_loss)});
  }
  c.material.modulus = std::move(rows);
  return c;
}

PlateCase with_slope(PlateCase c, double slope) {
  if (!c.material.depends_on_temperature()) c.material.reference = c.heating->surroundings;
  c.material.modulus_slope += slope;
  return c;
}

PlateCase with_cooling(PlateCase c, double factor) {
  for (DiffusionBoundary& boundary : c.heating->boundary) boundary.coefficient *= factor;
  return c;
}

PlateCase with_level(PlateCase c, double factor) {
  c.excitation.level *= factor;
  return c;
}

// What an error of the measurement adds to the residuals.
Derivatives of_measurement(const PlateFit& fit, double magnitude, double phase_per_hertz, double rise) {
  Derivatives column;
  for (const MeasuredResponse& response : fit.responses) {
    for (std::size_t i = 0; i < response.magnitude.size(); ++i) column.push_back(magnitude / response.deviation);
    for (std::size_t i = 0; i < response.phase.size(); ++i)
      column.push_back(phase_per_hertz * response.frequency[i] / response.deviation);
  }
  for (const MeasuredRise& measured : fit.rises)
    for (std::size_t i = 0; i < measured.rise.size(); ++i) column.push_back(rise / measured.deviation);
  return column;
}

// (residuals at the varied case - residuals) / step; nothing where it cannot be.
std::optional<Derivatives> difference(PlateModel& model, const PlateCase& varied, const Derivatives& residuals,
                                      double step) {
  auto column = model.residuals(varied);
  if (!column) return std::nullopt;
  for (std::size_t i = 0; i < column->size(); ++i) (*column)[i] = ((*column)[i] - residuals[i]) / step;
  return column;
}

std::vector<Derivatives> columns_of_parameters(PlateModel& model, const std::vector<double>& values,
                                               const Derivatives& residuals) {
  constexpr double step = 1e-4;
  std::vector<Derivatives> columns;
  for (std::size_t j = 0; j < values.size(); ++j) {
    std::vector<double> varied = values;
    varied[j] *= 1.0 + step;
    if (auto column = difference(model, model.with(varied), residuals, step)) columns.push_back(std::move(*column));
  }
  return columns;
}

}  // namespace

std::vector<FitSuspect> suspects_of(PlateModel& model, const PlateFit& fit, const std::vector<double>& values,
                                    const std::vector<double>& residuals) {
  constexpr double step = 1e-3;
  const PlateCase c = model.with(values);
  const std::vector<Derivatives> of_parameters = columns_of_parameters(model, values, residuals);
  std::vector<FitSuspect> suspects;
  const auto try_column = [&](const char* what, std::optional<Derivatives> column) {
    if (!column || std::ranges::all_of(*column, [](double x) { return x == 0.0; })) return;
    std::vector<Derivatives> columns = of_parameters;
    columns.push_back(std::move(*column));
    suspects.push_back({what, rms_left_by(residuals, columns)});
  };
  const auto try_case = [&](const char* what, const PlateCase& varied) {
    try_column(what, difference(model, varied, residuals, step));
  };
  try_case("a modulus that changes with the frequency", with_powers(c, step, 0.0));
  try_case("a loss factor that changes with the frequency", with_powers(c, 0.0, step));
  try_column("a factor on H1, as of a wrong calibration", of_measurement(fit, 1.0, 0.0, 0.0));
  try_column("a delay between the channels of H1", of_measurement(fit, 0.0, 1.0, 0.0));
  if (!fit.rises.empty()) {
    try_column("an offset of the temperatures", of_measurement(fit, 0.0, 0.0, 1.0));
    try_case("a modulus that changes with the temperature", with_slope(c, step));
    try_case("another level of the base's motion", with_level(c, 1.0 + step));
    try_case("cooling that is stronger or weaker everywhere", with_cooling(c, 1.0 + step));
  }
  std::ranges::sort(suspects, {}, &FitSuspect::rms);
  return suspects;
}

}  // namespace pfdm
