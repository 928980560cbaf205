#include "postproc/fields/stored_cells.h"

#include "physics/error.h"
#include "postproc/fields/stored_grid.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <string_view>

namespace pfdm {

struct StoredCells::Data : StoredGrid {
  explicit Data(const std::filesystem::path& file) : StoredGrid(file), name(file.string()) {}
  std::string name;
  vtkNew<vtkIdList> ids;
  vtkDataArray* required(vtkFieldData* data, const std::string& field, int component) const {
    vtkDataArray* array = data->GetArray(field.c_str());
    if (array == nullptr || array->GetNumberOfComponents() <= component)
      throw InputError(fmt::format("{}: the frame has no field \"{}\"", name, field));
    return array;
  }
};

StoredCells::StoredCells(const std::filesystem::path& file) : data_(std::make_unique<Data>(file)) {}

StoredCells::~StoredCells() = default;

Index StoredCells::n_cells() const { return data_->n_cells(); }

std::vector<Vector> StoredCells::points() const {
  std::vector<Vector> points(data_->grid()->GetNumberOfPoints());
  for (std::size_t i = 0; i < points.size(); ++i) data_->grid()->GetPoint(static_cast<vtkIdType>(i), points[i].data());
  return points;
}

std::vector<std::uint8_t> StoredCells::shapes() const {
  std::vector<std::uint8_t> shapes;
  for (vtkIdType i = 0; i < data_->grid()->GetNumberOfCells(); ++i) {
    switch (data_->grid()->GetCellType(i)) {
      case VTK_TETRA: shapes.push_back(4); break;
      case VTK_PYRAMID: shapes.push_back(5); break;
      case VTK_WEDGE: shapes.push_back(6); break;
      case VTK_HEXAHEDRON: shapes.push_back(8); break;
      case VTK_POLYHEDRON: shapes.push_back(0); break;
      default: throw InputError(fmt::format("{}: cell {} is no body", data_->name, i));
    }
  }
  return shapes;
}

void StoredCells::append_corners(Index cell, std::vector<Index>& corners, std::vector<Index>& faces) const {
  vtkUnstructuredGrid* grid = data_->grid();
  const bool is_polyhedron = grid->GetCellType(cell) == VTK_POLYHEDRON;
  if (!is_polyhedron) {
    grid->GetCellPoints(cell, data_->ids);
    for (vtkIdType i = 0; i < data_->ids->GetNumberOfIds(); ++i)
      corners.push_back(static_cast<Index>(data_->ids->GetId(i)));
    return;
  }
  grid->GetFaceStream(cell, data_->ids);
  vtkIdType at = 0;
  const auto next = [&] { return static_cast<Index>(data_->ids->GetId(at++)); };
  Index n_faces = next();
  faces.push_back(n_faces);
  for (; n_faces > 0; --n_faces) {
    Index n = next();
    faces.push_back(n);
    for (; n > 0; --n) corners.push_back(next());
  }
}

std::vector<std::string> StoredCells::regions() const {
  constexpr std::string_view mark = "region_";
  std::vector<std::string> names;
  vtkFieldData* data = data_->grid()->GetFieldData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data->GetArray(i);
    const std::string_view name = array == nullptr || array->GetName() == nullptr ? "" : array->GetName();
    if (!name.starts_with(mark)) continue;
    const auto number = static_cast<std::size_t>(array->GetTuple1(0));
    if (names.size() <= number) names.resize(number + 1);
    names[number] = name.substr(mark.size());
  }
  return names;
}

bool StoredCells::has(const std::string& field) const {
  return data_->grid()->GetCellData()->GetArray(field.c_str()) != nullptr;
}

std::vector<double> StoredCells::values(const std::string& field, int component) const {
  vtkDataArray* array = data_->required(data_->grid()->GetCellData(), field, component);
  std::vector<double> values(n_cells());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = array->GetComponent(static_cast<vtkIdType>(i), component);
  return values;
}

std::vector<Vector> StoredCells::displacement() const {
  vtkDataArray* array = data_->required(data_->grid()->GetPointData(), "displacement", 2);
  std::vector<Vector> values(data_->grid()->GetNumberOfPoints());
  for (std::size_t i = 0; i < values.size(); ++i) array->GetTuple(static_cast<vtkIdType>(i), values[i].data());
  return values;
}

}  // namespace pfdm
