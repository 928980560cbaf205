#include "postproc/fields/split_points.h"

#include "physics/error.h"
#include "postproc/fields/vtk_arrays.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <array>

namespace pfdm {
namespace {

// Gives cells copies of points in place of the points: in a grid of its own, as the one of all frames stays.
class PointSplitter {
 public:
  explicit PointSplitter(vtkUnstructuredGrid& grid) : grid_(grid) {
    points_->SetDataType(grid.GetPoints()->GetDataType());
    points_->DeepCopy(grid.GetPoints());
    cells_->DeepCopy(grid.GetCells());
    if (!grid.GetFaces()) return;
    faces_ = vtkSmartPointer<vtkIdTypeArray>::New();
    faces_->DeepCopy(grid.GetFaces());
  }

  void split(vtkIdType point, const std::vector<Index>& cells) {
    std::array<double, 3> place{};
    points_->GetPoint(point, place.data());
    const vtkIdType copy = points_->InsertNextPoint(place.data());
    for (const Index cell : cells) {
      cells_->GetCellAtId(cell, ids_);
      for (vtkIdType i = 0; i < ids_->GetNumberOfIds(); ++i)
        if (ids_->GetId(i) == point) ids_->SetId(i, copy);
      cells_->ReplaceCellAtId(cell, ids_);
      if (grid_.GetCellType(cell) == VTK_POLYHEDRON) split_faces(cell, point, copy);
    }
  }

  void finish() {
    grid_.SetPoints(points_);
    vtkNew<vtkUnsignedCharArray> types;
    types->DeepCopy(grid_.GetCellTypesArray());
    const vtkSmartPointer<vtkIdTypeArray> locations = grid_.GetFaceLocations();
    grid_.SetCells(types, cells_, locations, faces_);
  }

 private:
  void split_faces(vtkIdType cell, vtkIdType point, vtkIdType copy) {
    vtkIdType at = grid_.GetFaceLocations()->GetValue(cell);
    vtkIdType n_faces = faces_->GetValue(at++);
    for (; n_faces > 0; --n_faces)
      for (vtkIdType n = faces_->GetValue(at++); n > 0; --n, ++at)
        if (faces_->GetValue(at) == point) faces_->SetValue(at, copy);
  }

  vtkUnstructuredGrid& grid_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
  vtkSmartPointer<vtkIdTypeArray> faces_;
  vtkNew<vtkIdList> ids_;
};

// `number` is that in the file of each of the mesh's points, -1 for those that no cell uses.
vtkSmartPointer<vtkFloatArray> displacement_array(const SplitPoints& split, const std::vector<vtkIdType>& number) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  name_array(*array, "displacement", "m");
  array->SetNumberOfComponents(3);
  for (std::size_t p = 0; p < split.displacement.size(); ++p)
    if (p >= number.size() || number[p] >= 0) array->InsertNextTuple(split.displacement[p].data());
  return array;
}

}  // namespace

void add_split_points(vtkUnstructuredGrid& frame, const SplitPoints& split, const std::vector<vtkIdType>& number) {
  if (split.displacement.size() != number.size() + split.copies.size())
    throw InputError(fmt::format("{} displacements for {} points and {} copies", split.displacement.size(),
                                 number.size(), split.copies.size()));
  if (!split.copies.empty()) {
    PointSplitter splitter(frame);
    for (const PointCopy& copy : split.copies) splitter.split(number[copy.point], copy.cells);
    splitter.finish();
  }
  frame.GetPointData()->AddArray(displacement_array(split, number));
}

}  // namespace pfdm
