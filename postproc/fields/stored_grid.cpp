#include "postproc/fields/stored_grid.h"

#include "mesh/files/vtk_messages.h"
#include "physics/error.h"

#include <fmt/format.h>

namespace pfdm {

StoredGrid::StoredGrid(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) throw InputError(fmt::format("{}: the frame does not exist", file.string()));
  const CaughtVtkMessages caught;
  reader_->SetFileName(file.c_str());
  reader_->Update();
  if (!caught.none() || n_cells() == 0)
    throw InputError(
        fmt::format("{}: this is not a frame: {}", file.string(), caught.none() ? "it has no cells" : caught.first()));
}

}  // namespace pfdm
