#include "postproc/files/new_results.h"

#include "postproc/files/atomic_file.h"
#include "postproc/files/flush.h"

#include <system_error>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  return entries;
}

/// Folders that are there already get what the new ones hold.
void move_entries(const fs::path& from, const fs::path& to, std::string_view but_for) {
  for (const fs::path& entry : entries_of(from)) {
    const fs::path target = to / entry.filename();
    if (entry.filename() == but_for) continue;
    if (fs::is_directory(entry)) {
      make_folder(target);
      move_entries(entry, target, "");
    } else {
      move_file(entry, target);
    }
  }
}

}  // namespace

NewResults::NewResults(fs::path results, bool earlier) : results_(std::move(results)), folder_(results_) {
  remove_leftovers(results_);
  if (!earlier) return;
  folder_ = results_ / waiting_folder;
  make_folder(folder_);
}

NewResults::~NewResults() {
  std::error_code ignored;
  if (wait()) fs::remove_all(folder_, ignored);
}

void NewResults::take_place(const std::function<void()>& remove_earlier, std::string_view last) {
  if (!wait()) return;
  flush_written_files();
  remove_earlier();
  move_entries(folder_, results_, last);
  if (fs::exists(folder_ / last)) move_file(folder_ / last, results_ / last);
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  folder_ = results_;
}

}  // namespace pfdm
