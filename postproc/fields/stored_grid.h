#pragma once
// A frame of a run in memory, as VTK has it. For the files here that read and write frames.

#include "physics/tensor.h"
#include "postproc/fields/vtu_writer.h"

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <filesystem>

namespace pfdm {

class StoredGrid {
 public:
  /// Of a .vtu file, or one of those in the one file of a run (vtkhdf_frames.h). Throws InputError if it cannot be read
  /// or has no cells.
  explicit StoredGrid(const std::filesystem::path& file);

  vtkUnstructuredGrid* grid() const { return grid_; }
  Index n_cells() const { return static_cast<Index>(grid()->GetNumberOfCells()); }

 private:
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
};

/// A frame in the one file of a run (vtkhdf_frames.h), with all its fields. Throws InputError if it cannot be read.
vtkSmartPointer<vtkUnstructuredGrid> read_frame_in_one_file(const std::filesystem::path& frame);

/// As a .vtu file, whole or not at all. Throws ComputationError if it cannot be written.
void write_grid(const std::filesystem::path& path, vtkUnstructuredGrid& grid, Compression compression);

}  // namespace pfdm
