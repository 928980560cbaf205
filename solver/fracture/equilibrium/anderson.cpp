#include "solver/fracture/equilibrium/anderson.h"

#include "solver/linear/dense_algebra.h"

#include <algorithm>

namespace pfdm {
namespace {

constexpr std::size_t most_iterates = 7;

Eigen::Map<const Eigen::VectorXd> as_vector(const CellField<double>& field) {
  return {field.values().data(), static_cast<Eigen::Index>(field.values().size())};
}

}  // namespace

CellField<double> AndersonMixing::next(const CellField<double>& d, const CellField<double>& answer,
                                       const CellField<double>& lower) {
  Iterate last{.d = as_vector(d), .increment = as_vector(answer) - as_vector(d)};
  Eigen::VectorXd step = last.increment;
  if (const auto m = static_cast<Eigen::Index>(iterates_.size()); m > 0) {
    Eigen::MatrixXd change_of_d(step.size(), m), change_of_increment(step.size(), m);
    for (Eigen::Index j = 0; j < m; ++j) {
      const Iterate& before = iterates_[j];
      change_of_d.col(j) = last.d - before.d;
      change_of_increment.col(j) = last.increment - before.increment;
    }
    const Eigen::VectorXd weight = least_squares(change_of_increment, last.increment);
    step -= (change_of_d + change_of_increment) * weight;
  }
  CellField<double> result(d.size());
  for (Index c = 0; c < d.size(); ++c) result[c] = std::clamp(d[c] + step[c], lower[c], 1.0);
  iterates_.push_back(std::move(last));
  if (iterates_.size() == most_iterates) iterates_.pop_front();
  return result;
}

}  // namespace pfdm
