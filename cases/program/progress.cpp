#include "cases/program/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

std::string clock_time(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

Progress::Progress(Log& log, double start, double end) : log_(log), start_(start), end_(end), load_(start) {}

double Progress::seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

std::string Progress::time_left(double load) const {
  const double done = load - start_;
  return done > 0.0 ? clock_time(seconds() * (end_ - load) / done) : "?";
}

void Progress::draw(double load, const std::string& doing) {
  if (Clock::now() - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = Clock::now();
  constexpr int width = 24;
  const int filled = std::clamp(static_cast<int>(width * load_ / end_), 0, width);
  log_.progress(fmt::format("[{:=<{}}{:<{}}] load {:.4g}/{:.4g}, damaged {:.3g} m^3, {}, {} left", "", filled, "",
                            width - filled, load, end_, damaged_volume_, doing, time_left(load_)));
}

void Progress::iterated(const IterationReport& iteration) {
  draw(iteration.load, fmt::format("step {} iteration {}", iteration.step, iteration.iteration));
}

void Progress::step_done(const StepReport& step, double displacement, double force) {
  load_ = step.load;
  damaged_volume_ = step.damaged_volume;
  draw(step.load, fmt::format("step {}, {} iterations", step.step, step.staggered_iterations));
  log_.step(
      fmt::format("step {:4}  load {:.5f}  displacement {:.4e} m  force {:.4e} N  max damage {:.4f}  "
                  "damaged {:.3e} m^3  {:3} iterations  {} elapsed, {} left",
                  step.step, step.load, displacement, force, step.max_damage, step.damaged_volume,
                  step.staggered_iterations, clock_time(seconds()), time_left(step.load)));
}

}  // namespace pfdm
