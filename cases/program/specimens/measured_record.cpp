#include "cases/program/specimens/measured_record.h"

#include "cases/program/input/config/toml_document.h"
#include "cases/program/input/config/units.h"
#include "physics/error.h"
#include "physics/quantity_text.h"
#include "postproc/files/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

/// A quantity of a record: how machines call it, most telling first.
struct RecordedQuantity {
  std::string_view key;   ///< in [[experiment.specimens]]
  std::string_view word;  ///< of --set
  const Dimension* due;
  std::string_view unit;  ///< where the file has none
  std::size_t place;      ///< of the column in a file without names
  bool is_required;
  std::vector<std::string_view> names;
};

const std::vector<RecordedQuantity>& recorded_quantities() {
  static const std::vector<RecordedQuantity> all{
      {"crack_length",
       "crack_length_column",
       &dimension::length,
       "mm",
       2,
       false,
       {"crack", "risslänge", "risslaenge", "a (mm)", "a_mm"}},
      {"displacement",
       "displacement_column",
       &dimension::length,
       "mm",
       0,
       true,
       {"displacement", "opening", "extension", "deflection", "crosshead", "stroke", "standardweg", "traverse", "weg",
        "cod", "disp"}},
      {"force", "force_column", &dimension::force, "N", 1, true, {"force", "load", "standardkraft", "kraft"}}};
  return all;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::optional<std::size_t> column_of(const CsvTable& table, const RecordedQuantity& quantity,
                                     const std::vector<std::size_t>& taken) {
  if (!table.has_names()) return quantity.place < table.columns.size() ? std::optional(quantity.place) : std::nullopt;
  for (const std::string_view name : quantity.names)
    for (std::size_t i = 0; i < table.names.size(); ++i)
      if (lower(table.names[i]).find(name) != std::string::npos && std::ranges::count(taken, i) == 0) return i;
  return std::nullopt;
}

/// Unit of a column that the file states, in whichever of its three places.
std::string stated_unit(const CsvTable& table, std::size_t column, const Dimension& due) {
  if (!table.units.empty() && is_unit_of(table.units[column], due)) return table.units[column];
  const std::string& name = table.names[column];
  const std::size_t end = name.rfind('_');
  return end != std::string::npos && is_unit_of(name.substr(end + 1), due) ? name.substr(end + 1) : "";
}

struct FoundColumn {
  const RecordedQuantity* quantity;
  std::size_t column;
  std::string unit, stated;
  std::vector<double> values;  ///< SI
};

FoundColumn found_column(const CsvTable& table, const RecordedQuantity& quantity, std::size_t column) {
  table.require_numbers(column);
  FoundColumn found{&quantity, column, "", stated_unit(table, column, *quantity.due), table.columns[column]};
  found.unit = found.stated.empty() ? std::string(quantity.unit) : found.stated;
  for (double& value : found.values) value *= unit_in_si(found.unit, *quantity.due);
  return found;
}

InputError not_recognised(const std::filesystem::path& csv, const CsvTable& table, const RecordedQuantity& quantity) {
  return InputError(fmt::format("{}: no column of it is known for a {}; --set {}=NAME says which one is (columns: {})",
                                csv.string(), quantity.key, quantity.word, fmt::join(table.names, ", ")));
}

std::vector<FoundColumn> found_columns(const std::filesystem::path& csv, const CsvTable& table,
                                       const std::map<std::string, std::string>& named) {
  std::vector<FoundColumn> found;
  std::vector<std::size_t> taken;
  for (const RecordedQuantity& quantity : recorded_quantities()) {
    const auto name = named.find(std::string(quantity.word));
    const auto column =
        name != named.end() ? std::optional(table.find(name->second)) : column_of(table, quantity, taken);
    if (!column && quantity.is_required) throw not_recognised(csv, table, quantity);
    if (!column) continue;
    taken.push_back(*column);
    found.push_back(found_column(table, quantity, *column));
  }
  return found;
}

std::string column_text(const CsvTable& table, const FoundColumn& found, bool is_turned) {
  const std::string column =
      table.has_names() ? quoted_toml(without_unit(table.names[found.column])) : fmt::format("{}", found.column + 1);
  return fmt::format("{} = {{ column = {}, unit = \"{}\"{} }}\n", found.quantity->key, column, found.unit,
                     is_turned && found.quantity->key != "crack_length" ? ", factor = -1" : "");
}

/// How far displacements lie below earlier ones, over their range.
double fall_of(const std::vector<double>& x, double sign) {
  double top = -INFINITY, least = INFINITY, depth = 0.0;
  for (const double value : x) {
    if (std::isnan(value)) continue;
    top = std::max(top, sign * value);
    least = std::min(least, sign * value);
    depth = std::max(depth, top - sign * value);
  }
  return top > least ? depth / (top - least) : 0.0;
}

double largest(const std::vector<double>& values, double sign) {
  double most = -INFINITY;
  for (const double value : values)
    if (!std::isnan(value)) most = std::max(most, sign * value);
  return most;
}

/// Keys for displacements that fall, and a sentence of it.
std::string treatment_of(const std::vector<double>& x, double sign, std::vector<std::string>& remarks) {
  constexpr double noise = 0.01;
  const double fall = fall_of(x, sign);
  if (fall == 0.0) return "";
  const double range = largest(x, sign) + largest(x, -sign);
  const double jitter = 1.001 * std::min(fall, noise) * range;
  const std::string moved = quantity_text(jitter, "m", 3);
  std::string text;
  if (fall > noise) {
    text += "loops = \"envelope\"                # the displacement goes back: unloading is left out\n";
    remarks.emplace_back("the displacement goes back: loops = \"envelope\" leaves unloading out");
  }
  text += fmt::format("jitter = \"{}\"                # noise of the displacement\n", moved);
  return text;
}

}  // namespace

std::vector<std::string> column_words() {
  std::vector<std::string> words;
  for (const RecordedQuantity& quantity : recorded_quantities()) words.emplace_back(quantity.word);
  return words;
}

MeasuredRecord recognised(const std::filesystem::path& csv, const std::string& file, const std::string& name,
                          const std::map<std::string, std::string>& columns) {
  const CsvTable table = read_csv(csv, {.is_foreign = true, .is_unit = is_unit});
  const std::vector<FoundColumn> found = found_columns(csv, table, columns);
  const auto values = [&](std::string_view key) -> const std::vector<double>& {
    return std::ranges::find_if(found, [&](const FoundColumn& f) { return f.quantity->key == key; })->values;
  };
  const bool is_turned = largest(values("force"), -1.0) > largest(values("force"), 1.0);
  MeasuredRecord record{
      .file = file,
      .text = fmt::format("[[experiment.specimens]]\nname = {}\ncsv = {}\n", quoted_toml(name), quoted_toml(file)),
      .remarks = {}};
  for (const FoundColumn& f : found) {
    record.text += column_text(table, f, is_turned);
    record.remarks.push_back(
        fmt::format("{}: column {}{}", f.quantity->key,
                    table.has_names() ? fmt::format("\"{}\"", table.names[f.column]) : fmt::format("{}", f.column + 1),
                    f.stated.empty() ? fmt::format("; the file does not say its unit: {} taken", f.unit)
                                     : fmt::format(" in {}", f.unit)));
  }
  if (is_turned) record.remarks.emplace_back("forces are negative: factor = -1 turns force and displacement");
  record.text += treatment_of(values("displacement"), is_turned ? -1.0 : 1.0, record.remarks);
  return record;
}

}  // namespace pfdm
