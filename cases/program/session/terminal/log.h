#pragma once
// What the program says while it works: to the console and to run.log. The only place that knows spdlog.

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace pfdm {

class Log {
 public:
  /// On a terminal progress is redrawn in place. `quiet` silences the console, not the file; warnings then go to
  /// `errors`.
  Log(std::ostream& console, std::ostream& errors, bool terminal, bool quiet);
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  /// One with another file, or none, for the same console.
  std::unique_ptr<Log> with_own_file() const;

  /// Everything goes to this file too, what was said so far as well. Where `file` is a link, it is replaced. Throws
  /// ComputationError if it cannot be written.
  void open_file(const std::filesystem::path& file, bool append);

  void say(const std::string& message);
  /// Each line of a text.
  void say_lines(const std::string& text, const std::string& indent = "");
  void warn(const std::string& message);
  /// What was warned of so far, each once.
  const std::vector<std::string>& warnings() const;
  /// A step of long work is done: `line` goes to the file, and to a console that is no terminal.
  void step(const std::string& line);
  /// Shown in the terminal's last line until something else is said; no more of it than fits.
  void progress(const std::string& line);
  /// That a progress line may have; the terminal's width is not, lest the line wraps.
  int columns() const;
  /// To the file alone.
  void record(const std::string& message) { to_file(message); }

 private:
  struct Sinks;
  void to_file(const std::string& message);
  void clear_progress();
  std::unique_ptr<Sinks> sinks_;
};

}  // namespace pfdm
