#pragma once
// CPU seconds of this process by stage of the work.

#include <ctime>
#include <map>
#include <string>

namespace pfdm {

class StageClock {
 public:
  /// Counts the CPU time of all threads until the end of its scope.
  class Lap {
   public:
    Lap(StageClock& clock, const char* stage) : clock_(clock), stage_(stage), start_(std::clock()) {}
    ~Lap() { clock_.seconds_[stage_] += double(std::clock() - start_) / CLOCKS_PER_SEC; }
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;

   private:
    StageClock& clock_;
    const char* stage_;
    std::clock_t start_;
  };

  Lap lap(const char* stage) { return {*this, stage}; }
  const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  std::map<std::string, double> seconds_;
};

}  // namespace pfdm
