#include "cases/program/fracture/case/opened_case.h"

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/input/case_files/case_override.h"
#include "cases/program/studies/fit/curve_fit_case.h"
#include "cases/program/studies/sweep/sweep_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace pfdm {
namespace {

std::unique_ptr<FractureRun> run_on(const FractureCase& fracture, const Mesh& mesh, const ModelChange& change) {
  FractureModel model = model_on(fracture, mesh);
  if (change) change(mesh, model);
  return std::make_unique<FractureRun>(mesh, std::move(model), fracture.staggered, fracture.loading);
}

}  // namespace

FractureCase read_whole_fracture_case(const CaseFile& file, MeshOf mesh) {
  const ConfigValue kind = file.config.root().at("kind");
  if (kind.string() != "fracture") throw kind.error(fmt::format("\"{}\" is not \"fracture\"", kind.string()));
  FractureCase fracture = read_fracture_case(file.config.root(), file.directory, mesh);
  read_experiment(file.config.root(), file.directory);
  read_curve_fit(file);
  read_sweep(file);
  file.config.reject_unknown_keys();
  return fracture;
}

OpenedCase::OpenedCase(const std::filesystem::path& where, const std::vector<std::string>& values)
    : OpenedCase(read_whole_fracture_case(with_overrides(open_case(where), values)), std::nullopt) {}

OpenedCase::OpenedCase(const std::filesystem::path& where, const std::vector<std::string>& values, Mesh mesh)
    : OpenedCase(read_whole_fracture_case(with_overrides(open_case(where), values), MeshOf::the_caller),
                 std::move(mesh)) {}

OpenedCase::OpenedCase(FractureCase settings, std::optional<Mesh> mesh, const ModelChange& change)
    : settings_(std::move(settings)),
      mesh_(std::make_shared<const Mesh>(mesh ? std::move(*mesh) : settings_.mesh.make())),
      run_(run_on(settings_, *mesh_, change)) {}

Vector OpenedCase::reaction(const StepReport& report, std::string_view patch) const {
  return report.reaction[mesh_->patch_index(std::string(patch))];
}

Vector OpenedCase::displacement(const StepReport& report, std::string_view patch) const {
  return report.patch_displacement[mesh_->patch_index(std::string(patch))];
}

}  // namespace pfdm
