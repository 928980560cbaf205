#include "postproc/fields/pvd.h"

#include "physics/error.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

namespace pfdm {
namespace {

constexpr std::string_view head =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
    "<Collection>\n";
constexpr std::string_view foot = "</Collection>\n</VTKFile>\n";
constexpr std::string_view row_start = "<DataSet timestep=\"";
constexpr std::string_view row_middle = "\" part=\"0\" file=\"";
constexpr std::string_view row_end = "\"/>";

std::optional<Frame> parse_row(std::string_view line) {
  const std::size_t middle = line.find(row_middle);
  if (!line.starts_with(row_start) || !line.ends_with(row_end) || middle == std::string_view::npos) return std::nullopt;
  const std::size_t file = middle + row_middle.size();
  const auto time = parse_double(line.substr(row_start.size(), middle - row_start.size()));
  if (!time || !std::isfinite(*time) || file + row_end.size() >= line.size()) return std::nullopt;
  return Frame{*time, std::string(line.substr(file, line.size() - row_end.size() - file))};
}

std::string row_of(const Frame& frame) {
  return fmt::format("{}{}{}{}{}\n", row_start, frame.time, row_middle, frame.file, row_end);
}

/// Whether this is the beginning of a row over a foot that has still its last byte: see GrowingFile.
bool is_begun(std::string_view rest) { return rest.size() > foot.size() && rest[foot.size() - 1] == '\n'; }

std::vector<Frame> frames_that(const std::function<bool(const Frame&)>& keeps, const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return {};
  std::vector<Frame> frames = read_pvd(path);
  std::erase_if(frames, std::not_fn(keeps));
  return frames;
}

}  // namespace

std::vector<Frame> read_pvd(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  std::string_view rest = content;
  const InputError no_list(fmt::format("{} is not a list of frames that this program wrote", path.string()));
  if (!rest.starts_with(head)) throw no_list;
  rest.remove_prefix(head.size());
  std::vector<Frame> frames;
  while (rest != foot && !is_begun(rest)) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    const auto frame = parse_row(line);
    if (!frame && !rest.ends_with(foot)) throw no_list;
    if (!frame) throw InputError(fmt::format("{}: \"{}\" is not a frame", path.string(), line));
    frames.push_back(*frame);
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
  }
  return frames;
}

PvdSeries::PvdSeries(std::filesystem::path path) : file_(std::move(path), head, foot) {}

PvdSeries::PvdSeries(std::filesystem::path path, const std::function<bool(const Frame&)>& keeps)
    : frames_(frames_that(keeps, path)), file_(std::move(path), text(), foot) {}

void PvdSeries::add(double time, const std::string& file) {
  frames_.push_back({time, file});
  file_.append(row_of(frames_.back()), [this] { return text(); });
}

std::string PvdSeries::text() const {
  std::string content(head);
  for (const Frame& frame : frames_) content += row_of(frame);
  return content;
}

}  // namespace pfdm
