#pragma once
// Fields out of files: arrays of VTK files, series of them, and numbers at scattered points.

#include "cases/program/input/config/config.h"
#include "physics/tensor.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pfdm {

struct CaseFile;

/// Whether the value is { file, ... } or { csv, ... }.
bool is_field(const ConfigValue& value);

/// Numbers by place and time in SI, read where they are first asked for. It may be asked from several threads at once.
class FieldInFile {
 public:
  /// Throws InputError with the place in the case, where a key is missing or a file cannot be read.
  FieldInFile(const ConfigValue& value, const Dimension& due);

  bool is_series() const;
  /// At x [m]; `t`: the load parameter of a series. Throws InputError likewise, also for what is wrong in the file, for
  /// a place outside the field, a time after the last frame and a number that is not finite.
  double operator()(const Vector& x, double t) const;
  /// What it is read from and how; equal texts are equal fields.
  const std::string& text() const;

 private:
  struct Content;
  std::shared_ptr<Content> content_;
};

/// The files of all fields in the case, with the frames of their lists.
std::vector<std::filesystem::path> field_files(const CaseFile& file);

}  // namespace pfdm
