#include "postproc/files/text_file.h"

#include "physics/error.h"

#include <fmt/format.h>
#include <unistd.h>

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

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw InputError(fmt::format("cannot read {}: {}", path.string(), reason));
}

std::string message(int reason) { return std::generic_category().message(reason); }

}  // namespace

void require_file(const std::filesystem::path& path) {
  using std::filesystem::file_type;
  std::error_code error;
  const file_type type = std::filesystem::status(path, error).type();
  if (type == file_type::directory) refuse(path, "it is a directory, not a file");
  if (type == file_type::fifo) refuse(path, "it is a named pipe, not a file");
  if (type == file_type::not_found) refuse(path, message(ENOENT));
  if (error) refuse(path, error.message());
  if (type != file_type::regular) refuse(path, "it is not a regular file");
  if (::access(path.c_str(), R_OK) != 0) refuse(path, message(errno));
}

std::string read_file(const std::filesystem::path& path) {
  require_file(path);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string content;
  if (in) content.assign(std::istreambuf_iterator<char>(in), {});
  if (!in) refuse(path, message(errno != 0 ? errno : EIO));
  return content;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view take_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  const std::string_view line = trimmed(rest.substr(0, end));
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return line;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::optional<double> parse_double(std::string_view text) { return parse<double>(text); }
std::optional<int> parse_int(std::string_view text) { return parse<int>(text); }

}  // namespace pfdm
