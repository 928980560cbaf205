#include "mesh/files/vtk_file.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdTypeArray.h>
#include <vtkIncrementalOctreePointLocator.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "mesh/bounding_box.h"
#include "mesh/files/vtk_messages.h"
#include "physics/error.h"
#include "physics/system/packed_bytes.h"
#include "physics/system/separate_process.h"

namespace pfdm {
namespace {

template <class Reader>
vtkSmartPointer<vtkUnstructuredGrid> read_with(const std::filesystem::path& path, std::string_view noun) {
  const CaughtVtkMessages caught;
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkSmartPointer<vtkUnstructuredGrid> grid = reader->GetOutput();
  if (!caught.none() || !grid)
    throw InputError(fmt::format("cannot read the {} {}: {}", noun, path.string(),
                                 caught.none() ? "it contains no grid" : caught.first()));
  return grid;
}

void require_file(const std::filesystem::path& path, std::string_view noun) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw InputError(fmt::format("cannot read the {} {}: it is a directory", noun, path.string()));
  if (!std::ifstream(path))
    throw InputError(fmt::format("cannot read the {} {}: {}", noun, path.string(), std::strerror(errno)));
}

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::filesystem::path& path, std::string_view noun) {
  if (path.extension() == ".vtu") return read_with<vtkXMLUnstructuredGridReader>(path, noun);
  if (path.extension() == ".vtk") return read_with<vtkUnstructuredGridReader>(path, noun);
  throw InputError(fmt::format("cannot read the {} {}: its name must end in .vtu or .vtk", noun, path.string()));
}

Index point_number(vtkUnstructuredGrid& grid, vtkIdType id, vtkIdType cell) {
  if (id < 0 || id >= grid.GetNumberOfPoints())
    throw InputError(
        fmt::format("its cell {} refers to point {}; the mesh has {} points", cell, id, grid.GetNumberOfPoints()));
  return static_cast<Index>(id);
}

// The polyhedron's part of VTK's list of faces; readers do not check where it points.
std::vector<Index> face_stream(vtkUnstructuredGrid& grid, vtkIdType cell) {
  vtkIdTypeArray* faces = grid.GetFaces();
  vtkIdTypeArray* locations = grid.GetFaceLocations();
  const auto value = [&](vtkIdTypeArray* array, vtkIdType at) {
    if (!array || at < 0 || at >= array->GetNumberOfValues())
      throw InputError(fmt::format("the faces of its polyhedron {} are incomplete", cell));
    return array->GetValue(at);
  };
  vtkIdType at = value(locations, cell);
  std::vector<Index> stream{static_cast<Index>(value(faces, at))};
  for (Index f = 0; f < stream[0]; ++f) {
    const vtkIdType n = value(faces, ++at);
    if (n < 3) throw InputError(fmt::format("its polyhedron {} has a face of {} points", cell, n));
    stream.push_back(static_cast<Index>(n));
    for (vtkIdType i = 0; i < n; ++i) stream.push_back(point_number(grid, value(faces, ++at), cell));
  }
  return stream;
}

void copy_cells(MeshFile& file, vtkUnstructuredGrid& grid) {
  if (grid.GetNumberOfCells() > 0 && !grid.GetCells()->IsValid())
    throw InputError("its cells refer beyond the end of their list of points");
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    grid.GetCellPoints(c, n, ids);
    const int type = grid.GetCellType(c);
    const bool is_prism = type == VTK_PENTAGONAL_PRISM || type == VTK_HEXAGONAL_PRISM;
    file.cell_type.push_back(is_prism ? VTK_POLYHEDRON : type);
    for (vtkIdType i = 0; i < n; ++i) file.cell_points.push_back(point_number(grid, ids[i], c));
    file.cell_offsets.push_back(count_of(file.cell_points));
    if (type == VTK_POLYHEDRON) file.polyhedron_faces.push_back(face_stream(grid, c));
    if (is_prism) file.polyhedron_faces.push_back(faces_of_prism(std::span(file.cell_points).last(n)));
  }
}

std::optional<std::vector<Index>> whole_numbers(vtkDataArray& array) {
  std::vector<Index> values;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) {
    const double value = array.GetComponent(i, 0);
    if (!(std::abs(value) <= std::numeric_limits<Index>::max()) || value != std::round(value)) return std::nullopt;
    values.push_back(static_cast<Index>(value));
  }
  return values;
}

void copy_arrays(MeshFile& file, vtkUnstructuredGrid& grid) {
  vtkCellData& data = *grid.GetCellData();
  for (int a = 0; a < data.GetNumberOfArrays(); ++a) {
    vtkDataArray* array = data.GetArray(a);  // null for strings
    if (!array || !array->GetName() || array->GetNumberOfComponents() != 1) continue;
    if (array->GetNumberOfTuples() != grid.GetNumberOfCells()) continue;
    if (auto values = whole_numbers(*array)) file.integer_arrays[array->GetName()] = std::move(*values);
  }
}

void copy_mesh(MeshFile& file, vtkUnstructuredGrid& grid) {
  if (std::max(grid.GetNumberOfPoints(), 8 * grid.GetNumberOfCells()) > std::numeric_limits<Index>::max())
    throw InputError("it has too many cells to number");
  for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) file.points.emplace_back(grid.GetPoint(i));
  copy_cells(file, grid);
  copy_arrays(file, grid);
}

std::string names_of(vtkDataSetAttributes& data) {
  std::string names;
  for (int a = 0; a < data.GetNumberOfArrays(); ++a)
    if (const vtkDataArray* array = data.GetArray(a); array && data.GetArrayName(a))
      names += (names.empty() ? "" : ", ") + std::string(data.GetArrayName(a));
  return names.empty() ? "none" : names;
}

void copy_field(FileArray& field, vtkUnstructuredGrid& grid, const std::string& name) {
  vtkDataSetAttributes &of_points = *grid.GetPointData(), &of_cells = *grid.GetCellData();
  vtkDataArray* array = of_points.GetArray(name.c_str());
  field.at_points = array != nullptr;
  if (!array) array = of_cells.GetArray(name.c_str());
  if (!array)
    throw InputError(fmt::format("it has no array \"{}\"; available: {} at points, {} in cells", name,
                                 names_of(of_points), names_of(of_cells)));
  if (array->GetNumberOfTuples() != (field.at_points ? grid.GetNumberOfPoints() : grid.GetNumberOfCells()))
    throw InputError(fmt::format("its array \"{}\" has {} entries, its points are {} and its cells {}", name,
                                 array->GetNumberOfTuples(), grid.GetNumberOfPoints(), grid.GetNumberOfCells()));
  field.n_components = array->GetNumberOfComponents();
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int k = 0; k < field.n_components; ++k) field.values.push_back(array->GetComponent(i, k));
}

/// What the formats of VTK have.
std::string bytes_of(const MeshFile& file, const FileArray& field) {
  BytePacker packer;
  packer.put(field.at_points);
  packer.put(field.n_components);
  packer.put(field.values);
  packer.put(file.points);
  packer.put(file.cell_type);
  packer.put(file.cell_offsets);
  packer.put(file.cell_points);
  packer.put(file.polyhedron_faces);
  packer.put(file.integer_arrays);
  return packer.take();
}

std::pair<MeshFile, FileArray> file_in(const std::string& bytes) {
  ByteUnpacker unpacker(bytes);
  std::pair<MeshFile, FileArray> read;
  auto& [file, field] = read;
  unpacker.take(field.at_points);
  unpacker.take(field.n_components);
  unpacker.take(field.values);
  unpacker.take(file.points);
  unpacker.take(file.cell_type);
  unpacker.take(file.cell_offsets);
  unpacker.take(file.cell_points);
  unpacker.take(file.polyhedron_faces);
  unpacker.take(file.integer_arrays);
  return read;
}

// VTK's readers crash on some damaged files.
std::pair<MeshFile, FileArray> read_apart(const std::filesystem::path& path, const std::string& array,
                                          std::string_view noun) {
  require_file(path, noun);
  return file_in(read_separately(path, fmt::format("cannot read the {} {}", noun, path.string()), [&] {
    const auto [file, field] = read_vtk_here(path, array, noun);
    return bytes_of(file, field);
  }));
}

}  // namespace

std::optional<CellShape> shape_of(int vtk_type) {
  switch (vtk_type) {
    case VTK_TETRA: return CellShape::tetrahedron;
    case VTK_VOXEL:
    case VTK_HEXAHEDRON: return CellShape::hexahedron;
    case VTK_WEDGE: return CellShape::wedge;
    case VTK_PYRAMID: return CellShape::pyramid;
    case VTK_POLYHEDRON: return CellShape::polyhedron;
    default: return std::nullopt;
  }
}

std::pair<MeshFile, FileArray> read_vtk_here(const std::filesystem::path& path, const std::string& array,
                                             std::string_view noun) {
  const auto grid = read_grid(path, noun);
  std::pair<MeshFile, FileArray> read;
  try {
    copy_mesh(read.first, *grid);
    if (!array.empty()) copy_field(read.second, *grid, array);
  } catch (const InputError& e) {
    throw InputError(fmt::format("the {} {}: {}", noun, path.string(), e.what()));
  }
  return read;
}

MeshFile read_vtk_file(const std::filesystem::path& path) { return read_apart(path, "", "mesh").first; }

std::pair<MeshFile, FileArray> read_vtk_array(const std::filesystem::path& path, const std::string& array) {
  return read_apart(path, array, "field");
}

std::vector<Index> merge_points(std::vector<Vector>& points, double tolerance) {
  std::vector<Index> number;
  if (points.empty()) return number;
  const auto [low, high] = bounding_box(points);
  const double bounds[6] = {low[0], high[0], low[1], high[1], low[2], high[2]};
  vtkNew<vtkPoints> kept;
  kept->SetDataTypeToDouble();
  vtkNew<vtkIncrementalOctreePointLocator> locator;
  locator->SetTolerance(tolerance);
  locator->InitPointInsertion(kept, bounds);
  std::vector<Vector> merged;
  for (const Vector& x : points) {
    vtkIdType id = 0;
    if (locator->InsertUniquePoint(x.data(), id)) merged.push_back(x);
    number.push_back(static_cast<Index>(id));
  }
  points = std::move(merged);
  return number;
}

}  // namespace pfdm
