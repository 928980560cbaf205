#include "mesh/files/gmsh_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <sstream>

namespace pfdm {
namespace {

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

std::string content_of(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw InputError(fmt::format("cannot read the mesh {}: it is a directory", path.string()));
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (!file || !(content << file.rdbuf()))
    throw InputError(
        fmt::format("cannot read the mesh {}: {}", path.string(), file ? "it is empty" : std::strerror(errno)));
  return std::move(content).str();
}

}  // namespace

GmshStream::GmshStream(const std::filesystem::path& path) : path_(path), content_(content_of(path)) {}

InputError GmshStream::error_in_file(const std::string& reason) const {
  return InputError(fmt::format("the mesh {}: {}", path_.string(), reason));
}

InputError GmshStream::error(const std::string& reason) const {
  const std::string where =
      binary_ ? fmt::format("at byte {}", at_)
              : fmt::format("in line {}",
                            1 + std::count(content_.begin(), content_.begin() + static_cast<long>(at_), '\n'));
  return error_in_file(fmt::format("{}{}: {}", section_.empty() ? "" : "in $" + section_ + " ", where, reason));
}

InputError GmshStream::ends_early() const { return error_in_file(fmt::format("it ends within ${}", section_)); }

void GmshStream::skip_space() {
  while (at_ < content_.size() && is_space(content_[at_])) ++at_;
}

std::string GmshStream::next_section() {
  section_.clear();
  skip_space();
  if (at_ == content_.size()) return "";
  if (content_[at_] != '$') throw error("expected a section, as $Nodes");
  const std::size_t begin = ++at_;
  while (at_ < content_.size() && !is_space(content_[at_])) ++at_;
  section_ = content_.substr(begin, at_ - begin);
  end_line();  // binary numbers begin behind it
  return section_;
}

void GmshStream::end_section(bool skips) {
  const std::string mark = "$End" + section_;
  skip_space();
  const std::size_t end = content_.find(mark, at_);
  if (end == std::string::npos) throw ends_early();
  if (end != at_ && !skips) throw error(fmt::format("expected {}", mark));
  at_ = end + mark.size();
}

void GmshStream::end_line() {
  while (at_ < content_.size() && content_[at_] != '\n') ++at_;
  if (at_ < content_.size()) ++at_;
}

std::string GmshStream::quoted() {
  skip_space();
  const std::size_t end = at_ < content_.size() ? content_.find('"', at_ + 1) : std::string::npos;
  if (end == std::string::npos) throw ends_early();
  if (content_[at_] != '"') throw error("expected a name in quotes");
  std::string name = content_.substr(at_ + 1, end - at_ - 1);
  at_ = end + 1;
  return name;
}

template <class T>
T GmshStream::raw() {
  if (content_.size() - at_ < sizeof(T)) throw ends_early();
  T value;
  std::memcpy(&value, content_.data() + at_, sizeof(T));
  at_ += sizeof(T);
  return value;
}

template <class T>
T GmshStream::parse(std::string_view what) {
  skip_space();
  if (at_ == content_.size()) throw ends_early();
  T value{};
  const char* const end = content_.data() + content_.size();
  const auto [next, status] = std::from_chars(content_.data() + at_, end, value);
  if (status != std::errc() || (next != end && !is_space(*next))) {
    const std::size_t rest = std::min<std::size_t>(20, content_.size() - at_);
    const std::string_view found = std::string_view(content_).substr(at_, rest);
    throw error(fmt::format("expected {}, found \"{}\"", what, found.substr(0, found.find_first_of(" \r\n"))));
  }
  at_ = static_cast<std::size_t>(next - content_.data());
  return value;
}

template int GmshStream::raw<int>();
template double GmshStream::raw<double>();
template std::uint64_t GmshStream::raw<std::uint64_t>();
template int GmshStream::parse<int>(std::string_view);
template double GmshStream::parse<double>(std::string_view);
template std::uint64_t GmshStream::parse<std::uint64_t>(std::string_view);

}  // namespace pfdm
