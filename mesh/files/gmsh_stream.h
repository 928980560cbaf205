#pragma once
// The text and the binary numbers of a Gmsh file, one after the other.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "physics/error.h"

namespace pfdm {

/// All functions throw InputError that names the file, the place in it and what was expected.
class GmshStream {
 public:
  explicit GmshStream(const std::filesystem::path& path);

  /// Numbers from now on: int 4 bytes, std::uint64_t and double 8 bytes of this machine's order, or else text.
  void set_binary(bool binary) { binary_ = binary; }
  bool is_binary() const { return binary_; }

  /// The name of the next section, as "Nodes" of $Nodes; empty at the end of the file.
  std::string next_section();
  /// Past $End of the section that was begun last: at once, or, if `skips`, over what is in between.
  void end_section(bool skips = false);

  int integer() { return read<int>("a whole number"); }
  std::uint64_t count() { return read<std::uint64_t>("a count"); }
  double real() { return read<double>("a number"); }
  std::string quoted();  ///< "..." without the quotes
  /// Text even in a binary file: counts of the format 2.2, the version.
  int integer_as_text() { return parse<int>("a whole number"); }
  double real_as_text() { return parse<double>("a number"); }
  void end_line();  ///< the rest of the line

  InputError error(const std::string& reason) const;          ///< with the path and the place
  InputError error_in_file(const std::string& reason) const;  ///< with the path alone

 private:
  template <class T>
  T read(std::string_view what) {
    return binary_ ? raw<T>() : parse<T>(what);
  }
  template <class T>
  T raw();
  template <class T>
  T parse(std::string_view what);
  void skip_space();
  InputError ends_early() const;

  std::filesystem::path path_;
  std::string content_;
  std::string section_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

}  // namespace pfdm
