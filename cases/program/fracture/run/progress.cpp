#include "cases/program/fracture/run/progress.h"

#include "cases/program/fracture/outcome/debonded_poles.h"
#include "cases/program/fracture/outcome/mean_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace pfdm {
namespace {

constexpr int widest_bar = 24, narrowest_bar = 5;

std::string clock_time(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string words_for_time_left(const ProgressFigures& figures) {
  if (!figures.seconds_left) return "time left unknown";
  return fmt::format("{}{} left", figures.may_end_early ? "at most " : "", clock_time(*figures.seconds_left));
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

std::optional<double> TimeLeft::steps() const {
  if (steps_ == 0.0 || !(furthest_ > start_)) return std::nullopt;
  return steps_ * std::max(0.0, end_ - furthest_) / (furthest_ - start_);
}

namespace {

/// A piece of the line, and what stands before it.
struct LinePart {
  std::string text, before;
  int importance;
};

std::vector<LinePart> line_parts(const ProgressFigures& figures) {
  std::string steps = fmt::format("{} step{}", figures.steps, figures.steps == 1 ? "" : "s");
  if (figures.about_steps > 0) steps = fmt::format("{} of about {} steps", figures.steps, figures.about_steps);
  std::vector<LinePart> parts{{figures.reached, "", 5}};
  if (!figures.event.empty()) parts.push_back({figures.event, ", ", 2});
  parts.push_back({std::move(steps), "; ", 3});
  if (figures.iteration > 0) parts.push_back({fmt::format("iteration {}", figures.iteration), ", ", 1});
  parts.push_back({words_for_time_left(figures), "; ", 4});
  return parts;
}

std::string whole_line(const std::vector<LinePart>& parts) {
  std::string all;
  for (const LinePart& part : parts) all += (all.empty() ? "" : part.before) + part.text;
  return all;
}

}  // namespace

std::string progress_words(const ProgressFigures& figures) { return whole_line(line_parts(figures)); }

std::string progress_line(const ProgressFigures& figures, int columns) {
  std::vector<LinePart> parts = line_parts(figures);
  constexpr int brackets = 3;
  const auto room_for_bar = [&] { return columns - brackets - static_cast<int>(whole_line(parts).size()); };
  while (parts.size() > 1 && columns < static_cast<int>(whole_line(parts).size()))
    parts.erase(std::ranges::min_element(parts, {}, &LinePart::importance));
  const int width = std::min(widest_bar, room_for_bar());
  const std::string line = (width >= narrowest_bar ? bar(figures.share, width) : "") + whole_line(parts);
  return line.substr(0, static_cast<std::size_t>(std::max(0, columns)));
}

std::string debonded_words(const FirstDebonding& first, const Vector& axis) {
  const auto pole = pole_of(first.polar_from, first.polar_to, axis);
  return (pole ? *pole : fmt::format("\"{}\"", first.surface)) + " debonded";
}

RunProgress::RunProgress(Log& log, double start, double end, ShownOfRun shown)
    : log_(log), end_(end), shown_(std::move(shown)), left_(start, end) {
  figures_.reached = fmt::format("load {:.4g} of {:.4g}", start, end);
  figures_.share = start / end;
  figures_.may_end_early = shown_.may_end_early;
}

double RunProgress::seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

void RunProgress::draw() {
  if (Clock::now() - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = Clock::now();
  log_.progress(progress_line(figures_, log_.columns()));
}

void RunProgress::iterated(const IterationReport& iteration) {
  left_.iterated(iteration.iteration, iteration.load);
  figures_.iteration = iteration.iteration;
  figures_.seconds_left = left_.seconds(seconds());
  draw();
}

void RunProgress::step_done(const StepReport& step, double displacement, double force, const std::string& event) {
  left_.step_done(step.load);
  std::array<std::string, 2> names{"displacement", "force"},
      values{shown_in(shown_.units.displacement, displacement), shown_in(shown_.units.force, force)};
  if (shown_.of_box && step.means) {
    const auto& [i, j] = *shown_.of_box;
    const std::string_view component = name_of_component(*shown_.of_box);
    names = {fmt::format("strain_{}", component), fmt::format("stress_{}", component)};
    values = {fmt::format("{:.4g}", step.means->strain(i, j)), shown_in({.si_unit = "Pa"}, step.means->stress(i, j))};
  }
  figures_ = {.reached = shown_.of_box ? fmt::format("{} {}, {} {}", names[0], values[0], names[1], values[1])
                                       : values[0] + ", " + values[1],
              .event = event,
              .share = step.load / end_,
              .steps = step.step,
              .about_steps = 0,
              .iteration = 0,
              .seconds_left = left_.seconds(seconds()),
              .may_end_early = shown_.may_end_early};
  if (const auto more = left_.steps()) figures_.about_steps = step.step + static_cast<Index>(std::ceil(*more - 1e-6));
  draw();
  std::string line = fmt::format("step {:4}  load {:.5f}  {} {}  {} {}", step.step, step.load, names[0], values[0],
                                 names[1], values[1]);
  if (shown_.damage)
    line += fmt::format("  max damage {:.4f}  damaged {}", step.max_damage,
                        shown_in({.si_unit = "m^3"}, step.damaged_volume));
  if (shown_.debonded_area)
    line += fmt::format("  debonded {}", shown_in({.si_unit = "m^2"}, std::accumulate(step.debonded_area.begin(),
                                                                                      step.debonded_area.end(), 0.0)));
  log_.step(line + fmt::format("  {:3} iterations  {} elapsed, {}", step.staggered_iterations, clock_time(seconds()),
                               words_for_time_left(figures_)));
}

}  // namespace pfdm
