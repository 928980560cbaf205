#include "cases/program/fracture/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfdm {
namespace {

constexpr int widest_bar = 24, narrowest_bar = 5;

std::string clock_time(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string words_for(std::optional<double> seconds_left) {
  return seconds_left ? fmt::format("{} left", clock_time(*seconds_left)) : "time left unknown";
}

std::string bar(double share, int width) {
  const int filled = std::clamp(static_cast<int>(width * share), 0, width);
  return fmt::format("[{:=<{}}{:<{}}] ", "", filled, "", width - filled);
}

}  // namespace

void TimeLeft::iterated(Index iteration, double load) {
  if (iteration <= 1) before_ += now_;  // of a step that is done, or was given up
  now_ = static_cast<double>(iteration);
  load_ = load;
}

void TimeLeft::step_done(double load) {
  if (now_ > 0.0) ++steps_;
  before_ += now_;
  now_ = 0.0;
  load_ = load;
  furthest_ = std::max(furthest_, load);
}

std::optional<double> TimeLeft::seconds(double elapsed) const {
  if (steps_ == 0.0 || load_ < furthest_ || !(load_ > start_)) return std::nullopt;
  // The present step takes as many iterations as others do, or more.
  const double of_present = now_ > 0.0 ? std::max(now_, before_ / steps_) : 0.0;
  const double of_load = (before_ + of_present) / (load_ - start_);
  const double iterations = of_present - now_ + of_load * std::max(0.0, end_ - load_);
  return iterations * elapsed / (before_ + now_);
}

std::string progress_line(const ProgressFigures& figures, int columns) {
  struct Part {
    std::string text;
    int importance;
  };
  std::vector<Part> parts{{fmt::format("load {:.4g}/{:.4g}", figures.load, figures.end), 4},
                          {fmt::format("damaged {:.3g} m^3", figures.damaged_volume), 1},
                          {fmt::format("step {} iteration {}", figures.step, figures.iteration), 2},
                          {words_for(figures.seconds_left), 3}};
  const auto text = [&] {
    std::string all;
    for (const Part& part : parts) all += (all.empty() ? "" : ", ") + part.text;
    return all;
  };
  constexpr int brackets = 3;
  const auto room_for_bar = [&] { return columns - brackets - static_cast<int>(text().size()); };
  while (parts.size() > 1 && columns < static_cast<int>(text().size()))
    parts.erase(std::ranges::min_element(parts, {}, &Part::importance));
  if (parts.size() == 4 && room_for_bar() < narrowest_bar) parts.erase(parts.begin() + 1);
  const int width = std::min(widest_bar, room_for_bar());
  const std::string line = (width >= narrowest_bar ? bar(figures.share, width) : "") + text();
  return line.substr(0, static_cast<std::size_t>(std::max(0, columns)));
}

RunProgress::RunProgress(Log& log, double start, double end) : log_(log), end_(end), load_(start), left_(start, end) {}

double RunProgress::seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

void RunProgress::draw(double load, Index step, Index iteration) {
  if (Clock::now() - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = Clock::now();
  log_.progress(progress_line({.load = load,
                               .end = end_,
                               .share = load_ / end_,
                               .damaged_volume = damaged_volume_,
                               .step = step,
                               .iteration = iteration,
                               .seconds_left = left_.seconds(seconds())},
                              log_.columns()));
}

void RunProgress::iterated(const IterationReport& iteration) {
  left_.iterated(iteration.iteration, iteration.load);
  draw(iteration.load, iteration.step, iteration.iteration);
}

void RunProgress::step_done(const StepReport& step, double displacement, double force) {
  load_ = step.load;
  damaged_volume_ = step.damaged_volume;
  left_.step_done(step.load);
  draw(step.load, step.step, step.staggered_iterations);
  log_.step(
      fmt::format("step {:4}  load {:.5f}  displacement {:.4e} m  force {:.4e} N  max damage {:.4f}  "
                  "damaged {:.3e} m^3  {:3} iterations  {} elapsed, {}",
                  step.step, step.load, displacement, force, step.max_damage, step.damaged_volume,
                  step.staggered_iterations, clock_time(seconds()), words_for(left_.seconds(seconds()))));
}

}  // namespace pfdm
