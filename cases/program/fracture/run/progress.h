#pragma once
// How far a fracture run is: a line that is redrawn on a terminal, a line per step elsewhere.

#include "cases/program/fracture/outcome/end_of_run.h"
#include "cases/program/session/terminal/log.h"
#include "postproc/cohesive/first_debonding.h"
#include "solver/fracture/fracture_run.h"

#include <array>
#include <chrono>
#include <optional>
#include <string>

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
  /// That are still to come, by those so far; none while no step is done.
  std::optional<double> steps() const;

 private:
  double start_, end_;
  double furthest_;                // load
  double load_ = 0.0;              // of the present step, or of the last one if that is done
  double before_ = 0.0, now_ = 0;  // iterations: all but those of the present step, and those
  double steps_ = 0.0;             // that took iterations
};

struct ProgressFigures {
  std::string reached;    ///< "454.3 um, 21.83 N", of a box "strain_zz 0.04, stress_zz 2.664 MPa"
  std::string event;      ///< "lower pole debonded"; empty: nothing has
  double share = 0.0;     ///< of the load that is done
  Index steps = 0;        ///< that are done
  Index about_steps = 0;  ///< of the whole run, by those so far; 0: not known
  Index iteration = 0;    ///< of the step that is being made; 0: none
  std::optional<double> seconds_left{};
  bool may_end_early = false;  ///< the time that is left is one at most
};

/// "454.3 um, 21.83 N, lower pole debonded; 26 of about 37 steps, iteration 5; 0:46 left"
std::string progress_words(const ProgressFigures& figures);

/// The same behind a bar, in at most so many columns: what is least important goes first.
std::string progress_line(const ProgressFigures& figures, int columns);

/// "lower pole debonded"; poles are called so where `axis` points up, along z, and else by the direction of the load.
std::string debonded_words(const FirstDebonding& first, const Vector& axis);

/// What a run shows of itself at each step.
struct ShownOfRun {
  CurveUnits units;                          ///< of displacement and force
  std::optional<std::array<int, 2>> of_box;  ///< in their place this component of mean strain and stress
  bool damage = true;                        ///< bodies can break
  bool debonded_area = false;                ///< interfaces can open
  bool may_end_early = false;                ///< it ends where cycles of load repeat
};

class RunProgress {
 public:
  /// `start` and `end` are values of the load parameter.
  RunProgress(Log& log, double start, double end, ShownOfRun shown);
  void iterated(const IterationReport& iteration);
  /// displacement [m] and force [N] of the curve; `event` as in ProgressFigures.
  void step_done(const StepReport& step, double displacement, double force, const std::string& event);
  const ProgressFigures& figures() const { return figures_; }

 private:
  using Clock = std::chrono::steady_clock;
  double seconds() const;
  void draw();

  Log& log_;
  double end_;
  ShownOfRun shown_;
  TimeLeft left_;
  ProgressFigures figures_{};
  Clock::time_point began_ = Clock::now();
  Clock::time_point drawn_;
};

}  // namespace pfdm
