#pragma once
// A fracture case for programs of one's own: read from its folder, with its mesh, its model on it and the run.
//
//   OpenedCase bead("cases/glass_bead_quick", {"regions.interface.toughness=300 J/m^2"});
//   FractureState state = bead.run().initial_state();
//   while (!bead.run().is_complete(state)) {
//     const StepReport report = bead.run().step(state);
//     std::cout << report.load << ' ' << bead.reaction(report, "zmax").z() << '\n';
//   }

#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/input/case_files/case_file.h"
#include "solver/fracture/fracture_run.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// A fracture case with all that its file says. Throws InputError for whatever is wrong with it, unknown keys included,
/// and for cases of other kinds.
FractureCase read_whole_fracture_case(const CaseFile& file, MeshOf mesh = MeshOf::the_case);

/// What a program changes in the model of a case before it is checked: laws of its own.
using ModelChange = std::function<void(const Mesh& mesh, FractureModel& model)>;

class OpenedCase {
 public:
  /// `where` is the case directory or a .toml file in it; `values` are other ones for its keys, "KEY=VALUE" as of
  /// `--set`. Makes the mesh. Writes nothing. Throws InputError for whatever is wrong with the case, unknown keys
  /// included, and for cases of other kinds.
  explicit OpenedCase(const std::filesystem::path& where, const std::vector<std::string>& values = {});

  /// The same on a mesh that was made elsewhere, whose regions and patches the case names; what [mesh] says is read and
  /// not made.
  OpenedCase(const std::filesystem::path& where, const std::vector<std::string>& values, Mesh mesh);

  /// The same of a case that has been read, also of a box. Without `mesh` it makes its own.
  OpenedCase(FractureCase settings, std::optional<Mesh> mesh, const ModelChange& change = {});

  const std::string& title() const { return settings_.title; }
  /// As the file has them: loading, boundary conditions, output.
  const FractureCase& settings() const { return settings_; }
  const Mesh& mesh() const { return *mesh_; }
  /// For what outlives the case and shows its mesh alone.
  const std::shared_ptr<const Mesh>& shared_mesh() const { return mesh_; }
  const FractureModel& model() const { return run_->model(); }
  FractureRun& run() { return *run_; }

  /// Force on a patch [N], and the mean displacement of it [m]. Throws InputError, which lists the patches, if the mesh
  /// has none of this name.
  Vector reaction(const StepReport& report, std::string_view patch) const;
  Vector displacement(const StepReport& report, std::string_view patch) const;

 private:
  FractureCase settings_;
  std::shared_ptr<const Mesh> mesh_;  // stays where it is when this moves
  std::unique_ptr<FractureRun> run_;
};

}  // namespace pfdm
