#pragma once
// How the frames of a fracture run are written: what ParaView takes for their time, their compression and format.

#include "cases/program/input/config/config.h"
#include "postproc/fields/vtu_writer.h"
#include "solver/fracture/model/fracture_model.h"

#include <optional>
#include <string>

namespace pfdm {

struct FrameSettings {
  double time_per_load = 1.0;  ///< of the load parameter; 0: the time is the number of the step
  VtuSettings file;            ///< compression, and the unit of the time
  bool in_one_file = false;    ///< at the end of a run also as one file of HDF5 (postproc/fields/vtkhdf.h)

  double time(Index step, double load) const {
    return time_per_load > 0.0 ? time_per_load * load : static_cast<double>(step);
  }
};

/// time_value, compression and format of [output]. `full_displacement` is that of the curve's patch at load parameter 1
/// [m], if it is reached linearly. Times must increase: throws InputError for a time_value that would not, or is not
/// known.
FrameSettings read_frame_settings(const ConfigTable& output, const LoadingSettings& loading,
                                  const std::optional<double>& full_displacement);

}  // namespace pfdm
