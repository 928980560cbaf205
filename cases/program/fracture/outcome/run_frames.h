#pragma once
// The frames of a fracture run: fields and cohesive interfaces at the steps that the case asks for, and the lists of
// them that ParaView opens. Throws ComputationError where a file cannot be written.

#include "cases/program/fracture/case/fracture_case.h"
#include "mesh/mesh.h"
#include "postproc/fields/pvd.h"
#include "postproc/fields/vtu_writer.h"
#include "solver/fracture/model/state.h"

#include <filesystem>
#include <optional>

namespace pfdm {

class RunFrames {
 public:
  /// Keeps references to all three.
  RunFrames(const Mesh& mesh, const FractureModel& model, const FractureCase& fracture);

  /// Starts the lists in this folder anew, or continues them after the frame of step `last_frame`. What a run that
  /// failed, or was killed, wrote beyond it goes away; frames in one file become files of their own, which outlive a
  /// kill.
  void open(const std::filesystem::path& folder, std::optional<Index> last_frame);

  bool are_due(const FractureState& state) const;
  void write(Index step, double load, const OutputFields& output);
  bool has(Index step) const;  ///< the last frame is of this step
  /// All frames in one file in place of their own, if the case asks for it. The last that is done with frames.
  void put_into_one_file() const;

 private:
  void remove_beyond(Index last_frame) const;
  void unpack_from_one_file() const;
  double time_of(Index step, double load) const;
  void write_interfaces(Index step, double time, const OutputFields& output);

  const Mesh& mesh_;
  const FractureModel& model_;
  const FractureCase& fracture_;
  VtuWriter writer_;
  std::filesystem::path folder_;
  std::optional<PvdSeries> frames_;      // after open()
  std::optional<PvdSeries> interfaces_;  // likewise, of a case that has some
};

}  // namespace pfdm
