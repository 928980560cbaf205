#include "postproc/fields/vtu_writer.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <span>

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

// VTK writes names into its XML as they are.
std::string without_marks_of_xml(std::string name) {
  for (char& c : name)
    if (std::string_view("<>&\"'").find(c) != std::string_view::npos || static_cast<unsigned char>(c) < ' ') c = '_';
  return name;
}

void add_region_numbers(vtkFieldData& data, const Mesh& mesh) {
  for (std::size_t r = 0; r < mesh.region_names.size(); ++r) {
    vtkNew<vtkIntArray> number;
    number->SetName(without_marks_of_xml("region_" + mesh.region_names[r]).c_str());
    number->InsertNextValue(static_cast<int>(r));
    data.AddArray(number);
  }
}

void name_array(vtkDataArray& array, const std::string& name, const std::string& unit) {
  array.SetName(name.c_str());
  if (!unit.empty()) array.GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
}

// VTK reads the values where they are; its interface has no notion of arrays that it may not write to.
template <class Array, class T>
vtkSmartPointer<vtkDataArray> view(const T* values, Index n_cells, int n_components) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(n_components);
  constexpr int keep_ownership = 1;
  array->SetArray(const_cast<T*>(values), vtkIdType{n_components} * n_cells, keep_ownership);
  return array;
}

template <class Array, class Field, class Components>
vtkSmartPointer<vtkDataArray> copy(const Field& field, int n_components, const Components& components_of) {
  using Real = typename Array::ValueType;
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(n_components);
  array->SetNumberOfTuples(field.size());
  Real* out = array->GetPointer(0);
  for (const auto& value : field)
    for (const double component : components_of(value)) *out++ = static_cast<Real>(component);
  return array;
}

template <class Field, class Components>
vtkSmartPointer<vtkDataArray> copy(const Field& field, Precision precision, int n, const Components& components_of) {
  return precision == Precision::single_precision ? copy<vtkFloatArray>(field, n, components_of)
                                                  : copy<vtkDoubleArray>(field, n, components_of);
}

vtkSmartPointer<vtkDataArray> to_array(const CellField<double>& field, Precision precision) {
  if (precision == Precision::double_precision) return view<vtkDoubleArray>(field.data(), field.size(), 1);
  return copy(field, precision, 1, [](double value) { return std::array{value}; });
}

vtkSmartPointer<vtkDataArray> to_array(const CellField<Vector>& field, Precision precision) {
  static_assert(sizeof(Vector) == 3 * sizeof(double));
  if (precision == Precision::double_precision) {
    const double* values = field.size() == 0 ? nullptr : field.data()->data();
    return view<vtkDoubleArray>(values, field.size(), 3);
  }
  return copy(field, precision, 3, [](const Vector& v) { return std::array{v.x(), v.y(), v.z()}; });
}

vtkSmartPointer<vtkDataArray> to_array(const CellField<Tensor>& field, Precision precision) {
  auto array = copy(field, precision, 6, [](const Tensor& tensor) {
    const Tensor s = symmetric_part(tensor);
    return std::array{s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)};
  });
  vtkIdType component = 0;
  for (const char* name : {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}) array->SetComponentName(component++, name);
  return array;
}

vtkSmartPointer<vtkDataArray> all_components(const CellField<Tensor>& field, Precision precision) {
  return copy(field, precision, 9, [](const Tensor& a) {
    return std::array{a(0, 0), a(0, 1), a(0, 2), a(1, 0), a(1, 1), a(1, 2), a(2, 0), a(2, 1), a(2, 2)};
  });
}

vtkSmartPointer<vtkDataArray> to_array(const CellField<Index>& field, Precision) {
  static_assert(sizeof(Index) == sizeof(int));
  return view<vtkIntArray>(field.data(), field.size(), 1);
}

vtkSmartPointer<vtkDataArray> to_array(const NamedField& field, Index n_cells) {
  const auto convert = [&](const auto* values) {
    if (values->size() != n_cells)
      throw InputError(fmt::format("the field \"{}\" has {} values for {} cells", field.name, values->size(), n_cells));
    if constexpr (std::is_same_v<decltype(values), const CellField<Tensor>*>)
      if (field.all_components) return all_components(*values, field.precision);
    return to_array(*values, field.precision);
  };
  auto array = std::visit(convert, field.values);
  name_array(*array, field.name, field.unit);
  return array;
}

vtkSmartPointer<vtkDoubleArray> time_value(double time, const std::string& unit) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  name_array(*array, "TimeValue", unit);
  array->InsertNextValue(time);
  return array;
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

void add_points(vtkUnstructuredGrid& frame, const SplitPoints& split, const std::vector<vtkIdType>& number) {
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

void VtuWriter::write(const std::filesystem::path& path, const std::vector<NamedField>& fields, double time,
                      const SplitPoints* points) const {
  // A shallow copy shares the cells and leaves no pointers to the caller's values behind.
  vtkNew<vtkUnstructuredGrid> frame;
  frame->ShallowCopy(grid_->mesh);
  const auto n_cells = static_cast<Index>(frame->GetNumberOfCells());
  for (const NamedField& field : fields) frame->GetCellData()->AddArray(to_array(field, n_cells));
  if (points) add_points(*frame, *points, grid_->number);
  frame->GetFieldData()->AddArray(time_value(time, grid_->settings.time_unit));
  write_file(path, serialise(*frame, grid_->settings.compression));
}

}  // namespace pfdm
