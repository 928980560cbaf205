#pragma once
// What the pages of all kinds of case share.

#include "cases/program/session/session.h"
#include "postproc/browser/browser_page.h"
#include "postproc/page/display_unit.h"
#include "postproc/page/report_page.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// Numbers in SI in the unit that they are shown in.
std::vector<double> in_unit(std::span<const double> values, const DisplayUnit& unit);

/// The unit that suits the largest of all the values.
DisplayUnit common_unit(std::span<const std::vector<double>> columns, std::string_view si_unit);

/// Adds a series for each column over x, in the unit, in the colours in their order.
void add_series(Chart& chart, const std::vector<double>& x, std::span<const std::vector<double>> columns,
                std::span<const std::string_view> names, const DisplayUnit& unit);

/// Two blocks to a row.
std::vector<PageRow> in_pairs(std::vector<PageBlock> blocks);

inline constexpr std::string_view warnings_caption = "Warnings";
inline constexpr std::string_view runs_caption = "Runs";  ///< of a sweep, in a table

/// The warnings of a log, each once; none if there is no such file.
std::vector<std::string> warnings_of(const std::filesystem::path& log);

/// The same as a block; nothing where there are none. At most `limit` are told.
std::vector<PageRow> warnings_row(const std::filesystem::path& log, std::size_t limit = 6);

/// Throws OtherCase if a file of the results does not have the hash of this case.
void require_case(const std::filesystem::path& file, const std::string& found, const std::string& due);

/// What `read` makes of a file of the results, which has a case_hash; nothing if there is no such file. Throws like
/// require_case().
template <class Read>
auto find_of_case(const std::filesystem::path& file, const std::string& hash, const Read& read)
    -> std::optional<decltype(read(file))> {
  if (!std::filesystem::exists(file)) return std::nullopt;
  auto found = read(file);
  require_case(file, found.case_hash, hash);
  return found;
}

/// What write_report() made of an earlier run.
void remove_report(const std::filesystem::path& results);

/// What the page in the browser has beyond that on paper.
struct BrowserExtras {
  std::string hash{};                   ///< of the case; a fit of another one is not told of
  std::string job{};                    ///< command that makes the results again; empty: as they look
  std::vector<std::string> headline{};  ///< sentences
  std::vector<HeadFigure> figures{};
  std::vector<std::string> steps{};  ///< as in BrowserPage, as what follows
  std::optional<Body> body{};
  std::vector<PageBlock> more{};  ///< after those on paper
  std::vector<std::string> beside{};
  std::optional<RunSet> runs{};
};

/// A report on paper and in the browser.
struct CasePage {
  ReportPage report;
  BrowserExtras extras{};
};

/// The keys of the case that ran, or of the one in the folder above, that are not at their defaults: name, value,
/// default. None where there is no such case or this program reads it no more.
std::vector<std::vector<std::string>> keys_off_defaults(const Session& session);

/// report.pdf, report.png and index.html in a folder, and says so. Warnings, the case as it ran and where it comes from
/// are taken from the session's results; of a fit verdict and estimates too. Throws ComputationError.
void write_pages(const std::filesystem::path& folder, const ReportPage& page, Session& session, BrowserExtras extras);

/// The same in report/ of the session's results.
void write_report(CasePage page, Session& session);

}  // namespace pfdm
