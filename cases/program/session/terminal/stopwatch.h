#pragma once
// Wall-clock time since the object was made, and words of it.

#include <fmt/format.h>

#include <chrono>
#include <string>

namespace pfdm {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count(); }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

/// "74 s", "12 min"
inline std::string duration_words(double seconds) {
  if (seconds < 10.0) return fmt::format("{:.2g} s", seconds);
  return seconds < 600.0 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.0f} min", seconds / 60.0);
}

}  // namespace pfdm
