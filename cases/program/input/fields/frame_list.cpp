#include "cases/program/input/fields/frame_list.h"

#include "physics/error.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace pfdm {
namespace {

/// The value of name="value" among the attributes of an element.
std::optional<std::string> attribute(std::string_view element, std::string_view name) {
  for (const char quote : {'"', '\''}) {
    const std::string start = fmt::format(" {}={}", name, quote);
    const std::size_t at = element.find(start);
    if (at == std::string_view::npos) continue;
    const std::string_view rest = element.substr(at + start.size());
    return std::string(rest.substr(0, rest.find(quote)));
  }
  return std::nullopt;
}

}  // namespace

std::vector<ListedFrame> read_frame_list(const std::filesystem::path& path) {
  constexpr std::string_view element = "<DataSet";
  std::string content = read_file(path);
  std::ranges::replace_if(
      content, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  const auto wrong = [&](std::string_view what) {
    return InputError(fmt::format("the list of frames {}: {}", path.string(), what));
  };
  std::vector<ListedFrame> frames;
  std::string_view rest = content;
  for (std::size_t at = rest.find(element); at != std::string_view::npos; at = rest.find(element)) {
    rest.remove_prefix(at);
    const std::string_view one = rest.substr(0, rest.find('>'));
    const auto time = attribute(one, "timestep"), file = attribute(one, "file");
    const auto number = time ? parse_double(*time) : std::nullopt;
    if (time && !(number && std::isfinite(*number)))
      throw wrong(fmt::format("the timestep of its frame {} is \"{}\"; expected a number", frames.size() + 1, *time));
    if (!time || !file) throw wrong(fmt::format("its frame {} lacks a timestep or a file", frames.size() + 1));
    frames.push_back({*number, path.parent_path() / *file});
    rest.remove_prefix(element.size());
  }
  if (frames.empty()) throw wrong("it has no frames");
  std::ranges::stable_sort(frames, {}, &ListedFrame::time);
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (!(frames[i - 1].time < frames[i].time)) throw wrong(fmt::format("two frames have the time {}", frames[i].time));
  return frames;
}

}  // namespace pfdm
