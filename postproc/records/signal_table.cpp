#include "postproc/records/signal_table.h"

#include "physics/error.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace pfdm {
namespace {

std::optional<double> number(std::string_view cell) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  return parse_double(cell);
}

class CsvReader {
 public:
  explicit CsvReader(const std::filesystem::path& path) : path_(path), content_(read_file(path)), rest_(content_) {}

  SignalTable read() {
    while (next_line()) take(line_);
    if (n_rows_ < 2) throw InputError(fmt::format("{}: expected a row of names and a row of units", path_.string()));
    SignalTable table{.remark = remark_, .columns = {}};
    for (std::size_t i = 0; i < names_.size(); ++i)
      table.columns.push_back(
          {names_[i], units_[i], Eigen::Map<Eigen::VectorXd>(values_[i].data(), std::ssize(values_[i]))});
    return table;
  }

 private:
  bool next_line() {
    if (rest_.empty()) return false;
    line_ = take_line(rest_);
    ++line_number_;
    return true;
  }

  void take(std::string_view line) {
    if (line.empty()) return;
    if (line.front() == '#') {
      remark_ += (remark_.empty() ? "" : "\n") + std::string(trimmed(line.substr(1)));
      return;
    }
    const auto row = split_at_commas(line);
    if (n_rows_ > 0 && row.size() != names_.size())
      throw error(fmt::format("found {} entries in a table of {} columns", row.size(), names_.size()));
    if (n_rows_ == 0) names_.assign(row.begin(), row.end());
    if (n_rows_ == 1) units_.assign(row.begin(), row.end());
    values_.resize(row.size());
    for (std::size_t i = 0; n_rows_ >= 2 && i < row.size(); ++i) {
      const auto value = number(row[i]);
      if (!value) throw error(fmt::format("\"{}\" is not a number", row[i]));
      values_[i].push_back(*value);
    }
    if (n_rows_ == 1 && parse_double(row.front()))
      throw error("expected a row of units, as in \"s,m/s^2,m/s^2\", found numbers");
    ++n_rows_;
  }

  InputError error(const std::string& message) const {
    return InputError(fmt::format("{}, line {}: {}", path_.string(), line_number_, message));
  }

  const std::filesystem::path& path_;
  std::string content_;
  std::string_view rest_;
  std::string_view line_;
  std::size_t line_number_ = 0;
  std::size_t n_rows_ = 0;
  std::string remark_;
  std::vector<std::string> names_;
  std::vector<std::string> units_;
  std::vector<std::vector<double>> values_;
};

std::string remark_lines(const std::string& remark) {
  std::string lines;
  std::string_view rest = remark;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    lines += fmt::format("# {}\n", rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  return lines;
}

}  // namespace

SignalTable read_signals_csv(const std::filesystem::path& path) { return CsvReader(path).read(); }

void write_signals_csv(const std::filesystem::path& path, const SignalTable& table) {
  std::string text = remark_lines(table.remark);
  const std::size_t n = table.columns.size();
  const auto end_of = [n](std::size_t i) { return i + 1 < n ? ',' : '\n'; };
  for (std::size_t i = 0; i < n; ++i) text += table.columns[i].name + end_of(i);
  for (std::size_t i = 0; i < n; ++i) text += table.columns[i].unit + end_of(i);
  for (Eigen::Index row = 0; n > 0 && row < table.columns.front().values.size(); ++row)
    for (std::size_t i = 0; i < n; ++i)
      fmt::format_to(std::back_inserter(text), "{}{}", table.columns[i].values[row], end_of(i));
  write_file(path, text);
}

SignalTable read_signals(const std::filesystem::path& path) {
  using Reader = SignalTable (*)(const std::filesystem::path&);
  constexpr std::pair<std::string_view, Reader> readers[] = {{".csv", read_signals_csv}, {".mat", read_signals_mat},
                                                             {".uff", read_signals_uff}, {".unv", read_signals_uff},
                                                             {".h5", read_signals_hdf5}, {".hdf5", read_signals_hdf5}};
  for (const auto& [extension, read] : readers)
    if (path.extension() == extension) return read(path);
  throw InputError(fmt::format("{}: records are read from .csv, .mat, .uff, .unv, .h5 and .hdf5 files", path.string()));
}

}  // namespace pfdm
