#pragma once
// Results that are to take the place of earlier ones: they are written beside them first, so that a run that comes to
// nothing (no convergence, a full disk, Ctrl-C) leaves the earlier ones as they were.

#include <filesystem>
#include <functional>
#include <string_view>

namespace pfdm {

class NewResults {
 public:
  /// The caller holds the FolderLock of `results`. With `earlier`, what is there stays until take_place(), and the new
  /// files gather in a folder within, in place of one that a killed run left there; without, they go where they belong
  /// at once. Throws ComputationError, as take_place() does.
  NewResults(std::filesystem::path results, bool earlier);
  /// New files that did not take their place go away.
  ~NewResults();
  NewResults(const NewResults&) = delete;
  NewResults& operator=(const NewResults&) = delete;

  /// Where to write now.
  const std::filesystem::path& folder() const { return folder_; }
  bool wait() const { return folder_ != results_; }
  /// Calls `remove_earlier` and moves the new files into the results; the one called `last`, with which they count as
  /// results, after all others. Does nothing where they do not wait.
  void take_place(const std::function<void()>& remove_earlier, std::string_view last);

 private:
  std::filesystem::path results_;
  std::filesystem::path folder_;
};

}  // namespace pfdm
