#include "postproc/hdf5/growing_dataset.h"

#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace pfdm {
namespace {

constexpr unsigned compression_level = 1;  // higher levels take twice the time for a few per cent of the size

void require(bool done, const std::string& what) {
  if (!done) throw ComputationError(fmt::format("HDF5 cannot write \"{}\"", what));
}

Hdf5Handle plain_list(hsize_t n) { return {H5Screate_simple(1, &n, nullptr), H5Sclose}; }

}  // namespace

template <>
hid_t hdf5_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t hdf5_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t hdf5_type<int>() {
  return H5T_NATIVE_INT;
}
template <>
hid_t hdf5_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t hdf5_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

GrowingDataset::GrowingDataset(hid_t group, const std::string& name, hid_t type, hsize_t columns, hsize_t chunk)
    : name_(name), type_(type), columns_(columns) {
  const int rank = columns > 0 ? 2 : 1;
  const std::array<hsize_t, 2> none{0, columns}, any{H5S_UNLIMITED, columns},
      part{std::max<hsize_t>(chunk, 1), columns};
  const Hdf5Handle space(H5Screate_simple(rank, none.data(), any.data()), H5Sclose);
  const Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(layout, rank, part.data());
  H5Pset_shuffle(layout);
  H5Pset_obj_track_times(layout, false);  // the same content is the same file
  H5Pset_deflate(layout, compression_level);
  dataset_ = std::make_unique<Hdf5Handle>(
      H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose);
  require(dataset_->is_open(), name);
}

void GrowingDataset::append(const void* values, hsize_t rows) {
  if (rows == 0) return;
  const int rank = columns_ > 0 ? 2 : 1;
  const std::array<hsize_t, 2> from{rows_, 0}, count{rows, columns_}, whole{rows_ + rows, columns_};
  require(H5Dset_extent(*dataset_, whole.data()) >= 0, name_);
  const Hdf5Handle in_file(H5Dget_space(*dataset_), H5Sclose);
  H5Sselect_hyperslab(in_file, H5S_SELECT_SET, from.data(), nullptr, count.data(), nullptr);
  const Hdf5Handle in_memory(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
  require(H5Dwrite(*dataset_, type_, in_memory, in_file, H5P_DEFAULT, values) >= 0, name_);
  rows_ += rows;
}

void GrowingDataset::describe(const char* attribute, const std::string& text) {
  write_hdf5_text(*dataset_, attribute, text);
}

void write_hdf5_text(hid_t object, const char* name, const std::string& text) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const Hdf5Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require(attribute.is_open() && H5Awrite(attribute, type, text.c_str()) >= 0, name);
}

void write_hdf5_numbers(hid_t object, const char* name, const std::int64_t* values, hsize_t n, bool is_list) {
  const Hdf5Handle space = is_list ? plain_list(n) : Hdf5Handle(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name, H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require(attribute.is_open() && H5Awrite(attribute, H5T_NATIVE_INT64, values) >= 0, name);
}

}  // namespace pfdm
