#include "postproc/fields/vtu_writer.h"

#include "physics/error.h"
#include "postproc/fields/split_points.h"
#include "postproc/fields/stored_grid.h"
#include "postproc/fields/vtk_arrays.h"
#include "postproc/files/atomic_file.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace pfdm {
namespace {

int vtk_cell_type(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron: return VTK_TETRA;
    case CellShape::wedge: return VTK_WEDGE;
    case CellShape::pyramid: return VTK_PYRAMID;
    case CellShape::hexahedron: return VTK_HEXAHEDRON;
    case CellShape::polyhedron: return VTK_POLYHEDRON;
  }
  return VTK_EMPTY_CELL;
}

// VTK cuts and measures a polyhedron whose faces are not plane wrongly or not at all: those with an apex go into the
// file as the triangles about it that they are.
bool goes_as_triangles(const Mesh& mesh, Index face) {
  if (mesh.face_apex.size() == 0) return false;
  const auto points = mesh.points_of_face(face);
  const Vector& apex = mesh.points[mesh.face_apex[face]];
  double area = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    area += 0.5 * (mesh.points[points[i]] - apex).cross(mesh.points[points[(i + 1) % points.size()]] - apex).norm();
  return area > (1.0 + 1e-9) * mesh.face_area[face].norm();
}

// The points that the file needs: those of the cells and the apexes of triangles.
struct GridPoints {
  explicit GridPoints(const Mesh& mesh) : number(mesh.points.size(), -1), as_triangles(mesh.n_faces()) {
    for (const Index p : mesh.cell_points) number[p] = 0;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
      as_triangles[f] = goes_as_triangles(mesh, f);
      if (as_triangles[f]) number[mesh.face_apex[f]] = 0;
    }
    points->SetDataTypeToDouble();
    for (std::size_t p = 0; p < number.size(); ++p)
      if (number[p] == 0) number[p] = points->InsertNextPoint(mesh.points[p].data());
  }
  vtkIdType operator[](Index point) const { return number[point]; }

  vtkNew<vtkPoints> points;
  std::vector<vtkIdType> number;
  std::vector<bool> as_triangles;  // per face
};

struct FaceStream {
  vtkIdType n_faces = 0;
  std::vector<vtkIdType> entries;  // [n_points, p..., n_points, p...]
};

// The faces of a cell, each counter-clockwise when seen from outside the cell.
FaceStream face_stream(const Mesh& mesh, const GridPoints& number, Index cell) {
  FaceStream stream;
  std::vector<vtkIdType> rim;
  for (const Index face : mesh.faces_of_cell(cell)) {
    rim.clear();
    for (const Index p : mesh.points_of_face(face)) rim.push_back(number[p]);
    if (mesh.owner[face] != cell) std::ranges::reverse(rim);
    const auto add = [&](std::span<const vtkIdType> points) {
      stream.entries.push_back(static_cast<vtkIdType>(points.size()));
      stream.entries.insert(stream.entries.end(), points.begin(), points.end());
      ++stream.n_faces;
    };
    if (!number.as_triangles[face]) {
      add(rim);
      continue;
    }
    const vtkIdType apex = number[mesh.face_apex[face]];
    for (std::size_t i = 0; i < rim.size(); ++i)
      if (const vtkIdType next = rim[(i + 1) % rim.size()]; rim[i] != apex && next != apex)
        add(std::array{apex, rim[i], next});
  }
  return stream;
}

void insert_cell(vtkUnstructuredGrid& grid, const Mesh& mesh, const GridPoints& number, Index cell) {
  std::vector<vtkIdType> points;
  for (const Index p : mesh.points_of_cell(cell)) points.push_back(number[p]);
  const auto n_points = static_cast<vtkIdType>(points.size());
  const int type = vtk_cell_type(mesh.shape[cell]);
  if (type != VTK_POLYHEDRON) {
    grid.InsertNextCell(type, n_points, points.data());
    return;
  }
  const FaceStream faces = face_stream(mesh, number, cell);
  // The points are those of the cell's faces, apexes too.
  std::vector<vtkIdType> all;
  for (auto at = faces.entries.begin(); at != faces.entries.end(); at += *at + 1)
    all.insert(all.end(), at + 1, at + 1 + *at);
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  grid.InsertNextCell(type, static_cast<vtkIdType>(all.size()), all.data(), faces.n_faces, faces.entries.data());
}

// VTK writes names into its XML as they are. Readers get the name back, but "_" for control characters.
std::string escaped_for_xml(std::string_view name) {
  std::string escaped;
  for (const char c : name) switch (c) {
      case '<': escaped += "&lt;"; break;
      case '>': escaped += "&gt;"; break;
      case '&': escaped += "&amp;"; break;
      case '"': escaped += "&quot;"; break;
      case '\'': escaped += "&apos;"; break;
      default: escaped += static_cast<unsigned char>(c) < ' ' ? '_' : c;
    }
  return escaped;
}

void add_region_numbers(vtkFieldData& data, const Mesh& mesh) {
  for (std::size_t r = 0; r < mesh.region_names.size(); ++r) {
    vtkNew<vtkIntArray> number;
    number->SetName(escaped_for_xml("region_" + mesh.region_names[r]).c_str());
    number->InsertNextValue(static_cast<int>(r));
    data.AddArray(number);
  }
}

void set_compressor(vtkXMLUnstructuredGridWriter& writer, Compression compression) {
  switch (compression) {
    case Compression::zlib:
      writer.SetCompressorTypeToZLib();
      writer.SetCompressionLevel(1);  // higher levels take twice the time for a twentieth of the size
      break;
    case Compression::lz4: writer.SetCompressorTypeToLZ4(); break;
    case Compression::none: writer.SetCompressorTypeToNone(); break;
  }
}

// Into memory, and from there to the disk by write_file: VTK overlooks some errors of the disk.
std::string serialise(vtkUnstructuredGrid& grid, Compression compression) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  // Not appended at the file's end: where expat defers parsing, as Debian 12's since its update of 2024, VTK and
  // ParaView read on into the appended numbers as if they were XML.
  writer->SetDataModeToBinary();
  set_compressor(*writer, compression);
  writer->SetHeaderTypeToUInt64();
  writer->SetIdTypeToInt32();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0 || writer->GetErrorCode() != vtkErrorCode::NoError)
    throw ComputationError(fmt::format("VTK could not encode a mesh with {} cells (its error {})",
                                       grid.GetNumberOfCells(), writer->GetErrorCode()));
  return writer->GetOutputString();
}

}  // namespace

struct VtuWriter::Grid {
  vtkNew<vtkUnstructuredGrid> mesh;
  std::vector<vtkIdType> number;  // as in GridPoints
  VtuSettings settings;
};

VtuWriter::VtuWriter(const Mesh& mesh, VtuSettings settings) : grid_(std::make_unique<Grid>()) {
  vtkUnstructuredGrid& grid = *grid_->mesh;
  GridPoints points(mesh);
  grid.SetPoints(points.points);
  grid.Allocate(mesh.n_cells());
  for (Index cell = 0; cell < mesh.n_cells(); ++cell) insert_cell(grid, mesh, points, cell);
  add_region_numbers(*grid.GetFieldData(), mesh);
  grid_->number = std::move(points.number);
  grid_->settings = std::move(settings);
}

VtuWriter::VtuWriter(const Mesh& mesh, const std::vector<Index>& faces, VtuSettings settings)
    : grid_(std::make_unique<Grid>()) {
  vtkUnstructuredGrid& grid = *grid_->mesh;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  grid_->number.assign(mesh.points.size(), -1);
  grid.Allocate(static_cast<vtkIdType>(faces.size()));
  std::vector<vtkIdType> rim;
  for (const Index face : faces) {
    rim.clear();
    for (const Index p : mesh.points_of_face(face)) {
      vtkIdType& number = grid_->number[p];
      if (number < 0) number = points->InsertNextPoint(mesh.points[p].data());
      rim.push_back(number);
    }
    grid.InsertNextCell(VTK_POLYGON, static_cast<vtkIdType>(rim.size()), rim.data());
  }
  grid.SetPoints(points);
  grid_->settings = std::move(settings);
}

VtuWriter::~VtuWriter() = default;
VtuWriter::VtuWriter(VtuWriter&&) noexcept = default;
VtuWriter& VtuWriter::operator=(VtuWriter&&) noexcept = default;

void write_grid(const std::filesystem::path& path, vtkUnstructuredGrid& grid, Compression compression) {
  for (int i = 0; i < grid.GetFieldData()->GetNumberOfArrays(); ++i)
    if (vtkDataArray* array = grid.GetFieldData()->GetArray(i); array != nullptr && array->GetName() != nullptr)
      array->SetName(escaped_for_xml(array->GetName()).c_str());
  write_file(path, serialise(grid, compression));
}

void VtuWriter::write(const std::filesystem::path& path, const std::vector<NamedField>& fields, double time,
                      const SplitPoints* points) const {
  // A shallow copy shares the cells and leaves no pointers to the caller's values behind.
  vtkNew<vtkUnstructuredGrid> frame;
  frame->ShallowCopy(grid_->mesh);
  const auto n_cells = static_cast<Index>(frame->GetNumberOfCells());
  for (const NamedField& field : fields) frame->GetCellData()->AddArray(vtk_array(field, n_cells));
  if (points) add_split_points(*frame, *points, grid_->number);
  frame->GetFieldData()->AddArray(vtk_time(time, grid_->settings.time_unit));
  write_file(path, serialise(*frame, grid_->settings.compression));
}

}  // namespace pfdm
