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

struct BrowserPage {
  ReportPage report;                  ///< without its warnings
  std::vector<std::string> headline;  ///< sentences
  std::vector<HeadFigure> figures;
  std::vector<std::string> warnings;
  std::vector<std::pair<std::string, std::string>> origin;  ///< name and value
  std::string command;                                      ///< that makes the results again
  std::string case_text;
  std::vector<std::string> steps;     ///< what to say of each row of the run's curve
  std::optional<Body> body;           ///< whose steps are rows of the curve
  std::vector<std::string> beside{};  ///< captions of blocks that stand beside the body
};

/// Texts are in JSON without "<": whatever they say, the browser shows them as text.
std::string page_as_html(const BrowserPage& page);

/// index.html. Throws ComputationError if it cannot be written.
void write_browser_page(const std::filesystem::path& folder, const BrowserPage& page);

/// With the signs of print: "um" becomes "µm", "J/m^2" "J/m²", "180 degrees" "180°".
std::string in_print(std::string text);

}  // namespace pfdm
