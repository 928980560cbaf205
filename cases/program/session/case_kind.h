#pragma once
// What a kind of case is: how it is read, and the laws, methods and conditions that its case.toml may name.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/input/config/key.h"
#include "cases/program/session/runnable_case.h"

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pfdm {

/// A table of laws, methods or conditions, as pfdm list --laws shows it.
struct LawTable {
  std::string heading;  ///< what they are, and in brackets where case.toml names them
  std::vector<std::pair<std::string_view, std::string_view>> rows;  ///< name, description
};

template <class Row>
LawTable law_table(std::string heading, std::span<const Row> rows) {
  LawTable table{.heading = std::move(heading), .rows = {}};
  for (const Row& row : rows) table.rows.emplace_back(row.name, row.description);
  return table;
}

struct CaseKind {
  std::string_view name;
  std::string_view description;
  /// Throws InputError for whatever is wrong with the file, but for keys that nothing reads.
  RunnableCase (*read)(const CaseFile& file);
  std::vector<LawTable> (*laws)() = nullptr;  ///< may be empty
  /// The rows of the keys of its files, one table for each way in which they are read.
  std::vector<const KeyTable*> (*keys)() = nullptr;
  /// A file of results of `run` by its name, in JSON with all that it may hold, as for require_key_like(); "" for one
  /// that depends on the case.
  std::string (*numbers_like)(std::string_view file) = nullptr;
};

}  // namespace pfdm
