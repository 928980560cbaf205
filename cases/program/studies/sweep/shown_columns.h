#pragma once
// Columns of figures as pages show them: names with units at their ends become words, numbers get prefixes.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// A column as it is shown: words, unit and the numbers in it.
struct ShownColumn {
  std::string words, unit;
  std::vector<double> values;
  std::string title() const;  ///< "peak force [mN]"
};

/// "peak_force_N" of numbers in SI as "peak force" in the unit that suits the largest of them.
ShownColumn shown_column(const std::string& name, const std::vector<double>& values);

/// Whether the finite values of a column differ.
bool varies(const std::vector<double>& values);

/// Whether a number of a summary tells what a run cost, in its last session alone, and not what came out.
bool is_cost(std::string_view name);

}  // namespace pfdm
