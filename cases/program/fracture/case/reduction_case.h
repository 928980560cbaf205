#pragma once
// Reads [experiment.reduction]: the specimen of a fracture test whose records are reduced to energy release rates.

#include "cases/program/input/config/config.h"
#include "cases/program/input/config/key.h"
#include "postproc/reduction/reduced_test.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

struct ReductionSettings {
  const ReducedSpecimen* specimen = nullptr;
  TestDimensions dimensions{};
  std::vector<std::string> names{};   ///< of the records
  std::vector<TestRecord> records{};  ///< as [experiment] prepares them, without the factors of its columns
  ConfigTable where;                  ///< for messages
};

const KeyTable& reduction_keys();

/// Nothing without [experiment.reduction]. `root` is the whole case file. Throws InputError that names file and line.
std::optional<ReductionSettings> read_reduction(const ConfigTable& root, const std::filesystem::path& case_directory);

/// All records. Throws InputError, with the place in the file, for one that cannot be reduced.
std::vector<ReducedTest> reduced_tests(const ReductionSettings& settings);

}  // namespace pfdm
