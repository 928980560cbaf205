#pragma once
// What a page of pfdm report holds, and its files.

#include "postproc/page/report_page.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace pfdm {

inline std::vector<PageBlock> blocks_of(const ReportPage& page) {
  std::vector<PageBlock> blocks;
  for (const PageRow& row : page.rows) blocks.insert(blocks.end(), row.blocks.begin(), row.blocks.end());
  return blocks;
}

/// The last with a caption that begins so.
template <class Block>
Block block(const ReportPage& page, const std::string& caption) {
  std::optional<Block> last;
  for (const PageBlock& candidate : blocks_of(page))
    if (const auto* found = std::get_if<Block>(&candidate); found != nullptr && found->caption.starts_with(caption))
      last = *found;
  if (!last) throw std::runtime_error("the page has no \"" + caption + "\"");
  return *last;
}

inline std::string row_of(const Table& table, const std::string& name) {
  for (const auto& row : table.rows)
    if (row.front() == name) return row.back();
  return "no row " + name;
}

inline void expect_files(const std::filesystem::path& results) {
  EXPECT_THAT(content_of(results / "report" / "report.pdf"), ::testing::StartsWith("%PDF"));
  EXPECT_THAT(content_of(results / "report" / "report.png"), ::testing::StartsWith("\x89PNG"));
  EXPECT_GT(std::filesystem::file_size(results / "report" / "report.png"), 50000u);
}

}  // namespace pfdm
