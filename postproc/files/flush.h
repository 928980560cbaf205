#pragma once
// Flushing of written files to the disk. A file that was renamed into its place is safe from the end of this process,
// however that comes; only from a loss of power it is not, until the system has written it out. Waiting for each file
// would cost short runs most of their time: it is done as often as a fiftieth of the time allows.

#include <chrono>
#include <filesystem>

namespace pfdm {

/// Shares time between work and waiting for the disk.
class FlushBudget {
 public:
  using Duration = std::chrono::duration<double>;

  /// `elapsed`: time since the start, of work and waiting.
  bool is_due(Duration elapsed) const { return waited_ <= share * elapsed; }
  void add(Duration waited) { waited_ += waited; }

  static constexpr double share = 0.02;

 private:
  Duration waited_{0.0};
};

/// Tells of a file that has just been renamed into its place, or moved there. It and what else waits is flushed now,
/// in the order in which it was written, if the budget of this process allows. Safe to call from several threads.
/// Throws ComputationError that names the file the disk refuses.
void flush_when_due(const std::filesystem::path& file);

/// Flushes all that waits, whatever it costs: before earlier results are removed, and at the end of the program.
/// Files and folders that are gone are passed over. Throws as flush_when_due() does.
void flush_written_files();

}  // namespace pfdm
