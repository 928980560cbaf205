#include "cases/program/input/config/units.h"

#include "cases/program/input/config/heat_units.h"
#include "postproc/files/text_file.h"

#include "physics/error.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

namespace pfdm {
namespace {

constexpr const Dimension* named_dimensions[] = {&dimension::length,
                                                 &dimension::area,
                                                 &dimension::volume,
                                                 &dimension::mass,
                                                 &dimension::time,
                                                 &dimension::frequency,
                                                 &dimension::velocity,
                                                 &dimension::acceleration,
                                                 &dimension::acceleration_density,
                                                 &dimension::density,
                                                 &dimension::force,
                                                 &dimension::energy,
                                                 &dimension::stress,
                                                 &dimension::toughness,
                                                 &dimension::temperature,
                                                 &dimension::viscosity,
                                                 &dimension::compliance,
                                                 &dimension::interface_stiffness,
                                                 &dimension::conductivity,
                                                 &dimension::specific_heat,
                                                 &dimension::heat_transfer,
                                                 &dimension::per_temperature,
                                                 &dimension::molar_energy,
                                                 &dimension::number};

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;

/// UDUNITS keeps what it parses in global variables: one thread at a time.
std::mutex udunits;

ut_system* unit_system() {
  static const std::unique_ptr<ut_system, decltype(&ut_free_system)> system = [] {
    ut_set_error_message_handler(ut_ignore);  // it would write to stderr; our messages say more
    return std::unique_ptr<ut_system, decltype(&ut_free_system)>(ut_read_xml(nullptr), &ut_free_system);
  }();
  if (!system) throw ComputationError("the units database of UDUNITS-2 cannot be read; is libudunits2-data installed?");
  return system.get();
}

bool part_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// `text` with every whole word `word` replaced, with an exponent behind it too: "thou2".
std::string replace_word(std::string_view text, std::string_view word, std::string_view replacement) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const bool starts = i == 0 || !part_of_word(text[i - 1]);
    const std::size_t after = i + word.size();
    if (starts && text.substr(i, word.size()) == word &&
        (after >= text.size() || !part_of_word(text[after]) || is_digit(text[after]))) {
      result += replacement;
      i = after;
    } else {
      result += text[i++];
    }
  }
  return result;
}

/// Names that testing machines and data sheets write, and what UDUNITS calls them. To UDUNITS "g0" would be gram to the
/// power of zero.
constexpr std::pair<std::string_view, std::string_view> other_names[] = {
    {"g0", "gravity"}, {"lbm", "pound"}, {"oz", "avoirdupois_ounce"}, {"kp", "kgf"},
    {"dyn", "dyne"},   {"thou", "mil"},  {"Msi", "(1e6 psi)"}};

/// Null if UDUNITS does not know it. "/K", as in "1e-5/K", is 1/K.
Unit parse_unit(std::string_view text) {
  ut_system* const system = unit_system();
  std::string spelled(trimmed(text));
  if (spelled.size() > 1 && spelled[0] == '/' && !is_digit(spelled[1])) spelled.insert(0, "1");
  for (const auto& [name, known] : other_names) spelled = replace_word(spelled, name, known);
  return Unit(spelled.empty() ? nullptr : ut_parse(system, spelled.c_str(), UT_UTF8), &ut_free);
}

/// Stricter than ut_are_convertible, which takes a time for a frequency.
bool same_dimension(const ut_unit* a, const ut_unit* b) {
  const Unit ratio(ut_divide(a, b), &ut_free);
  return ratio && ut_is_dimensionless(ratio.get()) != 0 && ut_are_convertible(a, b) != 0;
}

std::string with_example(const Dimension& due) {
  return fmt::format("expected {}, as in \"{}\"", with_article(due.name), due.example);
}

std::string describe(const ut_unit* unit) {
  for (const Dimension* known : named_dimensions)
    if (same_dimension(unit, parse_unit(known->si_unit).get())) return with_article(known->name);
  char base_units[128] = "";
  ut_format(unit, base_units, sizeof base_units - 1, UT_ASCII | UT_DEFINITION);
  return fmt::format("of the dimension \"{}\"", base_units);
}

/// What the user probably meant by g, if that is what is wrong.
std::string gravity_hint(std::string_view unit_text, const ut_unit* due) {
  const Unit meant = parse_unit(replace_word(unit_text, "g", "g0"));
  if (!meant || !same_dimension(meant.get(), due)) return "";
  return "; write g0 for multiples of gravity (a bare g is a gram)";
}

double to_si(double value, std::string_view unit_text, std::string_view whole_text, const Dimension& due) {
  const Unit due_unit = parse_unit(due.si_unit);
  const Unit unit = parse_unit(unit_text);
  if (!unit)
    throw InputError(fmt::format("\"{}\": the unit \"{}\" is not known; {}", whole_text, unit_text, with_example(due)));
  if (!same_dimension(unit.get(), due_unit.get()))
    throw InputError(fmt::format("\"{}\" is {}; {}{}", whole_text, describe(unit.get()), with_example(due),
                                 gravity_hint(unit_text, due_unit.get())));
  const std::unique_ptr<cv_converter, decltype(&cv_free)> convert(ut_get_converter(unit.get(), due_unit.get()),
                                                                  &cv_free);
  return cv_convert_double(convert.get(), value);
}

/// The number that `text` starts with, and what follows it.
std::optional<std::pair<double, std::string_view>> split_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || !std::isfinite(value)) return std::nullopt;
  return std::pair{value, trimmed(text.substr(end - text.data()))};
}

}  // namespace

double parse_quantity(std::string_view text, const Dimension& due) {
  const auto parts = split_number(trimmed(text));
  if (!parts) throw InputError(fmt::format("\"{}\" does not start with a number; {}", text, with_example(due)));
  const auto [value, unit] = *parts;
  if (unit.size() > 1 && unit[0] == ',' && std::isdigit(static_cast<unsigned char>(unit[1])) != 0)
    throw InputError(fmt::format(
        "\"{}\" has a comma; numbers have a decimal point and no separator of thousands, as in \"0.5 mm\"", text));
  if (unit.empty() && due.si_unit == dimension::number.si_unit) return value;
  if (unit.empty()) throw InputError(fmt::format("\"{}\" has no unit; {}", text, with_example(due)));
  // "20 30 um" would be multiplied out by UDUNITS; "20 1/s" is meant so.
  if (split_number(unit) && !unit.starts_with("1/"))
    throw InputError(fmt::format("\"{}\" has two numbers; {}", text, with_example(due)));
  const std::lock_guard lock(udunits);
  return to_si(value, unit, text, due);
}

double unit_in_si(std::string_view unit, const Dimension& due) {
  const std::lock_guard lock(udunits);
  return to_si(1.0, trimmed(unit), unit, due) - to_si(0.0, trimmed(unit), unit, due);
}

bool is_unit(std::string_view text) {
  const std::lock_guard lock(udunits);
  return parse_unit(text) != nullptr;
}

bool is_unit_of(std::string_view text, const Dimension& due) {
  const std::lock_guard lock(udunits);
  const Unit unit = parse_unit(text);
  return unit && same_dimension(unit.get(), parse_unit(due.si_unit).get());
}

bool has_other_zero(std::string_view unit) {
  return is_unit_of(unit, dimension::temperature) &&
         parse_quantity(fmt::format("0 {}", unit), dimension::temperature) != 0.0;
}

const Dimension& dimension_of(std::string_view text) {
  const std::lock_guard lock(udunits);
  const std::string_view spelled = unit_of(text);
  const Unit unit = parse_unit(spelled);
  if (!unit) throw InputError(fmt::format("\"{}\": the unit \"{}\" is not known", text, spelled));
  for (const Dimension* known : named_dimensions)
    if (same_dimension(unit.get(), parse_unit(known->si_unit).get())) return *known;
  throw InputError(fmt::format("\"{}\" is {}; no key has this dimension", text, describe(unit.get())));
}

std::string_view unit_of(std::string_view text) {
  const auto parts = split_number(trimmed(text));
  if (!parts || parts->second.empty()) throw InputError(fmt::format("\"{}\" is not a quantity with a unit", text));
  return parts->second;
}

std::string with_article(std::string_view noun) {
  const bool vowel = !noun.empty() && std::string_view("aeiou").find(noun.front()) != std::string_view::npos;
  return fmt::format("{} {}", vowel ? "an" : "a", noun);
}

}  // namespace pfdm
