// read_signals_uff() of signal_table.h: signals out of the functions of a universal file.

#include "physics/error.h"
#include "postproc/records/signal_table.h"
#include "postproc/records/uff_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace pfdm {
namespace {

/// The ID lines if they tell all functions apart; else their places, their labels, their numbers.
std::vector<std::string> names_of(const std::vector<UffFunction>& functions) {
  for (const auto member : {&UffFunction::id, &UffFunction::place, &UffFunction::label}) {
    std::vector<std::string> names;
    names.reserve(functions.size());
    for (const UffFunction& f : functions) names.push_back(f.*member);
    const std::set<std::string> different(names.begin(), names.end());
    if (different.size() == names.size() && !different.contains("")) return names;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < functions.size(); ++i) names.push_back(fmt::format("function_{}", i + 1));
  return names;
}

/// What was made of the functions.
std::vector<std::string> notes_on(const std::vector<UffFunction>& functions, const std::vector<std::string>& names) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    if (functions[i].was_in_g)
      notes.push_back(fmt::format("\"{}\" is an acceleration in g: multiples of gravity (g0)", names[i]));
    if (functions[i].n_filling > 0)
      notes.push_back(
          fmt::format("the last line of \"{}\" is filled up: what follows its {} values ({} zero{}) is left out",
                      names[i], functions[i].n, functions[i].n_filling, functions[i].n_filling > 1 ? "s" : ""));
  }
  return notes;
}

}  // namespace

SignalTable read_signals_uff(const std::filesystem::path& path) {
  std::vector<UffFunction> functions = read_uff(path);
  std::set<int> types;
  for (const UffFunction& f : functions) types.insert(f.type);
  std::erase_if(functions, [](const UffFunction& f) { return f.type != uff_time_response; });
  if (functions.empty())
    throw InputError(fmt::format("{}: there is no function of type 1, a time response (found types {})", path.string(),
                                 fmt::join(types, ", ")));
  const UffFunction& first = functions.front();
  for (const UffFunction& f : functions)
    if (f.abscissa != first.abscissa)
      throw InputError(fmt::format("{}: its functions have different times ({} values from {} to {}, {} from {} to {})",
                                   path.string(), first.n, first.abscissa.front(), first.abscissa.back(), f.n,
                                   f.abscissa.front(), f.abscissa.back()));
  const auto column = [](const std::vector<double>& values) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
  };
  SignalTable table;
  table.columns.push_back({"time", first.abscissa_unit, column(first.abscissa)});
  const std::vector<std::string> names = names_of(functions);
  for (std::size_t i = 0; i < functions.size(); ++i)
    table.columns.push_back({names[i], functions[i].unit, column(functions[i].ordinate)});
  table.notes = notes_on(functions, names);
  return table;
}

}  // namespace pfdm
