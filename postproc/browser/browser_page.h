#pragma once
// A report as one file for the browser, which needs no other: what the page of report.pdf has, with the body that
// moves.

#include "postproc/browser/body.h"
#include "postproc/page/report_page.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {

/// A figure that one asks for first.
struct HeadFigure {
  std::string label, value, note;
};

/// A body of one of several runs that stand side by side.
struct NamedBody {
  std::string name;
  std::vector<std::string> steps;  ///< as in BrowserPage
  std::vector<double> at;          ///< of each frame, what the common slider goes over
  Body body;
};

/// What the slider over several bodies goes over.
struct BodiesAxis {
  std::string words, unit;
};

/// A column of a set of runs.
struct RunColumn {
  std::string words, unit;
  std::vector<double> values;  ///< run by run, NaN: none
  bool is_key = false;         ///< was changed from run to run; the others came out
};

/// The runs of a sweep: a table that sorts, small curves, scatter, parallel coordinates.
struct RunSet {
  std::vector<std::string> labels;
  std::vector<std::string> notes;  ///< of each run; empty: nothing
  std::vector<RunColumn> columns;
  std::string x_title, y_title;  ///< of the curves
  std::vector<Series> curves;    ///< of each run, empty where it has none; none at all
};

/// Of a run that goes on: the page loads itself again.
struct LivePage {
  std::string words;   ///< how far it is
  double share = 0.0;  ///< of the load that is done
  double every = 5.0;  ///< about the time between two pages [s]
  double made = 0.0;   ///< since 1970 [s]
};

struct BrowserPage {
  ReportPage report;                  ///< without its warnings
  std::vector<std::string> headline;  ///< sentences
  std::vector<HeadFigure> figures;
  std::vector<std::string> warnings;
  std::vector<std::pair<std::string, std::string>> origin;  ///< name and value
  std::string command;                                      ///< that makes the results again
  std::string case_text;
  std::vector<std::vector<std::string>> keys{};  ///< off their defaults: name, value, default
  std::vector<std::string> steps;                ///< what to say of each row of the run's curve
  std::optional<Body> body;                      ///< whose steps are rows of the curve
  std::vector<std::string> beside{};             ///< captions of blocks that stand beside the body
  std::vector<PageBlock> first{};                ///< above the body, as wide as the page
  std::vector<NamedBody> bodies{};               ///< in place of the body
  BodiesAxis bodies_axis{};
  std::optional<RunSet> runs{};
  std::optional<LivePage> live{};
};

/// Texts are in JSON without "<": whatever they say, the browser shows them as text.
std::string page_as_html(const BrowserPage& page);

/// index.html. Throws ComputationError if it cannot be written.
void write_browser_page(const std::filesystem::path& folder, const BrowserPage& page);

/// With the signs of print: "um" becomes "µm", "J/m^2" "J/m²", "180 degrees" "180°".
std::string in_print(std::string text);

}  // namespace pfdm
