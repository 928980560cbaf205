#include "postproc/fields/vtkhdf.h"

#include "physics/error.h"
#include "postproc/fields/pvd.h"
#include "postproc/fields/stored_grid.h"
#include "postproc/files/atomic_file.h"
#include "postproc/hdf5/growing_dataset.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr hsize_t largest_chunk = 16384;  // rows

hid_t type_of(vtkDataArray& array) {
  switch (array.GetDataType()) {
    case VTK_DOUBLE: return hdf5_type<double>();
    case VTK_FLOAT: return hdf5_type<float>();
    case VTK_INT: return hdf5_type<int>();
    default: throw InputError(fmt::format("the field \"{}\" of a frame has numbers of another type", array.GetName()));
  }
}

std::vector<std::int64_t> numbers_of(vtkDataArray& array) {
  std::vector<std::int64_t> numbers(array.GetNumberOfTuples());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = static_cast<std::int64_t>(array.GetComponent(static_cast<vtkIdType>(i), 0));
  return numbers;
}

void write_list(hid_t group, const char* name, const std::vector<std::int64_t>& values, hsize_t columns = 0) {
  GrowingDataset(group, name, hdf5_type<std::int64_t>(), columns, values.size()).append(values.data(), values.size());
}

/// Points and cells of a frame.
struct Geometry {
  explicit Geometry(vtkUnstructuredGrid& grid) {
    vtkDataArray& given = *grid.GetPoints()->GetData();
    points.resize(3 * given.GetNumberOfTuples());
    for (vtkIdType i = 0; i < given.GetNumberOfTuples(); ++i) given.GetTuple(i, points.data() + 3 * i);
    connectivity = numbers_of(*grid.GetCells()->GetConnectivityArray());
    offsets = numbers_of(*grid.GetCells()->GetOffsetsArray());
    types.resize(grid.GetNumberOfCells());
    for (std::size_t c = 0; c < types.size(); ++c)
      types[c] = static_cast<std::uint8_t>(grid.GetCellType(static_cast<vtkIdType>(c)));
  }
  bool operator==(const Geometry&) const = default;

  std::vector<double> points;
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
};

/// The geometries of the frames, a part of the file for each that differs from the one before.
class Geometries {
 public:
  Geometries(hid_t root, const Geometry& first)
      : points_(root, "Points", hdf5_type<double>(), 3, chunk(first.points.size() / 3)),
        connectivity_(root, "Connectivity", hdf5_type<std::int64_t>(), 0, chunk(first.connectivity.size())),
        offsets_(root, "Offsets", hdf5_type<std::int64_t>(), 0, chunk(first.offsets.size())),
        types_(root, "Types", hdf5_type<std::uint8_t>(), 0, chunk(first.types.size())) {}

  void add(Geometry geometry) {
    if (!last_ || *last_ != geometry) append(geometry);
    part_.push_back(static_cast<std::int64_t>(n_points_.size()) - 1);
    first_point_.push_back(last_first_point_);
    first_cell_.push_back(last_first_cell_);
    first_corner_.push_back(last_first_corner_);
    last_ = std::move(geometry);
  }

  void write_numbers(hid_t root, hid_t steps) const {
    write_list(root, "NumberOfPoints", n_points_);
    write_list(root, "NumberOfCells", n_cells_);
    write_list(root, "NumberOfConnectivityIds", n_corners_);
    write_list(steps, "PartOffsets", part_);
    write_list(steps, "NumberOfParts", std::vector<std::int64_t>(part_.size(), 1));
    write_list(steps, "PointOffsets", first_point_);
    write_list(steps, "CellOffsets", first_cell_, 1);
    write_list(steps, "ConnectivityIdOffsets", first_corner_, 1);
  }

  static hsize_t chunk(std::size_t rows) { return std::min<hsize_t>(rows, largest_chunk); }

 private:
  void append(const Geometry& geometry) {
    last_first_point_ = static_cast<std::int64_t>(points_.rows());
    last_first_cell_ = static_cast<std::int64_t>(types_.rows());
    last_first_corner_ = static_cast<std::int64_t>(connectivity_.rows());
    n_points_.push_back(static_cast<std::int64_t>(geometry.points.size() / 3));
    n_cells_.push_back(static_cast<std::int64_t>(geometry.types.size()));
    n_corners_.push_back(static_cast<std::int64_t>(geometry.connectivity.size()));
    points_.append(geometry.points.data(), geometry.points.size() / 3);
    connectivity_.append(geometry.connectivity.data(), geometry.connectivity.size());
    offsets_.append(geometry.offsets.data(), geometry.offsets.size());
    types_.append(geometry.types.data(), geometry.types.size());
  }

  GrowingDataset points_, connectivity_, offsets_, types_;
  std::optional<Geometry> last_;
  std::int64_t last_first_point_ = 0, last_first_cell_ = 0, last_first_corner_ = 0;
  std::vector<std::int64_t> n_points_, n_cells_, n_corners_;                  // of each part
  std::vector<std::int64_t> part_, first_point_, first_cell_, first_corner_;  // of each step
};

/// A name that the group does not have yet, without "/", which parts groups in names of HDF5.
std::string new_name_in(hid_t group, std::string name) {
  std::ranges::replace(name, '/', '|');
  while (H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0) name += '|';
  return name;
}

/// A field of cells or points over the steps. Values that are those of the step before are not written again.
class SteppedField {
 public:
  SteppedField(hid_t group, vtkDataArray& first)
      : name_(first.GetName()),
        in_file_(new_name_in(group, name_)),
        components_(first.GetNumberOfComponents()),
        vtk_type_(first.GetDataType()),
        data_(group, in_file_, type_of(first), components_ > 1 ? components_ : 0,
              Geometries::chunk(first.GetNumberOfTuples())) {
    if (in_file_ != name_) data_.describe("name", name_);
    if (vtkInformation& of = *first.GetInformation(); of.Has(vtkDataArray::UNITS_LABEL()) != 0)
      data_.describe("units", of.Get(vtkDataArray::UNITS_LABEL()));
  }

  void add(vtkFieldData& fields, const fs::path& frame) {
    vtkDataArray* array = fields.GetArray(name_.c_str());
    if (array == nullptr || array->GetNumberOfComponents() != components_ || array->GetDataType() != vtk_type_)
      throw InputError(fmt::format("{}: it lacks the field \"{}\" of the frames before", frame.string(), name_));
    const std::size_t n = array->GetNumberOfTuples(), n_bytes = n * components_ * array->GetDataTypeSize();
    const auto* bytes = static_cast<const char*>(array->GetVoidPointer(0));
    if (offsets_.empty() || !std::equal(last_.begin(), last_.end(), bytes, bytes + n_bytes)) {
      first_row_ = static_cast<std::int64_t>(data_.rows());
      data_.append(bytes, n);
      last_.assign(bytes, bytes + n_bytes);
    }
    offsets_.push_back(first_row_);
  }

  void write_offsets(hid_t steps) const { write_list(steps, in_file_.c_str(), offsets_); }

 private:
  std::string name_, in_file_;
  int components_, vtk_type_;
  GrowingDataset data_;
  std::vector<char> last_;
  std::int64_t first_row_ = 0;
  std::vector<std::int64_t> offsets_;
};

/// A group that keeps the order of what is put into it.
hid_t ordered_group(hid_t root, const std::string& name) {
  const Hdf5Handle ordered(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(ordered, false);
  H5Pset_link_creation_order(ordered, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return H5Gcreate2(root, name.c_str(), H5P_DEFAULT, ordered, H5P_DEFAULT);
}

/// The fields of the cells, of the points, or of the whole, with their two groups in the file.
class SteppedFields {
 public:
  /// Without the field `but`.
  SteppedFields(hid_t root, hid_t steps, const std::string& name, vtkFieldData& first, std::string_view but = {})
      : group_(ordered_group(root, name), H5Gclose),
        steps_(H5Gcreate2(steps, (name + "Offsets").c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose) {
    for (int i = 0; i < first.GetNumberOfArrays(); ++i)
      if (vtkDataArray* array = first.GetArray(i); array != nullptr && array->GetName() != but)
        fields_.emplace_back(group_, *array);
  }

  void add(vtkFieldData& fields, const fs::path& frame) {
    for (SteppedField& field : fields_) field.add(fields, frame);
  }
  void write_offsets() const {
    for (const SteppedField& field : fields_) field.write_offsets(steps_);
  }

 private:
  Hdf5Handle group_, steps_;
  std::deque<SteppedField> fields_;
};

/// What makes frames of the file again (vtkhdf_frames.h).
void write_names(hid_t out, const std::vector<Frame>& frames, vtkUnstructuredGrid& grid) {
  const Hdf5Handle group(H5Gcreate2(out, frame_names_group, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  std::string names;
  for (const Frame& frame : frames) names += frame.file + "\n";
  GrowingDataset(group, "names", hdf5_type<std::uint8_t>(), 0, names.size()).append(names.data(), names.size());
  vtkDataArray* time = grid.GetFieldData()->GetArray("TimeValue");
  if (time != nullptr && time->GetInformation()->Has(vtkDataArray::UNITS_LABEL()) != 0)
    write_hdf5_text(group, "time_unit", time->GetInformation()->Get(vtkDataArray::UNITS_LABEL()));
}

void require_no_polyhedra(const Geometry& geometry, const fs::path& frame) {
  if (std::ranges::count(geometry.types, VTK_POLYHEDRON) > 0)
    throw InputError(fmt::format("{}: files of VTKHDF 2.0 have no polyhedra", frame.string()));
}

void write_frames(const std::vector<Frame>& frames, const fs::path& folder, const fs::path& file) {
  const Hdf5Handle out(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  if (!out.is_open()) throw ComputationError(fmt::format("{} cannot be made", file.string()));
  const Hdf5Handle root(H5Gcreate2(out, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  constexpr std::int64_t version[] = {2, 0};
  write_hdf5_numbers(root, "Version", version, 2, true);
  write_hdf5_text(root, "Type", "UnstructuredGrid");
  const Hdf5Handle steps(H5Gcreate2(root, "Steps", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  const auto n = static_cast<std::int64_t>(frames.size());
  write_hdf5_numbers(steps, "NSteps", &n, 1, false);
  std::optional<Geometries> geometries;
  std::optional<SteppedFields> of_cells, of_points, of_all;
  std::vector<double> times;
  for (const Frame& frame : frames) {
    const fs::path path = folder / frame.file;
    const StoredGrid stored(path);
    vtkUnstructuredGrid& grid = *stored.grid();
    Geometry geometry(grid);
    require_no_polyhedra(geometry, path);
    if (!geometries) {
      write_names(out, frames, grid);
      geometries.emplace(root, geometry);
      of_cells.emplace(root, steps, "CellData", *grid.GetCellData());
      of_points.emplace(root, steps, "PointData", *grid.GetPointData());
      // Steps/Values has the time; of a single frame VTK and ParaView do not read it there.
      of_all.emplace(root, steps, "FieldData", *grid.GetFieldData(), frames.size() > 1 ? "TimeValue" : "");
    }
    geometries->add(std::move(geometry));
    of_cells->add(*grid.GetCellData(), path);
    of_points->add(*grid.GetPointData(), path);
    of_all->add(*grid.GetFieldData(), path);
    times.push_back(frame.time);
  }
  GrowingDataset(steps, "Values", hdf5_type<double>(), 0, times.size()).append(times.data(), times.size());
  geometries->write_numbers(root, steps);
  for (const auto* fields : {&of_cells, &of_points, &of_all}) (*fields)->write_offsets();
  if (H5Fflush(out, H5F_SCOPE_LOCAL) < 0)
    throw ComputationError(fmt::format("{} cannot be written; is the disk full?", file.string()));
}

}  // namespace

void write_vtkhdf(const fs::path& list, const fs::path& file) {
  const std::vector<Frame> frames = read_pvd(list);
  if (frames.empty()) throw InputError(fmt::format("{}: there are no frames", list.string()));
  const QuietHdf5 quiet;
  replace_file(file, [&](const fs::path& temporary) { write_frames(frames, list.parent_path(), temporary); });
}

}  // namespace pfdm
