#pragma once
// What the targets of fuzzing share: the input as a file that a reader opens, and what a reader may do with it.

#include "physics/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <string_view>

namespace pfdm::fuzzing {

/// A folder of this process, which goes away at its end.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pfdm_fuzz_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) std::abort();
    path_ = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes the input into a file of this name and returns its path. The file is the same at each call.
inline std::filesystem::path file_of(std::string_view input, const char* name) {
  static const Folder folder;
  std::filesystem::path path = folder.path() / name;
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(input.data(), static_cast<std::streamsize>(input.size()));
  return path;
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Takes a byte off the front, which decides how the rest is read; 0 of an empty input.
inline unsigned take_choice(std::string_view& input) {
  if (input.empty()) return 0;
  const auto choice = static_cast<unsigned char>(input.front());
  input.remove_prefix(1);
  return choice;
}

/// Ends the process, which is how libFuzzer learns of a fault.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Whether `read` comes to its end. An input may be refused by InputError; whatever else is thrown ends the process.
template <class Read>
bool is_read(const Read& read) {
  try {
    read();
    return true;
  } catch (const InputError& error) {
    require(*error.what() != '\0');
    return false;
  }
}

/// Likewise of what is read in a process of its own, which may lack memory (physics/system/separate_process).
template <class Read>
bool is_read_apart(const Read& read) {
  try {
    return is_read(read);
  } catch (const std::bad_alloc&) {
    return false;
  }
}

}  // namespace pfdm::fuzzing
