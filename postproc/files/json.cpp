#include "postproc/files/json.h"

#include <cstddef>

namespace pfdm {

nlohmann::ordered_json parse_json(std::string_view text) {
  constexpr std::size_t most_keys = 10000, deepest = 100;
  std::vector<std::size_t> n_keys(1, 0);  // of the objects around the place that is read
  using Event = nlohmann::ordered_json::parse_event_t;
  const auto look = [&](int, Event event, nlohmann::ordered_json&) {
    if (event == Event::object_start || event == Event::array_start) n_keys.push_back(0);
    if (event == Event::object_end || event == Event::array_end) n_keys.pop_back();
    if (n_keys.size() > deepest) throw JsonTooLarge(fmt::format("it has more than {} levels", deepest));
    if (event == Event::key && ++n_keys.back() > most_keys)
      throw JsonTooLarge(fmt::format("it has an object of more than {} keys", most_keys));
    return true;
  };
  return nlohmann::ordered_json::parse(text, look);
}

std::string json_fault(const nlohmann::ordered_json::exception& error) {
  const std::string_view text = error.what();
  const std::size_t end = text.starts_with('[') ? text.find("] ") : std::string_view::npos;
  return std::string(end == std::string_view::npos ? text : text.substr(end + 2));
}

}  // namespace pfdm
