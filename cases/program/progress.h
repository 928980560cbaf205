#pragma once
// How far a fracture run is: a bar on a terminal, a line per step elsewhere.

#include "cases/program/log.h"
#include "solver/fracture_run.h"

#include <chrono>

namespace pfdm {

class Progress {
 public:
  /// `start` and `end` are values of the load parameter.
  Progress(Log& log, double start, double end);
  void iterated(const IterationReport& iteration);
  /// displacement [m] and force [N] of the curve.
  void step_done(const StepReport& step, double displacement, double force);

 private:
  using Clock = std::chrono::steady_clock;
  double seconds() const;
  std::string time_left(double load) const;
  void draw(double load, const std::string& doing);

  Log& log_;
  double start_;
  double end_;
  double load_;
  double damaged_volume_ = 0.0;
  Clock::time_point began_ = Clock::now();
  Clock::time_point drawn_;
};

}  // namespace pfdm
