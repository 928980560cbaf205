// Which parameter of a fit moves which part of the curve: the derivatives at the estimates, as changes of the force.

#include "cases/program/studies/fit/curve_fit_at_work.h"
#include "physics/quantity_text.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr const char* sensitivity_file = "fit_sensitivity.csv";
constexpr double share = 0.01;

/// By which a parameter is moved: a hundredth of it; of one that may be zero or negative its standard error, or where
/// that is not known a hundredth of its first guess, which scales it.
struct Move {
  double by = 0.0;  ///< in what is fitted: its logarithm on a logarithmic scale
  std::string told;
};

Move move_of(const FittedParameter& p, double standard_error) {
  if (p.log_scale) return {share, fmt::format("+{:g} % of {}", 100.0 * share, p.name)};
  const bool is_known = standard_error > 0.0 && std::isfinite(standard_error);
  const double by = is_known ? standard_error : share * std::max(std::abs(p.first_guess), std::abs(p.estimate));
  return {by, fmt::format("{} + {}", p.name, quantity_text(by, p.unit))};
}

/// A sentence for each figure of an event that counts: how far it moves with each of the parameters. Their derivatives
/// are behind those of the points.
std::vector<std::string> changes_of_events(const MeasuredPoints& points, const Eigen::MatrixXd& derivatives,
                                           const std::vector<Move>& moves) {
  std::vector<std::string> sentences;
  auto row = std::ssize(points.points);
  for_each_datum(points.events, [&](const MeasuredEvent& event, const MeasuredFigure& figure) {
    std::vector<std::string> changes;
    for (std::size_t k = 0; k < moves.size(); ++k) {
      const double change = moves[k].by * figure.deviation * derivatives(row, static_cast<Eigen::Index>(k));
      changes.push_back(fmt::format("{} with {}", quantity_text(change, unit_of(figure.figure), 3), moves[k].told));
    }
    sentences.push_back(
        fmt::format("{} of {} changes by {}", name_of(figure.figure), event.name(), fmt::join(changes, ", by ")));
    ++row;
  });
  return sentences;
}

}  // namespace

std::string CurveFit::add_sensitivity(const DoneStage& done, const FitFindings& found) {
  CsvTable table;
  table.comments.push_back(fmt::format(
      "fit of {}: by how much the computed force changes at the measured points of the first specimen, with",
      job_.name));
  std::vector<double> x;
  for (const MeasuredPoints::Point& point : done.points.points)
    if (point.specimen == 0) x.push_back(point.x);
  if (x.empty()) return "";
  table.add("displacement_m", x);
  std::vector<Move> moves;
  for (std::size_t k = 0; k < found.parameters.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    moves.push_back(move_of(found.parameters[k], std::sqrt(done.result.covariance(column, column))));
  }
  for (std::string& sentence : changes_of_events(done.points, done.result.derivatives, moves))
    table.comments.push_back(std::move(sentence));
  for (std::size_t k = 0; k < found.parameters.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const Move& move = moves[k];
    table.comments.push_back(move.told);
    std::vector<double> changes;
    for (Eigen::Index i = 0; i < std::ssize(done.points.points); ++i) {
      const MeasuredPoints::Point& point = done.points.points[i];
      if (point.specimen == 0)
        changes.push_back(move.by * done.points.scale(point) * done.result.derivatives(i, column));
    }
    table.add(fmt::format("change_by_{}_N", k), std::move(changes));
  }
  tables_[sensitivity_file] = std::move(table);
  return sensitivity_file;
}

}  // namespace pfdm
