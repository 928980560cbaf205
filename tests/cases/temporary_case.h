#pragma once
// Case directories made for a test, and the program run on them in this process.

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace pfdm {

/// A small bar in tension of 10 steps, which breaks.
std::string bar_case();

/// [cohesive] with the plane in which that bar breaks, "crack".
std::string crack_plane();

/// [experiment] with the specimen "one": columns u [um] and f [kN] of data/one.csv.
std::string measured_specimen(const std::string& stiffness_between = "[\"1 um\", \"5 um\"]");

/// A mass on a soft sample, without its tests.
std::string soft_sample();

/// `text` with its one occurrence of `old_text` replaced; throws if it does not occur exactly once.
std::string replaced(std::string text, const std::string& old_text, const std::string& new_text);

/// The content of a file; empty if there is none.
std::string content_of(const std::filesystem::path& file);

/// A directory that goes away with the object.
class TemporaryCase {
 public:
  explicit TemporaryCase(const std::string& case_toml);
  ~TemporaryCase();
  TemporaryCase(const TemporaryCase&) = delete;
  TemporaryCase& operator=(const TemporaryCase&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path results() const { return path_ / "results"; }
  void write(const std::string& file, const std::string& content) const;

 private:
  std::filesystem::path path_;
};

struct Outcome {
  int status = 0;
  std::string out;
  std::string err;
};
Outcome run(const std::vector<std::string>& arguments);

/// One thing wrong with a case that is otherwise good.
struct BadInput {
  const char* name;
  const char* good;                  ///< what stands in the good case
  const char* bad;                   ///< what stands there instead
  std::vector<std::string> message;  ///< all of it has to be said
};
void PrintTo(const BadInput& input, std::ostream* stream);

/// Both `check` and `run` must end with status 2 and one line that holds the input's message, and leave no results.
void expect_refused(const TemporaryCase& directory, const BadInput& input);

}  // namespace pfdm
