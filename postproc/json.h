#pragma once
// What several of the JSON files hold.

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <limits>
#include <vector>

namespace pfdm {

/// A list of rows.
inline nlohmann::ordered_json to_json(const Eigen::MatrixXd& matrix) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& row : matrix.rowwise()) rows.push_back(std::vector<double>(row.begin(), row.end()));
  return rows;
}

/// Numbers that are not finite are written as null.
inline double number_of(const nlohmann::ordered_json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

}  // namespace pfdm
