// read_signals_mat() of signal_table.h. The only place that knows matio.

#include "physics/error.h"
#include "postproc/records/signal_table.h"

#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

namespace pfdm {
namespace {

using File = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

constexpr std::size_t most_columns = 256;  // of a matrix whose columns are signals

template <class Number>
Eigen::MatrixXd converted(const matvar_t& v, Eigen::Index rows, Eigen::Index columns) {
  return Eigen::Map<const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>>(static_cast<const Number*>(v.data),
                                                                                 rows, columns)
      .template cast<double>();
}

std::optional<Eigen::MatrixXd> matrix_of(const matvar_t& v) {
  if (v.rank != 2 || v.isComplex != 0 || v.data == nullptr) return std::nullopt;
  const auto rows = static_cast<Eigen::Index>(v.dims[0]), columns = static_cast<Eigen::Index>(v.dims[1]);
  switch (v.class_type) {
    case MAT_C_DOUBLE: return converted<double>(v, rows, columns);
    case MAT_C_SINGLE: return converted<float>(v, rows, columns);
    case MAT_C_INT32: return converted<std::int32_t>(v, rows, columns);
    case MAT_C_INT16: return converted<std::int16_t>(v, rows, columns);
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

struct Found {
  std::vector<SignalColumn> columns;
  std::map<std::string, std::string> texts;
};

/// A vector by its name, the columns of a matrix as NAME(:,1) ..., the rows of one that is wider than long as NAME(1,:)
/// ...; of a text NAME_unit the unit of all of them.
void add_matrix(const std::string& name, const Eigen::MatrixXd& values, Found& found) {
  const auto add = [&](const std::string& called, Eigen::VectorXd column) {
    found.columns.push_back({called, "", std::move(column)});
  };
  if (values.rows() == 1 || values.cols() == 1) return add(name, values.reshaped());
  if (static_cast<std::size_t>(std::min(values.rows(), values.cols())) > most_columns) return;
  if (values.rows() >= values.cols()) {
    for (Eigen::Index k = 0; k < values.cols(); ++k) add(fmt::format("{}(:,{})", name, k + 1), values.col(k));
  } else {
    for (Eigen::Index k = 0; k < values.rows(); ++k) add(fmt::format("{}({},:)", name, k + 1), values.row(k));
  }
}

void add_variable(const std::string& name, const matvar_t& v, Found& found);

/// Fields as NAME.FIELD, of an array of structures as NAME(2).FIELD.
void add_structure(const std::string& name, const matvar_t& v, Found& found) {
  std::size_t n = v.rank > 0 ? 1 : 0;
  for (int i = 0; i < v.rank; ++i) n *= v.dims[i];
  const unsigned n_fields = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&v));
  char* const* fields = Mat_VarGetStructFieldnames(&v);
  for (std::size_t i = 0; i < n; ++i)
    for (unsigned f = 0; f < n_fields; ++f) {
      const matvar_t* field = Mat_VarGetStructFieldByIndex(const_cast<matvar_t*>(&v), f, i);
      const std::string whole = n > 1 ? fmt::format("{}({})", name, i + 1) : name;
      if (field != nullptr) add_variable(fmt::format("{}.{}", whole, fields[f]), *field, found);
    }
}

void add_variable(const std::string& name, const matvar_t& v, Found& found) {
  if (v.class_type == MAT_C_STRUCT) return add_structure(name, v, found);
  if (const auto values = matrix_of(v); values && values->size() > 0) add_matrix(name, *values, found);
  if (auto text = text_of(v)) found.texts[name] = std::move(*text);
}

/// "rec.base" of "rec.base(:,2)"; of others themselves.
std::string without_index(const std::string& name) {
  return name.ends_with(')') ? name.substr(0, name.rfind('(')) : name;
}

}  // namespace

SignalTable read_signals_mat(const std::filesystem::path& path) {
  const File file(Mat_Open(path.c_str(), MAT_ACC_RDONLY), &Mat_Close);
  if (!file) throw InputError(fmt::format("{}: this is not a readable MATLAB file", path.string()));
  Found found;
  for (;;) {
    const Variable variable(Mat_VarReadNext(file.get()), &Mat_VarFree);
    if (!variable) break;
    if (variable->name != nullptr) add_variable(variable->name, *variable, found);
  }
  SignalTable table{.remark = {}, .columns = std::move(found.columns)};
  for (SignalColumn& column : table.columns)
    if (const auto unit = found.texts.find(without_index(column.name) + "_unit"); unit != found.texts.end())
      column.unit = unit->second;
  if (const auto remark = found.texts.find("remark"); remark != found.texts.end()) table.remark = remark->second;
  if (table.columns.empty())
    throw InputError(fmt::format("{}: it contains no real vectors or matrices", path.string()));
  return table;
}

}  // namespace pfdm
