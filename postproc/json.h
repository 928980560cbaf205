#pragma once
// What several of the JSON files hold.

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <vector>

namespace pfdm {

/// A list of rows.
inline nlohmann::ordered_json to_json(const Eigen::MatrixXd& matrix) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& row : matrix.rowwise()) rows.push_back(std::vector<double>(row.begin(), row.end()));
  return rows;
}

}  // namespace pfdm
