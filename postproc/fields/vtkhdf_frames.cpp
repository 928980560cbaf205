#include "postproc/fields/vtkhdf_frames.h"

#include "physics/error.h"
#include "postproc/fields/stored_grid.h"
#include "postproc/fields/vtk_arrays.h"
#include "postproc/fields/vtkhdf.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/text_file.h"
#include "postproc/hdf5/growing_dataset.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// A file of frames. Whatever it lacks is an InputError.
class FrameFile {
 public:
  explicit FrameFile(const fs::path& file)
      : name_(file.string()), in_(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose) {
    if (!in_.is_open()) throw InputError(fmt::format("{}: this is no file of HDF5 that can be read", name_));
  }

  InputError lacks(const std::string& what) const {
    return InputError(
        fmt::format("{}: this is not a file of frames that pfdm wrote: \"{}\" is missing or damaged", name_, what));
  }

  Hdf5Handle dataset(const std::string& path) const {
    const hid_t data = H5Dopen2(in_, path.c_str(), H5P_DEFAULT);
    if (data < 0) throw lacks(path);
    return {data, H5Dclose};
  }

  /// Rows and columns; 1 column of a list.
  std::array<hsize_t, 2> size_of(hid_t data, const std::string& path) const {
    const Hdf5Handle space(H5Dget_space(data), H5Sclose);
    std::array<hsize_t, 2> size{0, 1};
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, size.data(), nullptr) < 0) throw lacks(path);
    return size;
  }

  /// `rows` rows of a dataset from row `first` on.
  void read(const std::string& path, hid_t type, std::int64_t first, std::int64_t rows, void* values) const {
    const Hdf5Handle data = dataset(path);
    const std::array<hsize_t, 2> size = size_of(data, path);
    if (first < 0 || rows < 0 || static_cast<hsize_t>(first + rows) > size[0]) throw lacks(path);
    if (rows == 0) return;
    const std::array<hsize_t, 2> from{static_cast<hsize_t>(first), 0}, count{static_cast<hsize_t>(rows), size[1]};
    const Hdf5Handle in_file(H5Dget_space(data), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(in_file);
    H5Sselect_hyperslab(in_file, H5S_SELECT_SET, from.data(), nullptr, count.data(), nullptr);
    const Hdf5Handle in_memory(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
    if (H5Dread(data, type, in_memory, in_file, H5P_DEFAULT, values) < 0) throw lacks(path);
  }

  template <class Number>
  std::vector<Number> list(const std::string& path) const {
    const auto rows = static_cast<std::int64_t>(size_of(dataset(path), path)[0]);
    std::vector<Number> values(rows);
    read(path, hdf5_type<Number>(), 0, rows, values.data());
    return values;
  }

  /// An entry of a list of whole numbers.
  std::int64_t number(const std::string& path, std::int64_t at) const {
    std::int64_t value = 0;
    read(path, hdf5_type<std::int64_t>(), at, 1, &value);
    return value;
  }

  /// A text at a dataset or group; empty if there is none.
  std::string attribute(const std::string& path, const char* name) const {
    if (H5Aexists_by_name(in_, path.c_str(), name, H5P_DEFAULT) <= 0) return {};
    const Hdf5Handle at(H5Aopen_by_name(in_, path.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const Hdf5Handle type(H5Aget_type(at), H5Tclose);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) return {};
    std::string text(H5Tget_size(type), '\0');
    if (H5Aread(at, type, text.data()) < 0) return {};
    return text.c_str();
  }

  std::vector<std::string> names_in(const std::string& group) const {
    std::vector<std::string> names;
    const Hdf5Handle opened(H5Gopen2(in_, group.c_str(), H5P_DEFAULT), H5Gclose);
    if (!opened.is_open()) return names;
    H5G_info_t info;
    if (H5Gget_info(opened, &info) < 0) throw lacks(group);
    for (hsize_t i = 0; i < info.nlinks; ++i) {
      constexpr std::size_t longest = 1024;
      std::string name(longest, '\0');
      if (H5Lget_name_by_idx(opened, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, name.data(), longest, H5P_DEFAULT) < 0)
        throw lacks(group);
      names.emplace_back(name.c_str());
    }
    return names;
  }

 private:
  std::string name_;
  Hdf5Handle in_;
};

vtkSmartPointer<vtkDataArray> array_of(hid_t type) {
  const bool is_real = H5Tget_class(type) == H5T_FLOAT;
  if (is_real && H5Tget_size(type) == sizeof(float)) return vtkSmartPointer<vtkFloatArray>::New();
  if (is_real) return vtkSmartPointer<vtkDoubleArray>::New();
  return vtkSmartPointer<vtkIntArray>::New();
}

hid_t type_in_memory(const vtkDataArray& array) {
  switch (array.GetDataType()) {
    case VTK_FLOAT: return hdf5_type<float>();
    case VTK_DOUBLE: return hdf5_type<double>();
    default: return hdf5_type<int>();
  }
}

/// A field of frame `k` with `n` values.
vtkSmartPointer<vtkDataArray> field_of(const FrameFile& in, const std::string& group, const std::string& name,
                                       std::int64_t k, std::int64_t n) {
  const std::string path = fmt::format("/VTKHDF/{}/{}", group, name);
  const Hdf5Handle data = in.dataset(path), type(H5Dget_type(data), H5Tclose);
  vtkSmartPointer<vtkDataArray> array = array_of(type);
  array->SetNumberOfComponents(static_cast<int>(in.size_of(data, path)[1]));
  array->SetNumberOfTuples(n);
  const std::string given = in.attribute(path, "name");
  name_array(*array, given.empty() ? name : given, in.attribute(path, "units"));
  constexpr std::array<const char*, 6> symmetric{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  if (array->GetNumberOfComponents() == static_cast<int>(symmetric.size()))
    for (std::size_t i = 0; i < symmetric.size(); ++i) array->SetComponentName(static_cast<vtkIdType>(i), symmetric[i]);
  in.read(path, type_in_memory(*array), in.number(fmt::format("/VTKHDF/Steps/{}Offsets/{}", group, name), k), n,
          array->GetVoidPointer(0));
  return array;
}

/// Points and cells of frame `k`.
vtkSmartPointer<vtkUnstructuredGrid> geometry_of(const FrameFile& in, std::int64_t k) {
  const std::string root = "/VTKHDF/", steps = "/VTKHDF/Steps/";
  const std::int64_t part = in.number(steps + "PartOffsets", k), n_points = in.number(root + "NumberOfPoints", part),
                     n_cells = in.number(root + "NumberOfCells", part),
                     n_corners = in.number(root + "NumberOfConnectivityIds", part),
                     first_cell = in.number(steps + "CellOffsets", k);
  if (n_points < 0 || n_cells < 1 || n_corners < 0) throw in.lacks("NumberOfCells");
  vtkNew<vtkDoubleArray> places;
  places->SetNumberOfComponents(3);
  places->SetNumberOfTuples(n_points);
  in.read(root + "Points", hdf5_type<double>(), in.number(steps + "PointOffsets", k), n_points,
          places->GetVoidPointer(0));
  vtkNew<vtkTypeInt64Array> offsets, connectivity;
  offsets->SetNumberOfValues(n_cells + 1);
  connectivity->SetNumberOfValues(n_corners);
  // Each part has one offset more than cells.
  in.read(root + "Offsets", hdf5_type<std::int64_t>(), first_cell + part, n_cells + 1, offsets->GetVoidPointer(0));
  in.read(root + "Connectivity", hdf5_type<std::int64_t>(), in.number(steps + "ConnectivityIdOffsets", k), n_corners,
          connectivity->GetVoidPointer(0));
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(n_cells);
  in.read(root + "Types", hdf5_type<std::uint8_t>(), first_cell, n_cells, types->GetVoidPointer(0));
  const vtkTypeInt64 *begin = offsets->GetPointer(0), *end = begin + n_cells + 1;
  const bool rises = std::is_sorted(begin, end) && *begin == 0 && end[-1] == n_corners;
  const auto* corners = connectivity->GetPointer(0);
  if (!rises || std::any_of(corners, corners + n_corners, [&](auto p) { return p < 0 || p >= n_points; }))
    throw in.lacks("Connectivity");
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(places);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  grid->SetCells(types, cells);
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> frame_of(const FrameFile& in, std::int64_t k) {
  vtkSmartPointer<vtkUnstructuredGrid> grid = geometry_of(in, k);
  for (const std::string& name : in.names_in("/VTKHDF/CellData"))
    grid->GetCellData()->AddArray(field_of(in, "CellData", name, k, grid->GetNumberOfCells()));
  for (const std::string& name : in.names_in("/VTKHDF/PointData"))
    grid->GetPointData()->AddArray(field_of(in, "PointData", name, k, grid->GetNumberOfPoints()));
  for (const std::string& name : in.names_in("/VTKHDF/FieldData"))
    grid->GetFieldData()->AddArray(field_of(in, "FieldData", name, k, 1));
  double time = 0.0;
  in.read("/VTKHDF/Steps/Values", hdf5_type<double>(), k, 1, &time);
  grid->GetFieldData()->AddArray(vtk_time(time, in.attribute(frame_names_group, "time_unit")));
  return grid;
}

std::vector<Frame> frames_of(const FrameFile& in) {
  const std::vector<double> times = in.list<double>("/VTKHDF/Steps/Values");
  const std::vector<std::uint8_t> text = in.list<std::uint8_t>(fmt::format("{}/names", frame_names_group));
  std::vector<Frame> frames;
  for (std::string_view rest(reinterpret_cast<const char*>(text.data()), text.size()); !rest.empty();) {
    if (frames.size() == times.size()) throw in.lacks("names");
    frames.push_back({times[frames.size()], std::string(take_line(rest))});
  }
  if (frames.size() != times.size()) throw in.lacks("names");
  return frames;
}

}  // namespace

fs::path frame_in_one_file(const fs::path& file, std::size_t number) { return file / std::to_string(number); }

bool is_in_one_file(const fs::path& frame) { return frame.parent_path().extension() == vtkhdf_extension; }

std::vector<Frame> frames_in(const fs::path& file) {
  const QuietHdf5 quiet;
  return frames_of(FrameFile(file));
}

vtkSmartPointer<vtkUnstructuredGrid> read_frame_in_one_file(const fs::path& frame) {
  const QuietHdf5 quiet;
  const auto number = parse_int(frame.filename().string());
  const FrameFile in(frame.parent_path());
  if (!number) throw in.lacks(frame.filename().string());
  return frame_of(in, *number);
}

void unpack_frames(const fs::path& file, const fs::path& list, Compression compression) {
  const QuietHdf5 quiet;
  const FrameFile in(file);
  const std::vector<Frame> frames = frames_of(in);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const fs::path path = list.parent_path() / frames[k].file;
    make_folder(path.parent_path());
    write_grid(path, *frame_of(in, static_cast<std::int64_t>(k)), compression);
  }
  replace_file(list, [&](const fs::path& temporary) {
    PvdSeries series(temporary);
    for (const Frame& frame : frames) series.add(frame.time, frame.file);
  });
}

}  // namespace pfdm
