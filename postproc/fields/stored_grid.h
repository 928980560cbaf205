#pragma once
// A frame (.vtu) of a run in memory, as VTK has it. For the files here that read frames.

#include "physics/tensor.h"

#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <filesystem>

namespace pfdm {

class StoredGrid {
 public:
  /// Throws InputError if the file cannot be read or has no cells.
  explicit StoredGrid(const std::filesystem::path& file);

  vtkUnstructuredGrid* grid() const { return reader_->GetOutput(); }
  Index n_cells() const { return static_cast<Index>(grid()->GetNumberOfCells()); }

 private:
  vtkNew<vtkXMLUnstructuredGridReader> reader_;
};

}  // namespace pfdm
