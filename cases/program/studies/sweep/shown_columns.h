#pragma once
// Columns of figures as pages show them: names with units at their ends become words, numbers get prefixes.

#include "postproc/files/csv_table.h"

#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// A column as it is shown: words, unit and the numbers in it.
struct ShownColumn {
  std::string words, unit;
  std::vector<double> values;
  std::vector<std::string> names{};       ///< what the values 0, 1, ... stand for; empty: numbers
  std::string title() const;              ///< "peak force [mN]", "model (0 AT1, 1 AT2)"
  std::string cell(std::size_t i) const;  ///< the i-th value
};

/// The comment of a table by which the number `k` in a column stands for a word: "model, 0: AT1".
std::string comment_of_word(const std::string& column, std::size_t k, const std::string& word);

/// The j-th column of a table, with the words that its comments have for the column's numbers.
ShownColumn shown_column(const CsvTable& table, std::size_t j);

/// "peak_force_N" of numbers in SI as "peak force" in the unit that suits the largest of them.
ShownColumn shown_column(const std::string& name, const std::vector<double>& values);

/// A unit as a terminal takes it: "um" of micrometres, "^2" of squares.
std::string in_ascii(std::string unit);

/// Columns of figures that one asks for first, of runs with a curve of force and displacement, or of mean stress and
/// strain, in this order; none of other kinds of case.
std::vector<std::size_t> headline_columns(const CsvTable& table);

/// Whether the finite values of a column differ.
bool varies(const std::vector<double>& values);

/// Whether a number of a summary tells what a run cost, in its last session alone, and not what came out.
bool is_cost(std::string_view name);

}  // namespace pfdm
