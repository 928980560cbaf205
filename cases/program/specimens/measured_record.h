#pragma once
// The CSV file of a testing machine as a new case names it: columns and units that are recognised, what the record
// needs.

#include "cases/program/specimens/specimen_text.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// Names under which --set says which columns are meant.
std::vector<std::string> column_words();

/// A record, and [[experiment.specimens]] of it.
struct MeasuredRecord {
  std::string file;                  ///< beside case.toml: "data/test.csv"
  std::string text;                  ///< of [[experiment.specimens]]
  std::vector<std::string> remarks;  ///< what was found and what was assumed, a sentence each
};

/// `share` is the part of the specimen that is computed, by which forces are multiplied.
/// Throws InputError for a file that is no table, or in which a displacement or a force cannot be told.
MeasuredRecord recognised(const std::filesystem::path& csv, const std::string& file, const std::string& name,
                          const std::map<std::string, std::string>& columns, double share = 1.0);

}  // namespace pfdm
