#pragma once
// What several of the JSON files hold, and how they are read.

#include "physics/error.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
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

/// Beyond what this program writes.
struct JsonTooLarge : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A whole number that its type holds. Throws JsonTooLarge for another number, as nlohmann's library does for a text.
template <class Integer>
Integer whole_number(const nlohmann::ordered_json& json) {
  const auto number = json.get<double>();
  constexpr double beyond = 2.0 * (static_cast<double>(std::numeric_limits<Integer>::max() / 2) + 1.0);
  constexpr auto least = static_cast<double>(std::numeric_limits<Integer>::min());
  if (!(number >= least && number < beyond) || number != std::trunc(number))
    throw JsonTooLarge(fmt::format("{} is not a whole number of at least {} and less than {}", number, least, beyond));
  return json.get<Integer>();
}

/// The text of a JSON file. Bytes that are no UTF-8, as of a folder named in Latin-1, become the replacement character.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}
/// Likewise on one line.
inline std::string json_line(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// The text as JSON. Throws as nlohmann's parser does; JsonTooLarge for more than 10,000 keys in an object, which looks
/// them up one after the other, and more than 100 objects and lists within each other.
nlohmann::ordered_json parse_json(std::string_view text);

/// What `error` says, without the words by which nlohmann's library calls its kinds.
std::string json_fault(const nlohmann::ordered_json::exception& error);

/// What `take` makes of the file's content. Throws InputError that names the file for what is no `what`, as in "fit".
template <class Take>
auto read_json(const std::filesystem::path& path, std::string_view what, const Take& take) {
  try {
    return take(parse_json(read_file(path)));
  } catch (const nlohmann::ordered_json::exception& error) {
    throw InputError(fmt::format("{}: this is not a {}: {}", path.string(), what, json_fault(error)));
  } catch (const JsonTooLarge& error) {
    throw InputError(fmt::format("{}: this is not a {}: {}", path.string(), what, error.what()));
  }
}

}  // namespace pfdm
