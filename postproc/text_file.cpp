#include "postproc/text_file.h"

#include "physics/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <fstream>
#include <iterator>
#include <system_error>

namespace pfdm {
namespace {

template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string content;
  if (in) content.assign(std::istreambuf_iterator<char>(in), {});
  if (!in || std::filesystem::is_directory(path))
    throw InputError(
        fmt::format("cannot read {}: {}", path.string(), std::generic_category().message(errno != 0 ? errno : EIO)));
  return content;
}

std::optional<double> parse_double(std::string_view text) { return parse<double>(text); }
std::optional<int> parse_int(std::string_view text) { return parse<int>(text); }

}  // namespace pfdm
