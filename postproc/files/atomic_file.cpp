#include "postproc/files/atomic_file.h"

#include "physics/error.h"
#include "postproc/files/descriptor.h"
#include "postproc/files/flush.h"
#include "postproc/files/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view partial = ".partial";

// Leaves no temporary file behind, whatever happens.
struct TemporaryFile {
  fs::path path;  // empty once it has been renamed: the name may be another's by then
  Descriptor file;
  TemporaryFile(fs::path p, Descriptor f) : path(std::move(p)), file(std::move(f)) {}
  ~TemporaryFile() {
    if (!path.empty()) ::unlink(path.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
};

// Under a name that nothing has: neither another process's file nor a link, whose target it would overwrite.
TemporaryFile temporary_beside(const fs::path& path) {
  for (int attempt = 0;; ++attempt) {
    const std::string name = fmt::format(".{}.{}_{}{}", path.filename().string(), ::getpid(), attempt, partial);
    const fs::path temporary = path.parent_path() / name;
    const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd >= 0) return {temporary, Descriptor(fd)};
    if (errno != EEXIST) throw_cannot_write(path, errno);
  }
}

void rename_into_place(TemporaryFile& temporary, const fs::path& path) {
  if (::rename(temporary.path.c_str(), path.c_str()) != 0) throw_cannot_write(path, errno);
  temporary.path.clear();
  flush_when_due(path);
}

}  // namespace

void throw_cannot_write(const fs::path& path, int reason) {
  throw ComputationError(fmt::format("cannot write {}: {}", path.string(), std::generic_category().message(reason)));
}

void write_file(const fs::path& path, std::string_view content) {
  TemporaryFile temporary = temporary_beside(path);
  detail::write_all(temporary.file.get(), content, path);
  temporary.file.close(path);
  rename_into_place(temporary, path);
}

void replace_file(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  TemporaryFile temporary = temporary_beside(path);
  write(temporary.path);
  rename_into_place(temporary, path);
}

void move_file(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) == 0) return flush_when_due(to);
  if (errno != EXDEV) throw_cannot_write(to, errno);
  write_file(to, read_file(from));
  ::unlink(from.c_str());
}

bool is_partial_name(std::string_view name) {
  if (name == waiting_folder) return true;
  if (!name.starts_with('.') || !name.ends_with(partial)) return false;
  name.remove_suffix(partial.size());
  for (const char before : {'_', '.'}) {  // attempt, process
    const std::size_t end = name.find_last_not_of("0123456789");
    if (end == 0 || end == std::string_view::npos || end + 1 == name.size() || name[end] != before) return false;
    name = name.substr(0, end);
  }
  return name.size() > 1;
}

void remove_leftovers(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (is_partial_name(name)) fs::remove_all(entry.path(), ignored);
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw ComputationError(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
}

namespace detail {

void write_all(int descriptor, std::string_view content, const fs::path& path) {
  while (!content.empty()) {
    const ssize_t n = ::write(descriptor, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw_cannot_write(path, errno);
    content.remove_prefix(n);
  }
}

}  // namespace detail
}  // namespace pfdm
