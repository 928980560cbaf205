#pragma once
// pfdm run --live: the page of a run that goes on, made anew every few seconds.

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/fracture/run/progress.h"
#include "cases/program/input/case_files/case_file.h"
#include "cases/program/session/session.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "postproc/browser/browser_page.h"
#include "postproc/curves/curve_csv.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// When a page may be made so that all pages together take no more than a share of the time. All times are seconds,
/// those of a run since its start.
class PageTimes {
 public:
  constexpr PageTimes(double share, double least_apart) : share_(share), least_apart_(least_apart) {}
  bool is_due(double now) const;
  /// A page was ready at `now`, which took so long.
  void made(double now, double took);
  /// Between two pages, about, as the last one took.
  double apart() const;

 private:
  double share_, least_apart_;
  double last_ = 0.0, spent_ = 0.0, dearest_ = 0.0;
};

/// What the pages of a run tell of it all the way.
struct LiveCase {
  const FractureCase& fracture;
  const std::optional<ExperimentSettings>& experiment;
  const CaseFile& file;
  std::string title;    ///< of the page
  std::string command;  ///< that makes the results again
  std::string report;   ///< that makes the whole page when the run has ended
};

class LivePages {
 public:
  /// No more than 1.5 % of the time (of the 2 % that are promised: what comes is not known), 3 s apart or more.
  static constexpr PageTimes usual_times{0.015, 3.0};

  /// Pages go to report/index.html in the session's results. Keeps references.
  LivePages(LiveCase live, Session& session, PageTimes times = usual_times);
  /// Writes a page if one is due. `rows`: the curve so far.
  void look(const ProgressFigures& progress, std::span<const CurveRow> rows);
  /// The last page, which loads itself no more. `told`: sentences on what happened.
  void end(std::vector<std::string> told, std::span<const CurveRow> rows);

 private:
  double now() const { return watch_.seconds(); }
  BrowserPage page(std::span<const CurveRow> rows) const;
  void write(const BrowserPage& page);
  void tell(std::string_view when);

  LiveCase live_;
  Session& session_;
  Stopwatch watch_;
  PageTimes times_;
  bool gave_up_ = false, is_told_ = false;
};

}  // namespace pfdm
