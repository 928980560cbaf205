#include "cases/program/plate/plate_fit_model.h"

#include "physics/error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

namespace pfdm {
namespace {

constexpr double pi = std::numbers::pi;

// Linear between the steps.
double at_time(double time, const std::vector<double>& times, const std::vector<double>& values) {
  const auto above = std::ranges::lower_bound(times, time);
  if (above == times.begin()) return values.front();
  if (above == times.end()) return values.back();
  const auto i = static_cast<std::size_t>(above - times.begin());
  return std::lerp(values[i - 1], values[i], (time - times[i - 1]) / (times[i] - times[i - 1]));
}

std::vector<CaseParameter> parameters_of(const PlateFit& fit) {
  std::vector<CaseParameter> parameters;
  for (const CurveFitParameter& parameter : fit.parameters) parameters.push_back(parameter.in_case);
  return parameters;
}

}  // namespace

PlateModel::PlateModel(const CaseFile& file, const PlateFit& fit, const PlateCase& c, const Mesh& mesh)
    : file_(file), fit_(fit), parameters_(parameters_of(fit)), case_(c), run_(case_, mesh, 0) {}

PlateCase PlateModel::with(std::span<const double> values) const {
  const CaseFile varied = with_values(file_, parameters_, values);
  return read_plate_case(varied.config.root(), varied.directory);
}

std::optional<PlateCurves> PlateModel::curves(const PlateCase& c) {
  PlateCurves curves;
  try {
    case_ = c;
    run_.take(case_);
    for (const MeasuredResponse& response : fit_.responses)
      curves.H1.push_back(run_.transmissions(response.at, response.frequency));
    if (!fit_.rises.empty() && reads_as_usual()) curves.rise = rises();
  } catch (const InputError&) {
    return std::nullopt;
  } catch (const ComputationError&) {
    return std::nullopt;
  }
  return curves;
}

std::vector<std::vector<double>> PlateModel::rises() {
  std::vector<double> time, mean, largest;
  const double frequency =
      case_.excitation.type == "harmonic" ? run_.driving_frequency(case_.heating->surroundings) : 0.0;
  const auto add = [&](double at, const SurfaceTemperature& surface) {
    time.push_back(at);
    mean.push_back(surface.mean);
    largest.push_back(surface.largest);
  };
  if (case_.material.depends_on_temperature()) {
    run_.heat(frequency,
              [&](const HeatingRow& row, const HeatedBody&, const CellField<double>&) { add(row.time, row.surface); });
  } else {
    double step = 0.0;
    add(0.0, {});
    for (const SurfaceTemperature& surface : run_.steady_surface(frequency, step)) add(time.back() + step, surface);
  }
  std::vector<std::vector<double>> rises;
  for (const MeasuredRise& measured : fit_.rises) {
    rises.emplace_back();
    for (const double t : measured.time) rises.back().push_back(at_time(t, time, measured.is_largest ? largest : mean));
  }
  return rises;
}

std::optional<std::vector<double>> PlateModel::residuals(const PlateCase& c) {
  const auto computed = curves(c);
  if (!computed) return std::nullopt;
  std::vector<double> residuals;
  for (std::size_t k = 0; k < fit_.responses.size(); ++k) {
    const MeasuredResponse& measured = fit_.responses[k];
    std::vector<std::complex<double>> H1 = computed->H1[k];
    for (std::complex<double>& H : H1) {
      if (reading_.relative) H -= 1.0;
      if (reading_.conjugate) H = std::conj(H);
    }
    for (std::size_t i = 0; i < H1.size(); ++i)
      residuals.push_back(std::log(std::abs(H1[i]) / measured.magnitude[i]) / measured.deviation);
    for (std::size_t i = 0; i < measured.phase.size(); ++i)
      residuals.push_back(std::remainder(std::arg(H1[i]) - measured.phase[i], 2.0 * pi) / measured.deviation);
  }
  for (std::size_t k = 0; k < computed->rise.size(); ++k)
    for (std::size_t i = 0; i < computed->rise[k].size(); ++i)
      residuals.push_back((computed->rise[k][i] - fit_.rises[k].rise[i]) / fit_.rises[k].deviation);
  return residuals;
}

Residuals PlateModel::remembered_residuals() {
  using Known = std::map<std::vector<double>, std::optional<std::vector<double>>>;
  return [this, known = std::make_shared<Known>()](std::span<const double> values) {
    const std::vector<double> at(values.begin(), values.end());
    const auto found = known->find(at);
    return found != known->end() ? found->second : (*known)[at] = residuals(with(at));
  };
}

std::vector<ResidualSeries> PlateModel::series(const std::vector<double>& residuals) const {
  std::vector<ResidualSeries> all;
  auto next = residuals.begin();
  const auto add = [&](const std::string& name, const char* along, std::size_t n) {
    const auto end = next + n;
    all.push_back({.name = name, .along = along, .values = {next, end}});
    next = end;
  };
  for (const MeasuredResponse& measured : fit_.responses) {
    add(measured.name + ", magnitude", "frequency", measured.magnitude.size());
    if (!measured.phase.empty()) add(measured.name + ", phase", "frequency", measured.phase.size());
  }
  for (const MeasuredRise& measured : fit_.rises) add(measured.name, "time", measured.rise.size());
  return all;
}

}  // namespace pfdm
