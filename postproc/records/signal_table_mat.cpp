// read_signals_mat() of signal_table.h. The only place that knows matio.

#include "physics/error.h"
#include "postproc/records/signal_table.h"

#include <fmt/format.h>
#include <matio.h>

#include <map>
#include <memory>
#include <optional>

namespace pfdm {
namespace {

using File = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

template <class Number>
Eigen::VectorXd converted(const matvar_t& v, Eigen::Index n) {
  return Eigen::Map<const Eigen::Matrix<Number, Eigen::Dynamic, 1>>(static_cast<const Number*>(v.data), n)
      .template cast<double>();
}

std::optional<Eigen::VectorXd> vector_of(const matvar_t& v) {
  if (v.rank != 2 || v.isComplex != 0 || v.data == nullptr || (v.dims[0] != 1 && v.dims[1] != 1)) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(v.dims[0] * v.dims[1]);
  switch (v.class_type) {
    case MAT_C_DOUBLE: return converted<double>(v, n);
    case MAT_C_SINGLE: return converted<float>(v, n);
    case MAT_C_INT32: return converted<std::int32_t>(v, n);
    case MAT_C_INT16: return converted<std::int16_t>(v, n);
    default: return std::nullopt;
  }
}

std::optional<std::string> text_of(const matvar_t& v) {
  if (v.class_type != MAT_C_CHAR || v.data == nullptr) return std::nullopt;
  const std::size_t n = v.nbytes / static_cast<std::size_t>(v.data_size);
  std::string text;
  for (std::size_t i = 0; i < n; ++i)
    text += v.data_size == 2 ? static_cast<char>(static_cast<const std::uint16_t*>(v.data)[i])
                             : static_cast<const char*>(v.data)[i];
  return text;
}

}  // namespace

SignalTable read_signals_mat(const std::filesystem::path& path) {
  const File file(Mat_Open(path.c_str(), MAT_ACC_RDONLY), &Mat_Close);
  if (!file) throw InputError(fmt::format("{}: this is not a readable MATLAB file", path.string()));
  SignalTable table;
  std::map<std::string, std::string> texts;
  for (;;) {
    const Variable variable(Mat_VarReadNext(file.get()), &Mat_VarFree);
    if (!variable) break;
    if (variable->name == nullptr) continue;
    if (auto values = vector_of(*variable)) table.columns.push_back({variable->name, "", std::move(*values)});
    if (auto text = text_of(*variable)) texts[variable->name] = std::move(*text);
  }
  for (SignalColumn& column : table.columns)
    if (const auto unit = texts.find(column.name + "_unit"); unit != texts.end()) column.unit = unit->second;
  if (const auto remark = texts.find("remark"); remark != texts.end()) table.remark = remark->second;
  if (table.columns.empty()) throw InputError(fmt::format("{}: it contains no real vectors", path.string()));
  return table;
}

}  // namespace pfdm
