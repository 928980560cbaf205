#include "postproc/fields/stored_grid.h"

#include "mesh/files/vtk_messages.h"
#include "physics/error.h"
#include "postproc/fields/vtkhdf_frames.h"

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace pfdm {

StoredGrid::StoredGrid(const std::filesystem::path& file) {
  if (is_in_one_file(file)) {
    grid_ = read_frame_in_one_file(file);
    return;
  }
  if (!std::filesystem::exists(file)) throw InputError(fmt::format("{}: the frame does not exist", file.string()));
  const CaughtVtkMessages caught;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  grid_ = reader->GetOutput();
  if (!caught.none() || n_cells() == 0)
    throw InputError(
        fmt::format("{}: this is not a frame: {}", file.string(), caught.none() ? "it has no cells" : caught.first()));
}

}  // namespace pfdm
