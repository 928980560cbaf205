#include "postproc/fields/field_slice.h"

#include "physics/error.h"
#include "postproc/fields/stored_grid.h"

#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkCutter.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <map>
#include <utility>

namespace pfdm {
namespace {

Vector point_of(vtkPolyData* data, vtkIdType id) { return Eigen::Map<const Eigen::Vector3d>(data->GetPoint(id)); }

/// Edges of the polygons, each with the materials on both sides.
using Edges = std::map<std::pair<vtkIdType, vtkIdType>, std::pair<double, double>>;

void add_edges(Edges& edges, const vtkIdType* corners, vtkIdType n, double material) {
  for (vtkIdType i = 0; i < n; ++i) {
    const auto ends = std::minmax(corners[i], corners[(i + 1) % n]);
    const auto [edge, is_new] = edges.try_emplace(ends, material, material);
    if (!is_new) edge->second.second = material;
  }
}

}  // namespace

struct StoredFrame::Data : StoredGrid {
  using StoredGrid::StoredGrid;
  vtkDataArray* of_cells(const std::string& field) const {
    if (vtkDataArray* values = grid()->GetCellData()->GetArray(field.c_str())) return values;
    throw InputError(fmt::format("the frame has no field \"{}\"", field));
  }
};

StoredFrame::StoredFrame(const std::filesystem::path& file) : data_(std::make_unique<Data>(file)) {}

StoredFrame::~StoredFrame() = default;

Index StoredFrame::n_cells() const { return data_->n_cells(); }

Vector StoredFrame::lower() const {
  const double* b = data_->grid()->GetBounds();
  return {b[0], b[2], b[4]};
}

Vector StoredFrame::upper() const {
  const double* b = data_->grid()->GetBounds();
  return {b[1], b[3], b[5]};
}

FieldSlice StoredFrame::slice(const Vector& point, const Vector& normal, const std::string& field) const {
  data_->of_cells(field);
  const Vector origin = point + 1e-6 * (upper() - lower()).norm() * normal.normalized();
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(origin.x(), origin.y(), origin.z());
  plane->SetNormal(normal.x(), normal.y(), normal.z());
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(data_->grid());
  cutter->SetCutFunction(plane);
  cutter->GenerateTrianglesOff();
  cutter->Update();
  vtkPolyData* cut = cutter->GetOutput();
  vtkDataArray* values = cut->GetCellData()->GetArray(field.c_str());
  vtkDataArray* materials = cut->GetCellData()->GetArray("material");

  FieldSlice slice;
  Edges edges;
  const auto polygons = vtk::TakeSmartPointer(cut->GetPolys()->NewIterator());
  // Vertices and lines come before polygons in the numbers of the cells.
  const vtkIdType first = cut->GetNumberOfVerts() + cut->GetNumberOfLines();
  for (polygons->GoToFirstCell(); !polygons->IsDoneWithTraversal(); polygons->GoToNextCell()) {
    vtkIdType n = 0;
    const vtkIdType* corners = nullptr;
    polygons->GetCurrentCell(n, corners);
    const vtkIdType number = first + polygons->GetCurrentCellId();
    FieldSlice::Cell cell{.corners = {}, .value = values->GetTuple1(number)};
    for (vtkIdType i = 0; i < n; ++i) cell.corners.push_back(point_of(cut, corners[i]));
    slice.cells.push_back(std::move(cell));
    if (materials != nullptr) add_edges(edges, corners, n, materials->GetTuple1(number));
  }
  for (const auto& [ends, sides] : edges)
    if (sides.first != sides.second) slice.borders.push_back({point_of(cut, ends.first), point_of(cut, ends.second)});
  return slice;
}

std::vector<FieldSlice::Cell> StoredFrame::faces(const std::string& field) const {
  vtkUnstructuredGrid* grid = data_->grid();
  vtkDataArray* values = data_->of_cells(field);
  std::vector<FieldSlice::Cell> faces;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    vtkCell* cell = grid->GetCell(i);
    if (cell->GetCellDimension() != 2) continue;
    faces.push_back({.corners = {}, .value = values->GetTuple1(i)});
    for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k)
      faces.back().corners.emplace_back(Eigen::Map<const Eigen::Vector3d>(cell->GetPoints()->GetPoint(k)));
  }
  return faces;
}

}  // namespace pfdm
