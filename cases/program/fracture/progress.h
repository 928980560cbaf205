#pragma once
// How far a fracture run is: a line that is redrawn on a terminal, a line per step elsewhere.

#include "cases/program/session/log.h"
#include "solver/fracture/fracture_run.h"

#include <chrono>
#include <optional>

namespace pfdm {

/// How long a run still takes: an iteration as long as those so far, what is left of the load as many iterations as
/// what has been done of it.
class TimeLeft {
 public:
  /// Values of the load parameter.
  TimeLeft(double start, double end) : start_(start), end_(end), furthest_(start) {}
  /// An iteration of a step that leads to `load`, the how many-th of its step.
  void iterated(Index iteration, double load);
  void step_done(double load);
  /// [s], `elapsed` since the start; none while no step is done, or where the load has fallen back.
  std::optional<double> seconds(double elapsed) const;

 private:
  double start_, end_;
  double furthest_;                // load
  double load_ = 0.0;              // of the present step, or of the last one if that is done
  double before_ = 0.0, now_ = 0;  // iterations: all but those of the present step, and those
  double steps_ = 0.0;             // that took iterations
};

struct ProgressFigures {
  double load = 0.0, end = 1.0;  ///< parameter
  double share = 0.0;            ///< of the load that is done
  double damaged_volume = 0.0;   ///< [m^3]
  Index step = 0, iteration = 0;
  std::optional<double> seconds_left{};
};

/// In at most so many columns: what is least important goes first.
std::string progress_line(const ProgressFigures& figures, int columns);

class RunProgress {
 public:
  /// `start` and `end` are values of the load parameter.
  RunProgress(Log& log, double start, double end);
  void iterated(const IterationReport& iteration);
  /// displacement [m] and force [N] of the curve.
  void step_done(const StepReport& step, double displacement, double force);

 private:
  using Clock = std::chrono::steady_clock;
  double seconds() const;
  void draw(double load, Index step, Index iteration);

  Log& log_;
  double end_;
  double load_;
  double damaged_volume_ = 0.0;
  TimeLeft left_;
  Clock::time_point began_ = Clock::now();
  Clock::time_point drawn_;
};

}  // namespace pfdm
