#include "cases/program/specimens/measured_record.h"

#include "cases/program/input/config/toml_document.h"
#include "cases/program/input/config/units.h"
#include "cases/program/input/fields/csv_columns.h"
#include "physics/error.h"
#include "physics/quantity_text.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/csv_words.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <compare>
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
  std::vector<std::string_view> names;   ///< whole words
  std::vector<std::string_view> others;  ///< words of columns that are something else
  std::string_view symbol{};             ///< a whole name, where its unit is stated
};

const std::vector<RecordedQuantity>& recorded_quantities() {
  static const std::vector<RecordedQuantity> all{
      {"crack_length",
       "crack_length_column",
       &dimension::length,
       "mm",
       2,
       false,
       {"crack", "cracklength", "risslänge", "risslaenge"},
       {"opening", "displacement", "cod", "cmod", "ctod", "extension", "growth", "increment", "rate", "speed",
        "velocity", "step", "time"},
       "a"},
      {"displacement",
       "displacement_column",
       &dimension::length,
       "mm",
       0,
       true,
       {"displacement", "opening", "extension", "deflection", "crosshead", "stroke", "standardweg", "traverse",
        "traversenweg", "weg", "cod", "disp"},
       {"growth", "length", "rate", "speed", "velocity", "step", "time"}},
      {"force",
       "force_column",
       &dimension::force,
       "N",
       1,
       true,
       {"force", "load", "standardkraft", "kraft"},
       {"displacement", "opening", "extension", "deflection", "growth", "length", "rate", "step", "time"}}};
  return all;
}

/// Unit of a column that the file states: in the row of units, in brackets or behind the last _ of its name.
struct StatedUnit {
  std::string text{};                                                    ///< empty: none
  enum class Is { due, missing, unknown, of_another } is = Is::missing;  ///< better ones first
};

StatedUnit stated_unit(const CsvTable& table, std::size_t column, const Dimension& due) {
  using Is = StatedUnit::Is;
  const auto judged = [&](const std::string& text) {
    return StatedUnit{text, is_unit_of(text, due) ? Is::due : is_unit(text) ? Is::of_another : Is::unknown};
  };
  if (!table.units.empty() && !table.units[column].empty() && table.units[column] != "-")
    return judged(table.units[column]);
  const std::string& name = table.names[column];
  if (const auto bracketed = bracketed_end(name)) return judged(*bracketed);
  const std::string_view behind = unit_of_name(name, due);  // force_a has no unit of area
  return behind.empty() ? StatedUnit{} : StatedUnit{std::string(behind), Is::due};
}

/// "Crack", "opening" of "Crack-opening [mm]", in small letters; bytes above ASCII are letters.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool ends = std::isupper(byte) != 0 && !words.back().empty() &&
                      std::islower(static_cast<unsigned char>(words.back().back())) != 0;
    const bool is_letter = std::isalnum(byte) != 0 || byte >= 0x80;
    if ((!is_letter || ends) && !words.back().empty()) words.emplace_back();
    if (is_letter) words.back() += c;
  }
  for (std::string& word : words) word = lower_case(word);
  return words;
}

/// How well a column's name tells the quantity: the place in `names`, or nothing.
std::optional<std::size_t> place_among_names(const std::string& name, const RecordedQuantity& quantity,
                                             bool states_unit) {
  const std::vector<std::string> words = words_of(without_unit(name));
  const auto has = [&](std::string_view word) { return std::ranges::find(words, word) != words.end(); };
  if (std::ranges::any_of(quantity.others, has)) return std::nullopt;
  const bool is_growth = quantity.key == "displacement" && has("crack") && !has("opening") && !has("displacement");
  if (is_growth) return std::nullopt;  // "Crack extension"
  const auto found = std::ranges::find_if(quantity.names, has);
  if (found != quantity.names.end()) return static_cast<std::size_t>(found - quantity.names.begin());
  const bool is_symbol = states_unit && !quantity.symbol.empty() && words.front() == quantity.symbol;
  return is_symbol ? std::optional(quantity.names.size()) : std::nullopt;
}

struct Candidate {
  StatedUnit::Is unit;
  std::size_t place, column;
  auto operator<=>(const Candidate&) const = default;
};

InputError of_unknown_unit(const std::filesystem::path& csv, const std::string& name, const std::string& unit,
                           const Dimension& due) {
  return InputError(
      fmt::format("{}: the unit \"{}\" of column \"{}\" is not known; the file must name {}, as in \"{}\"",
                  csv.string(), unit, name, with_article(due.name), unit_of(due.example)));
}

/// The column of a quantity: stated units of its dimension come first, columns of other dimensions never.
std::optional<std::size_t> column_of(const CsvTable& table, const RecordedQuantity& quantity,
                                     const std::vector<std::size_t>& taken) {
  if (!table.has_names()) return quantity.place < table.columns.size() ? std::optional(quantity.place) : std::nullopt;
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    const StatedUnit unit = stated_unit(table, i, *quantity.due);
    if (std::ranges::count(taken, i) > 0 || unit.is == StatedUnit::Is::of_another) continue;
    if (const auto place = place_among_names(table.names[i], quantity, unit.is == StatedUnit::Is::due))
      candidates.push_back({unit.is, *place, i});
  }
  if (candidates.empty()) return std::nullopt;
  return std::ranges::min(candidates).column;
}

struct FoundColumn {
  const RecordedQuantity* quantity;
  std::size_t column;
  std::string unit, stated;
  std::vector<double> values;  ///< SI
};

FoundColumn found_column(const std::filesystem::path& csv, const CsvTable& table, const RecordedQuantity& quantity,
                         std::size_t column) {
  table.require_numbers(column);
  const StatedUnit stated = stated_unit(table, column, *quantity.due);
  const std::string& name = table.names[column];
  if (stated.is == StatedUnit::Is::unknown) throw of_unknown_unit(csv, name, stated.text, *quantity.due);
  if (stated.is == StatedUnit::Is::of_another)
    throw InputError(fmt::format("{}: column \"{}\" is no {}: its unit is \"{}\"", csv.string(), name,
                                 quantity.due->name, stated.text));
  FoundColumn found{&quantity, column, "", stated.text, table.columns[column]};
  found.unit = found.stated.empty() ? std::string(quantity.unit) : found.stated;
  for (double& value : found.values) value *= unit_in_si(found.unit, *quantity.due);
  return found;
}

InputError not_recognised(const std::filesystem::path& csv, const CsvTable& table, const RecordedQuantity& quantity) {
  std::string refused;
  for (std::size_t i = 0; i < table.names.size(); ++i)
    if (stated_unit(table, i, *quantity.due).is == StatedUnit::Is::of_another &&
        place_among_names(table.names[i], quantity, false))
      refused += fmt::format("; \"{}\" is no {}", table.names[i], quantity.due->name);
  return InputError(
      fmt::format("{}: no column of it is known for a {}{}; --set {}=NAME says which one is (columns: {})",
                  csv.string(), quantity.key, refused, quantity.word, fmt::join(table.names, ", ")));
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
    found.push_back(found_column(csv, table, quantity, *column));
  }
  return found;
}

/// "" or ", factor = -1": forces that are turned, and those of a part of the specimen.
std::string factor_text(const FoundColumn& found, bool is_turned, double share) {
  const double factor = (is_turned && found.quantity->key != "crack_length" ? -1.0 : 1.0) *
                        (found.quantity->key == "force" ? share : 1.0);
  return factor == 1.0 ? "" : fmt::format(", factor = {:.9g}", factor);
}

std::string column_text(const CsvTable& table, const FoundColumn& found, bool is_turned, double share) {
  const std::string column =
      table.has_names() ? quoted_toml(without_unit(table.names[found.column])) : fmt::format("{}", found.column + 1);
  return fmt::format("{} = {{ column = {}, unit = \"{}\"{} }}\n", found.quantity->key, column, found.unit,
                     factor_text(found, is_turned, share));
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
                          const std::map<std::string, std::string>& columns, double share) {
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
    record.text += column_text(table, f, is_turned, share);
    record.remarks.push_back(
        fmt::format("{}: column {}{}", f.quantity->key,
                    table.has_names() ? fmt::format("\"{}\"", table.names[f.column]) : fmt::format("{}", f.column + 1),
                    f.stated.empty() ? fmt::format("; the file does not say its unit: {} taken", f.unit)
                                     : fmt::format(" in {}", f.unit)));
  }
  if (share != 1.0)
    record.remarks.push_back(fmt::format("{:.4g} of the specimen is computed: factor of forces", share));
  if (is_turned) record.remarks.emplace_back("forces are negative: factor = -1 turns force and displacement");
  record.text += treatment_of(values("displacement"), is_turned ? -1.0 : 1.0, record.remarks);
  return record;
}

}  // namespace pfdm
