#pragma once
// Results files are written whole or not at all: into a temporary file of the same folder, renamed when it is whole.
// When it reaches the disk, flush.h says. A file that is a link is replaced by a file; what it points to stays as it
// is.

#include <filesystem>
#include <functional>
#include <string_view>

namespace pfdm {

/// The file holds exactly `content` afterwards. Throws ComputationError that names the file and the reason (disk full,
/// no permission); what the file held before is then untouched and no temporary file stays.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Likewise, for libraries that insist on opening files themselves: `write` makes the temporary file it is given.
/// What `write` throws is passed on.
void replace_file(const std::filesystem::path& path,
                  const std::function<void(const std::filesystem::path& temporary)>& write);

/// Renames a file, whole or not at all, also onto another disk. Throws ComputationError that names `to`.
void move_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Where a run writes while earlier results stay (new_results.h): within their folder.
inline constexpr std::string_view waiting_folder = ".new.partial";

/// Whether a temporary file of this program may be called so: .NAME.PROCESS_ATTEMPT.partial or the waiting folder.
bool is_partial_name(std::string_view name);

/// Removes what killed runs left in a folder: all with such names. Nobody else may be writing there.
void remove_leftovers(const std::filesystem::path& folder);

/// Makes a folder and those above it; throws ComputationError where that cannot be.
void make_folder(const std::filesystem::path& folder);

namespace detail {
/// Writes all of `content` to an open file; `path` is for the message of the ComputationError.
void write_all(int descriptor, std::string_view content, const std::filesystem::path& path);
}  // namespace detail

}  // namespace pfdm
