#pragma once
// How a composite's body does in its six load cases, as frames for ParaView and for the page.

#include "mesh/mesh.h"
#include "postproc/browser/body.h"
#include "postproc/fields/pvd.h"
#include "postproc/fields/vtu_writer.h"
#include "solver/homogenization/homogenization.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

inline constexpr const char* load_case_frames_file = "fields.pvd";
inline constexpr const char* load_case_folder = "fields";

/// Frames at the times 1 to 6: displacement [m], stress [Pa] and strain of each load case, times what makes the norm of
/// its mean strain 1 %.
class LoadCaseFrames {
 public:
  LoadCaseFrames(std::filesystem::path folder, const Mesh& mesh);
  /// The load case `k` from 0. Throws ComputationError if a file cannot be written.
  void add(std::size_t k, const LoadCase& one, const LoadCaseFields& fields);

 private:
  std::filesystem::path folder_;
  const Mesh& mesh_;
  VtuWriter writer_;
  PvdSeries series_;
};

/// Of the results of a run; none where it has no frames. Throws InputError for files that are damaged.
std::optional<Body> load_case_body(const std::filesystem::path& results);
/// What to say of each load case.
std::vector<std::string> words_of_load_cases();

}  // namespace pfdm
