// read_signals_hdf5() of signal_table.h.

#include "physics/error.h"
#include "postproc/hdf5/hdf5_handle.h"
#include "postproc/records/signal_table.h"

#include <fmt/format.h>

#include <limits>
#include <new>
#include <optional>
#include <set>

namespace pfdm {
namespace {

/// A text attribute, of fixed or variable length.
std::optional<std::string> text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return std::nullopt;
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return std::nullopt;
  if (H5Tis_variable_str(type) > 0) {
    char* text = nullptr;
    const Hdf5Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(memory, H5T_VARIABLE);
    H5Tset_cset(memory, H5Tget_cset(type));
    if (H5Aread(attribute, memory, static_cast<void*>(&text)) < 0 || text == nullptr) return std::nullopt;
    std::string result(text);
    H5free_memory(text);
    return result;
  }
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, text.data()) < 0) return std::nullopt;
  return text.substr(0, text.find('\0'));
}

bool is_number(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

/// Not of scalars: the longest side; all others have one entry.
std::optional<Eigen::Index> vector_length(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1) return std::nullopt;
  std::vector<hsize_t> sides(rank);
  H5Sget_simple_extent_dims(space, sides.data(), nullptr);
  hsize_t length = 1;
  for (const hsize_t side : sides) {
    if (length != 1 && side != 1) return std::nullopt;
    length *= side;
  }
  if (length > std::numeric_limits<Eigen::Index>::max() / sizeof(double)) throw std::bad_alloc();
  return static_cast<Eigen::Index>(length);
}

struct Collected {
  SignalTable table;
  std::set<std::string> left_out;
  std::string fault;
};

/// 0, or -1 for an error, as HDF5 has it. Throws std::bad_alloc: few bytes of a file may promise any number of values.
herr_t collect_dataset(hid_t root, const char* name, Collected& collected) {
  const Hdf5Handle dataset(H5Dopen2(root, name, H5P_DEFAULT), H5Dclose);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  const auto length = vector_length(space);
  if (!is_number(type) || !length) {
    collected.left_out.insert(name);
    return 0;
  }
  SignalColumn column{.name = name, .unit = {}, .values = Eigen::VectorXd(*length)};
  if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()) < 0) {
    collected.fault = fmt::format("the values of \"{}\" cannot be read", name);
    return -1;
  }
  for (const char* attribute : {"unit", "units"})
    if (const auto text = text_attribute(dataset, attribute); text && column.unit.empty()) column.unit = *text;
  collected.table.columns.push_back(std::move(column));
  return 0;
}

/// Called for each object below the root; exceptions must not pass through HDF5.
herr_t collect(hid_t root, const char* name, const H5O_info_t* info, void* user) {
  auto& collected = *static_cast<Collected*>(user);
  try {
    return info->type == H5O_TYPE_DATASET ? collect_dataset(root, name, collected) : 0;
  } catch (const std::bad_alloc&) {
    collected.fault = fmt::format("there is not enough memory for the values of \"{}\"", name);
    return -1;
  }
}

}  // namespace

SignalTable read_signals_hdf5(const std::filesystem::path& path) {
  const QuietHdf5 quiet;
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.is_open()) throw InputError(fmt::format("{}: this is not a readable HDF5 file", path.string()));
  Collected collected{.table = {}, .left_out = {}, .fault = {}};
  if (H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, &collect, &collected, H5O_INFO_BASIC) < 0)
    throw InputError(fmt::format("{}: {}", path.string(),
                                 collected.fault.empty() ? "its contents cannot be listed" : collected.fault));
  if (collected.table.columns.empty())
    throw InputError(fmt::format("{}: it contains no vectors of real numbers ({} other datasets)", path.string(),
                                 collected.left_out.size()));
  collected.table.remark = text_attribute(file, "remark").value_or("");
  return std::move(collected.table);
}

}  // namespace pfdm
