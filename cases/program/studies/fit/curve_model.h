#pragma once
// A case as a forward model: from values of its parameters to the curve that its run leaves.

#include "cases/program/input/case_files/case_parameter.h"
#include "cases/program/studies/runs/case_runs.h"
#include "postproc/curves/comparison.h"
#include "postproc/displacements/field_path.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {

class CurveModel {
 public:
  /// How the curve is read from the folder of a run's results.
  using ReadCurve = std::function<SampledCurve(const std::filesystem::path& results)>;
  /// How a fit of fields reads the whole way of a run.
  using ReadHistory = std::function<FieldHistory(const std::filesystem::path& results)>;
  /// Keeps references to file, parameters and runs.
  CurveModel(const CaseFile& file, const std::vector<CaseParameter>& parameters, ReadCurve read, ReadHistory history,
             CaseRuns& runs)
      : file_(file), parameters_(parameters), read_(std::move(read)), history_(std::move(history)), runs_(runs) {}

  /// The curve with these values of all parameters [SI], at least up to `until` if it is given; nothing where the run
  /// does not converge.
  std::optional<SampledCurve> respond(const std::vector<double>& values, std::optional<double> until);
  /// Likewise the way of the run, of fits of fields.
  std::shared_ptr<const FieldHistory> history(const std::vector<double>& values, std::optional<double> until);
  /// Runs what respond() will be asked for, side by side.
  void prepare(const std::vector<std::vector<double>>& points, std::optional<double> until);

  std::string shown(const std::vector<double>& values) const { return pfdm::shown(parameters_, values); }

 private:
  CaseVariant variant(const std::vector<double>& values) const;

  const CaseFile& file_;
  const std::vector<CaseParameter>& parameters_;
  ReadCurve read_;
  ReadHistory history_;
  std::map<std::pair<std::string, std::optional<double>>, std::shared_ptr<const FieldHistory>>
      known_;  // a few, by folder and end
  CaseRuns& runs_;
};

}  // namespace pfdm
