#include "mesh/files/vtk_file.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIncrementalOctreePointLocator.h>
#include <vtkNew.h>
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

#include "mesh/files/vtk_messages.h"
#include "physics/error.h"
#include "physics/system/packed_bytes.h"
#include "physics/system/separate_process.h"

namespace pfdm {
namespace {

template <class Reader>
vtkSmartPointer<vtkUnstructuredGrid> read_with(const std::filesystem::path& path) {
  const CaughtVtkMessages caught;
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkSmartPointer<vtkUnstructuredGrid> grid = reader->GetOutput();
  if (!caught.none() || !grid)
    throw InputError(fmt::format("cannot read the mesh {}: {}", path.string(),
                                 caught.none() ? "it contains no grid" : caught.first()));
  return grid;
}

void require_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw InputError(fmt::format("cannot read the mesh {}: it is a directory", path.string()));
  if (!std::ifstream(path))
    throw InputError(fmt::format("cannot read the mesh {}: {}", path.string(), std::strerror(errno)));
}

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::filesystem::path& path) {
  if (path.extension() == ".vtu") return read_with<vtkXMLUnstructuredGridReader>(path);
  if (path.extension() == ".vtk") return read_with<vtkUnstructuredGridReader>(path);
  throw InputError(fmt::format("cannot read the mesh {}: its name must end in .vtu or .vtk", path.string()));
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
    file.cell_offsets.push_back(static_cast<Index>(file.cell_points.size()));
    if (type == VTK_POLYHEDRON) file.polyhedron_faces.push_back(face_stream(grid, c));
    if (is_prism)
      file.polyhedron_faces.push_back(faces_of_prism(std::span(file.cell_points).last(static_cast<std::size_t>(n))));
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

MeshFile read_here(const std::filesystem::path& path) {
  const auto grid = read_grid(path);
  MeshFile file;
  try {
    if (std::max(grid->GetNumberOfPoints(), 8 * grid->GetNumberOfCells()) > std::numeric_limits<Index>::max())
      throw InputError("it has too many cells to number");
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) file.points.emplace_back(grid->GetPoint(i));
    copy_cells(file, *grid);
    copy_arrays(file, *grid);
  } catch (const InputError& e) {
    throw InputError(fmt::format("the mesh {}: {}", path.string(), e.what()));
  }
  return file;
}

/// What the formats of VTK have.
std::string bytes_of(const MeshFile& file) {
  BytePacker packer;
  packer.put(file.points);
  packer.put(file.cell_type);
  packer.put(file.cell_offsets);
  packer.put(file.cell_points);
  packer.put(file.polyhedron_faces);
  packer.put(file.integer_arrays);
  return packer.take();
}

MeshFile file_in(const std::string& bytes) {
  ByteUnpacker unpacker(bytes);
  MeshFile file;
  unpacker.take(file.points);
  unpacker.take(file.cell_type);
  unpacker.take(file.cell_offsets);
  unpacker.take(file.cell_points);
  unpacker.take(file.polyhedron_faces);
  unpacker.take(file.integer_arrays);
  return file;
}

}  // namespace

// VTK's readers crash on some damaged files.
MeshFile read_vtk_file(const std::filesystem::path& path) {
  require_file(path);
  return file_in(read_separately(path, fmt::format("cannot read the mesh {}", path.string()),
                                 [&] { return bytes_of(read_here(path)); }));
}

std::vector<Index> merge_points(std::vector<Vector>& points, double tolerance) {
  std::vector<Index> number;
  if (points.empty()) return number;
  Vector low = points.front();
  Vector high = points.front();
  for (const Vector& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
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
