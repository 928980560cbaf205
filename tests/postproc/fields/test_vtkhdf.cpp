// Frames in one file against the frames themselves, read by the HDF5 library alone.

#include "physics/error.h"
#include "postproc/fields/frame.h"
#include "postproc/fields/point_displacement.h"
#include "postproc/fields/pvd.h"
#include "postproc/fields/stored_grid.h"
#include "postproc/fields/vtkhdf.h"
#include "postproc/fields/vtkhdf_frames.h"
#include "postproc/files/atomic_file.h"
#include "postproc/hdf5/hdf5_handle.h"
#include "tests/postproc/awkward_fields.h"
#include "tests/postproc/boxes.h"
#include "tests/postproc/opened_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>

#include <string>

namespace pfdm::test::this_file {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Three frames of a block of 6 x 6 x 6 cells: sound twice, then opened along a diagonal, where points are split.
class OneFile : public ::testing::Test {
 protected:
  OneFile() : mesh_(cube_mesh(1.0, 6)), series_(folder_ / "fields.pvd") {}

  void add(const OutputFields& output, double time) {
    const std::string file = "step_" + std::to_string(series_.frames().size()) + ".vtu";
    const SplitPoints points = point_displacement(mesh_, {}, output, 1.0);
    VtuWriter(mesh_).write(folder_ / file, frame_fields(mesh_, output), time, &points);
    series_.add(time, file);
  }
  /// Across the diagonal, where broken cells touch at edges.
  OutputFields opened() const {
    return opened_fields(mesh_, Vector(1.0, -1.0, 0.0).normalized(), 0.1, 0.02 * Vector::UnitX());
  }
  void write_three() {
    add(sound_fields(mesh_), 0.25);
    add(sound_fields(mesh_), 0.5);
    add(opened(), 1.0);
    write_vtkhdf(folder_ / "fields.pvd", file_);
  }

  template <class Number>
  std::vector<Number> values(const std::string& name, hid_t type) const {
    const Hdf5Handle in(H5Fopen(file_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    const Hdf5Handle data(H5Dopen2(in, ("/VTKHDF/" + name).c_str(), H5P_DEFAULT), H5Dclose);
    const Hdf5Handle space(H5Dget_space(data), H5Sclose);
    std::vector<Number> values(H5Sget_simple_extent_npoints(space));
    if (H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) throw ComputationError(name);
    return values;
  }
  std::vector<long> whole(const std::string& name) const { return values<long>(name, H5T_NATIVE_LONG); }
  std::vector<double> real(const std::string& name) const { return values<double>(name, H5T_NATIVE_DOUBLE); }

  TemporaryFolder folder_;
  Mesh mesh_;
  PvdSeries series_;
  std::filesystem::path file_ = folder_ / "fields.vtkhdf";
};

TEST_F(OneFile, has_each_frame_at_its_place) {
  write_three();
  EXPECT_THAT(real("Steps/Values"), ElementsAre(0.25, 0.5, 1.0));
  const auto part = whole("Steps/PartOffsets"), point = whole("Steps/PointOffsets"), cell = whole("Steps/CellOffsets"),
             corner = whole("Steps/ConnectivityIdOffsets");
  const std::vector<double> points = real("Points");
  const auto n_points = whole("NumberOfPoints"), n_cells = whole("NumberOfCells"), corners = whole("Connectivity"),
             offsets = whole("Offsets"), types = whole("Types");
  for (std::size_t step = 0; step < 3; ++step) {
    const auto grid = read_back(folder_ / series_.frames()[step].file);
    ASSERT_EQ(n_points[part[step]], grid->GetNumberOfPoints());
    ASSERT_EQ(n_cells[part[step]], grid->GetNumberOfCells());
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
      for (int k = 0; k < 3; ++k) EXPECT_EQ(points[3 * (point[step] + p) + k], grid->GetPoint(p)[k]);
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
      grid->GetCellPoints(c, ids);
      const long first = offsets[cell[step] + part[step] + c];  // each part has one offset more than cells
      ASSERT_EQ(offsets[cell[step] + part[step] + c + 1] - first, ids->GetNumberOfIds());
      EXPECT_EQ(types[cell[step] + c], grid->GetCellType(c));
      for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i) EXPECT_EQ(corners[corner[step] + first + i], ids->GetId(i));
    }
  }
}

TEST_F(OneFile, has_the_fields_of_each_frame) {
  write_three();
  for (const auto& [group, of_points] : {std::pair(std::string("CellData"), false), {std::string("PointData"), true}})
    for (std::size_t step = 0; step < 3; ++step) {
      const auto grid = read_back(folder_ / series_.frames()[step].file);
      vtkFieldData* data = of_points ? static_cast<vtkFieldData*>(grid->GetPointData()) : grid->GetCellData();
      ASSERT_GT(data->GetNumberOfArrays(), 0);
      for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
        vtkDataArray& array = *data->GetArray(i);
        const std::string name = array.GetName();
        const std::vector<double> all = real(group + "/" + name);
        const long first = whole("Steps/" + group + "Offsets/" + name)[step] * array.GetNumberOfComponents();
        for (vtkIdType t = 0; t < array.GetNumberOfTuples(); ++t)
          for (int k = 0; k < array.GetNumberOfComponents(); ++k)
            ASSERT_EQ(all[first + t * array.GetNumberOfComponents() + k], array.GetComponent(t, k)) << name;
      }
    }
}

// VTK 9.3 and ParaView 5.13 do not look into Steps where there is one alone.
TEST_F(OneFile, has_the_time_of_a_single_frame_as_a_field) {
  add(opened(), 0.75);
  write_vtkhdf(folder_ / "fields.pvd", file_);
  EXPECT_THAT(real("Steps/Values"), ElementsAre(0.75));
  EXPECT_THAT(real("FieldData/TimeValue"), ElementsAre(0.75));
  EXPECT_THAT(whole("Steps/FieldDataOffsets/TimeValue"), ElementsAre(0));
}

TEST_F(OneFile, has_once_what_stays) {
  write_three();
  EXPECT_THAT(whole("Steps/PartOffsets"), ElementsAre(0, 0, 1));  // points are split in the last frame
  EXPECT_THAT(whole("Steps/CellDataOffsets/material"), ElementsAre(0, 0, 0));
  EXPECT_EQ(whole("CellData/material").size(), 216u);
  EXPECT_THAT(whole("Steps/CellDataOffsets/damage"), ElementsAre(0, 0, 216));
}

/// What both have by name, to the last bit.
void expect_same(vtkFieldData& a, vtkFieldData& b) {
  ASSERT_EQ(a.GetNumberOfArrays(), b.GetNumberOfArrays());
  for (int i = 0; i < a.GetNumberOfArrays(); ++i) {
    vtkDataArray& one = *a.GetArray(i);
    vtkDataArray* other = b.GetArray(one.GetName());
    ASSERT_NE(other, nullptr) << one.GetName();
    ASSERT_EQ(one.GetDataType(), other->GetDataType()) << one.GetName();
    ASSERT_EQ(one.GetNumberOfComponents(), other->GetNumberOfComponents());
    ASSERT_EQ(one.GetNumberOfTuples(), other->GetNumberOfTuples());
    for (vtkIdType t = 0; t < one.GetNumberOfTuples(); ++t)
      for (int k = 0; k < one.GetNumberOfComponents(); ++k)
        ASSERT_EQ(one.GetComponent(t, k), other->GetComponent(t, k)) << one.GetName();
    const std::string component = one.GetComponentName(0) == nullptr ? "" : one.GetComponentName(0);
    EXPECT_EQ(component, other->GetComponentName(0) == nullptr ? "" : other->GetComponentName(0)) << one.GetName();
    const auto unit = [](vtkDataArray& array) -> std::string {
      const char* text = array.GetInformation()->Get(vtkDataArray::UNITS_LABEL());
      return text == nullptr ? "" : text;
    };
    EXPECT_EQ(unit(one), unit(*other)) << one.GetName();
  }
}

void expect_same(vtkUnstructuredGrid& a, vtkUnstructuredGrid& b) {
  ASSERT_EQ(a.GetNumberOfPoints(), b.GetNumberOfPoints());
  ASSERT_EQ(a.GetNumberOfCells(), b.GetNumberOfCells());
  for (vtkIdType p = 0; p < a.GetNumberOfPoints(); ++p)
    for (int k = 0; k < 3; ++k) ASSERT_EQ(a.GetPoint(p)[k], b.GetPoint(p)[k]);
  vtkNew<vtkIdList> one, other;
  for (vtkIdType c = 0; c < a.GetNumberOfCells(); ++c) {
    ASSERT_EQ(a.GetCellType(c), b.GetCellType(c));
    a.GetCellPoints(c, one);
    b.GetCellPoints(c, other);
    ASSERT_EQ(one->GetNumberOfIds(), other->GetNumberOfIds());
    for (vtkIdType i = 0; i < one->GetNumberOfIds(); ++i) ASSERT_EQ(one->GetId(i), other->GetId(i));
  }
  expect_same(*a.GetCellData(), *b.GetCellData());
  expect_same(*a.GetPointData(), *b.GetPointData());
  expect_same(*a.GetFieldData(), *b.GetFieldData());
}

TEST_F(OneFile, gives_the_frames_back) {
  mesh_.region_names = {"a<b> & 'c'"};
  write_three();
  EXPECT_EQ(frames_in(file_), series_.frames());
  for (std::size_t k = 0; k < 3; ++k)
    expect_same(*read_back(folder_ / series_.frames()[k].file), *StoredGrid(frame_in_one_file(file_, k)).grid());
}

TEST_F(OneFile, is_unpacked_to_the_frames_that_it_was_made_of) {
  mesh_.region_names = {"a<b> & 'c'/d|e"};
  write_three();
  const TemporaryFolder other;
  unpack_frames(file_, other / "fields.pvd", Compression::zlib);
  EXPECT_EQ(read_pvd(other / "fields.pvd"), series_.frames());
  for (const Frame& frame : series_.frames())
    expect_same(*read_back(folder_ / frame.file), *read_back(other / frame.file));
}

TEST_F(OneFile, that_is_damaged_is_refused) {
  write_three();
  EXPECT_THROW(StoredGrid(frame_in_one_file(file_, 3)), InputError);  // there are three
  EXPECT_THROW(StoredGrid(file_ / "one"), InputError);
  EXPECT_THROW(StoredGrid(folder_ / "none.vtkhdf" / "0"), InputError);
  const std::string whole = content_of(file_);
  for (const std::size_t size : {whole.size() / 8, whole.size() / 2, whole.size() - 1}) {
    write_file(file_, whole.substr(0, size));
    EXPECT_THROW(StoredGrid(frame_in_one_file(file_, 2)), InputError) << size;
    EXPECT_THROW(frames_in(file_), InputError) << size;
  }
}

TEST_F(OneFile, has_regions_with_slashes) {
  mesh_.region_names = {"glass/one"};
  write_three();
  EXPECT_NE(StoredGrid(frame_in_one_file(file_, 0)).grid()->GetFieldData()->GetArray("region_glass/one"), nullptr);
}

TEST_F(OneFile, keeps_regions_apart_whose_names_differ_in_slashes) {
  mesh_.region_names = {"a/b", "a|b", "a/b|", "a|b/"};
  write_three();
  for (std::size_t k = 0; k < 3; ++k)
    expect_same(*read_back(folder_ / series_.frames()[k].file), *StoredGrid(frame_in_one_file(file_, k)).grid());
}

TEST_F(OneFile, of_polyhedra_is_refused_and_leaves_none) {
  mesh_ = mesh_of_all_shapes();
  try {
    add(sound_fields(mesh_), 0.5);
    write_vtkhdf(folder_ / "fields.pvd", file_);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("polyhedra"));
  }
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(OneFile, needs_the_same_fields_in_all_frames) {
  add(sound_fields(mesh_), 0.5);
  const OutputFields output = sound_fields(mesh_);
  VtuWriter(mesh_).write(folder_ / "other.vtu", {{"damage", &output.damage}}, 1.0);
  series_.add(1.0, "other.vtu");
  EXPECT_THROW(write_vtkhdf(folder_ / "fields.pvd", file_), InputError);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace pfdm::test::this_file
