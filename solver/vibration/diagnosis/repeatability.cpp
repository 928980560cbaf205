#include "solver/vibration/diagnosis/repeatability.h"

#include "physics/point/mass_material.h"
#include "solver/calibration/calibration_statistics.h"
#include "solver/linear/dense_algebra.h"

#include <Eigen/Core>

#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace pfdm {
namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Column {
  std::string name;
  std::string what;
  VectorXd values;  // less their mean
};

/// Of what varied.
std::vector<Column> columns_of(std::span<const ScheduledRun> schedule) {
  std::vector<Column> columns;
  const auto add = [&](std::string name, std::string what, const auto& get) {
    VectorXd values(static_cast<Eigen::Index>(schedule.size()));
    for (std::size_t i = 0; i < schedule.size(); ++i) values[i] = get(schedule[i]);
    const double largest = values.lpNorm<Eigen::Infinity>();
    values.array() -= values.mean();
    if (values.lpNorm<Eigen::Infinity>() > 1e-9 * largest)
      columns.push_back({std::move(name), std::move(what), std::move(values)});
  };
  add("per_g0", "level", [](const ScheduledRun& s) { return s.level_in_g0(); });
  add("per_day", "age", [](const ScheduledRun& s) { return s.age_in_days(); });
  add("per_run", "run", [](const ScheduledRun& s) { return static_cast<double>(s.run); });
  return columns;
}

/// A column of ones, then those of what varied.
MatrixXd design(const std::vector<Column>& columns, std::size_t n) {
  MatrixXd A = MatrixXd::Ones(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(columns.size()) + 1);
  for (std::size_t k = 0; k < columns.size(); ++k) A.col(k + 1) = columns[k].values;
  return A;
}

void add_repeat_deviation(std::span<const ScheduledRun> schedule, std::span<const double> values, Repeatability& r) {
  std::map<std::pair<double, long>, std::vector<double>> cells;
  for (std::size_t i = 0; i < values.size(); ++i) cells[{schedule[i].level, schedule[i].day()}].push_back(values[i]);
  double sum = 0.0;
  for (const auto& [cell, repeats] : cells) {
    double mean = 0.0;
    for (const double v : repeats) mean += v / static_cast<double>(repeats.size());
    for (const double v : repeats) sum += (v - mean) * (v - mean);
    r.repeat_freedom += static_cast<int>(repeats.size()) - 1;
  }
  if (r.repeat_freedom > 0) r.repeat_deviation = std::sqrt(sum / r.repeat_freedom);
}

}  // namespace

double ScheduledRun::level_in_g0() const { return level / standard_gravity; }

double ScheduledRun::age_in_days() const { return age / 86400.0; }

long ScheduledRun::day() const { return std::lround(std::floor(age_in_days() + 1e-9)); }

std::optional<std::string> confounded(std::span<const ScheduledRun> schedule) {
  const std::vector<Column> columns = columns_of(schedule);
  MatrixXd A = design(columns, schedule.size());
  A.colwise().normalize();
  if (rank(A, 1e-6) == A.cols()) return std::nullopt;
  std::string names;
  for (const Column& c : columns) names += (names.empty() ? "" : ", ") + c.what;
  return names;
}

Repeatability repeatability(std::span<const ScheduledRun> schedule, std::span<const double> values) {
  assert(schedule.size() == values.size() && !values.empty());
  const std::vector<Column> columns = columns_of(schedule);
  const MatrixXd A = design(columns, values.size());
  const auto y = Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  const VectorXd x = least_squares(A, y);
  Repeatability result;
  result.mean = x[0];
  result.residual_freedom = static_cast<int>(A.rows() - A.cols());
  const double none = std::numeric_limits<double>::quiet_NaN();
  result.residual_deviation =
      result.residual_freedom > 0 ? std::sqrt((y - A * x).squaredNorm() / result.residual_freedom) : none;
  const SingularValues svd = singular_values(A);
  const VectorXd variance =
      (svd.V * svd.values.cwiseInverse().asDiagonal()).rowwise().squaredNorm();  // diag (A^T A)^-1
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const Eigen::Index i = static_cast<Eigen::Index>(k) + 1;
    const double half = result.residual_freedom > 0
                            ? student_95(result.residual_freedom) * result.residual_deviation * std::sqrt(variance[i])
                            : none;
    result.effects.push_back({columns[k].name, x[i], x[i] - half, x[i] + half});
  }
  add_repeat_deviation(schedule, values, result);
  return result;
}

}  // namespace pfdm
