#include "cases/program/fracture/run/live_page.h"

#include "cases/program/fracture/page/fracture_report.h"
#include "cases/program/session/head_line.h"
#include "physics/error.h"
#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace pfdm {
namespace {

double since_1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

bool PageTimes::is_due(double now) const { return now - last_ >= least_apart_ && spent_ + dearest_ <= share_ * now; }

void PageTimes::made(double now, double took) {
  last_ = now;
  spent_ += took;
  dearest_ = std::max(dearest_, took);
}

double PageTimes::apart() const { return std::max(least_apart_, dearest_ / share_); }

LivePages::LivePages(LiveCase live, Session& session, PageTimes times)
    : live_(std::move(live)), session_(session), times_(times) {}

BrowserPage LivePages::page(std::span<const CurveRow> rows) const {
  const Headlines f = headlines(rows, live_.fracture.output.curve.component);
  BrowserPage page{.report = running_page(live_.fracture, live_.experiment, live_.title, {rows.begin(), rows.end()}),
                   .headline = {},
                   .figures = {{.label = "Steps", .value = fmt::format("{}", rows.back().step), .note = {}}},
                   .warnings = session_.log.warnings(),
                   .origin = {{"run", head_line(session_, live_.title)}, {"results", session_.results.string()}},
                   .command = live_.command,
                   .case_text = live_.file.text,
                   .steps = {},
                   .body = std::nullopt};
  if (!live_.fracture.box && acts_on(live_.fracture.output.curve.patch, live_.fracture.boundary))
    page.figures.push_back({.label = "Greatest force",
                            .value = shown(f.peak_force, "N"),
                            .note = fmt::format("at {}", shown(f.displacement_at_peak, "m"))});
  page.figures.push_back({.label = "Largest damage", .value = shown(f.max_damage), .note = {}});
  return page;
}

void LivePages::write(const BrowserPage& page) {
  try {
    write_browser_page(session_.results / "report", page);
  } catch (const ComputationError& error) {  // the run is worth more than its page
    gave_up_ = true;
    session_.log.warn(fmt::format("{}; the page is not kept up to date any more", error.what()));
  }
}

/// Of a page that is there now.
void LivePages::tell(std::string_view when) {
  if (!std::exchange(is_told_, true) && !gave_up_)
    session_.log.say(fmt::format("open in a browser{}: {}", when, (session_.results / "report/index.html").string()));
}

void LivePages::look(const ProgressFigures& progress, std::span<const CurveRow> rows) {
  const double start = now();
  if (gave_up_ || rows.empty() || !times_.is_due(start)) return;
  BrowserPage made = page(rows);
  made.live = {.words = in_print(progress_words(progress)),
               .share = std::clamp(progress.share, 0.0, 1.0),
               .every = times_.apart(),
               .made = since_1970()};
  write(made);
  times_.made(now(), now() - start);
  tell(" while it runs");
}

void LivePages::end(std::vector<std::string> told, std::span<const CurveRow> rows) {
  if (gave_up_ || rows.empty()) return;
  BrowserPage made = page(rows);
  for (std::string& sentence : told) made.headline.push_back(in_print(std::move(sentence)));
  made.headline.push_back(fmt::format("{} makes the whole page, with the body that moves.", live_.report));
  write(made);
  tell("");
}

}  // namespace pfdm
