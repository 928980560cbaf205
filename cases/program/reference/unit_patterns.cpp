#include "cases/program/reference/unit_patterns.h"

#include "cases/program/input/config/heat_units.h"

#include <map>
#include <string_view>
#include <vector>

namespace pfdm {
namespace {

/// A unit's name stands in braces, a factor by a blank, a power by its exponent alone: "{FORCE}/{LENGTH}2".
struct UnitForm {
  std::string_view dimension;  ///< its SI unit, or its name where others have the same unit
  std::vector<std::string_view> forms;
};

constexpr std::string_view prefixes = "(?:da|[YZEPTGMkhdcmunpfazy]|\u00b5|\u03bc)?";

const std::map<std::string_view, std::string>& classes() {
  static const std::map<std::string_view, std::string> all = [] {
    const std::string p(prefixes);
    return std::map<std::string_view, std::string>{
        {"LENGTH",
         "(?:" + p +
             "(?:m|meters?|metres?)|microns?|angstroms?|in|inch|inches|ft|foot|feet|yd|yards?|mi|miles?|mils?|thou)"},
        {"MASS", "(?:" + p + "(?:g|grams?|t|tonnes?)|lbm?|pounds?|oz)"},
        {"TIME", "(?:" + p + "(?:s|seconds?)|min|minutes?|h|hr|hours?|d|days?|years?)"},
        {"FORCE", "(?:" + p + "(?:N|newtons?)|lbf|kgf|kp|dyne?|kip)"},
        {"PRESSURE", "(?:" + p + "(?:Pa|pascals?|bar)|atm|psi|ksi|Msi|mmHg)"},
        {"ENERGY", "(?:" + p + "(?:J|joules?|eV|cal|Wh)|erg)"},
        {"POWER", "(?:" + p + "(?:W|watts?))"},
        {"FREQUENCY", "(?:" + p + "(?:Hz|hertz))"},
        {"TEMPERATURE", "(?:" + p + "(?:K|kelvins?)|degC|degF|celsius|fahrenheit|\u00b0C|\u00b0F|degrees?_[CF])"},
        {"KELVIN", "(?:" + p + "(?:K|kelvins?))"},
        {"DIFFERENCE", "(?:" + p + "(?:K|kelvins?)|degC|\u00b0C|celsius)"},
        {"ANGLE",
         "(?:degrees?|arc_degrees?|\u00b0|" + p + "(?:rad|radians?)|arc_minutes?|arc_seconds?|grads?|gon|turns?)"},
        {"GRAVITY", "(?:g0|gravity|standard_gravity|g_n)"},
        {"VOLUME", "(?:" + p + "(?:l|L|liters?|litres?))"},
        {"VISCOSITY", "(?:" + p + "(?:P|poise))"},
        {"AMOUNT", "(?:" + p + "(?:mol|moles?))"},
        {"NONE", "(?:1|%|percent|ppm)"},
    };
  }();
  return all;
}

/// Lengths, times, masses and what they make, angles and plain numbers.
const std::vector<UnitForm>& forms_of_motion() {
  static const std::vector<UnitForm> all{
      {"m", {"{LENGTH}"}},
      {"m^2", {"{LENGTH}2", "{LENGTH} {LENGTH}"}},
      {"m^3", {"{LENGTH}3", "{VOLUME}"}},
      {"kg", {"{MASS}"}},
      {"s", {"{TIME}"}},
      {"Hz", {"{FREQUENCY}", "1/{TIME}", "/{TIME}", "{TIME}-1"}},
      {"1/s", {"1/{TIME}", "/{TIME}", "{TIME}-1", "{FREQUENCY}", "{NONE}/{TIME}"}},
      {"s^-1", {"1/{TIME}", "/{TIME}", "{TIME}-1", "{FREQUENCY}", "{NONE}/{TIME}"}},
      {"m/s", {"{LENGTH}/{TIME}", "{LENGTH} {TIME}-1"}},
      {"m/s^2", {"{GRAVITY}", "{LENGTH}/{TIME}2", "{LENGTH} {TIME}-2", "{LENGTH}/{TIME}/{TIME}"}},
      {"m^2/s^4/Hz",
       {"{GRAVITY}2/{FREQUENCY}", "{LENGTH}2/{TIME}4/{FREQUENCY}", "{LENGTH}2/{TIME}3",
        "({LENGTH}/{TIME}2)2/{FREQUENCY}"}},
      {"kg/m^3", {"{MASS}/{LENGTH}3", "{MASS} {LENGTH}-3", "{MASS}/{VOLUME}"}},
      {"radian", {"{ANGLE}"}},
      {"1", {"{NONE}", "{LENGTH}/{LENGTH}"}},
  };
  return all;
}

/// Forces, stresses, energies, stiffnesses.
const std::vector<UnitForm>& forms_of_forces() {
  static const std::vector<UnitForm> all{
      {"N", {"{FORCE}", "{MASS} {LENGTH}/{TIME}2", "{ENERGY}/{LENGTH}"}},
      {"m/N", {"{LENGTH}/{FORCE}", "{LENGTH} {FORCE}-1"}},
      {"J", {"{ENERGY}", "{FORCE} {LENGTH}", "{POWER} {TIME}", "{PRESSURE} {LENGTH}3"}},
      {"Pa", {"{PRESSURE}", "{FORCE}/{LENGTH}2", "{FORCE} {LENGTH}-2", "{ENERGY}/{LENGTH}3"}},
      {"Pa s", {"{PRESSURE} {TIME}", "{FORCE} {TIME}/{LENGTH}2", "{VISCOSITY}"}},
      {"J/m^2",
       {"{ENERGY}/{LENGTH}2", "{ENERGY} {LENGTH}-2", "{FORCE}/{LENGTH}", "{FORCE} {LENGTH}-1", "{PRESSURE} {LENGTH}"}},
      {"J/m^3", {"{ENERGY}/{LENGTH}3", "{ENERGY} {LENGTH}-3", "{PRESSURE}", "{FORCE}/{LENGTH}2", "{FORCE} {LENGTH}-2"}},
      {"Pa/m", {"{PRESSURE}/{LENGTH}", "{PRESSURE} {LENGTH}-1", "{FORCE}/{LENGTH}3", "{FORCE}/{LENGTH}2/{LENGTH}"}},
      {"N/m^3", {"{FORCE}/{LENGTH}3", "{FORCE} {LENGTH}-3", "{PRESSURE}/{LENGTH}"}},
      {"N/m", {"{FORCE}/{LENGTH}", "{FORCE} {LENGTH}-1"}},
      {"N/m^2", {"{FORCE}/{LENGTH}2", "{PRESSURE}"}},
      {"N/m^4", {"{FORCE}/{LENGTH}4"}},
      {"N/m^5", {"{FORCE}/{LENGTH}5"}},
      {"N/m^6", {"{FORCE}/{LENGTH}6"}},
      {"N/m^7", {"{FORCE}/{LENGTH}7"}},
      {"N s/m", {"{FORCE} {TIME}/{LENGTH}", "{MASS}/{TIME}", "{FORCE}/({LENGTH}/{TIME})"}},
      {"N/m/s", {"{FORCE}/{LENGTH}/{TIME}", "{FORCE}/({LENGTH} {TIME})"}},
  };
  return all;
}

/// Differences of temperature before temperatures, whose SI unit is the same.
const std::vector<UnitForm>& forms_of_heat() {
  static const std::vector<UnitForm> all{
      {"J/mol", {"{ENERGY}/{AMOUNT}", "{ENERGY} {AMOUNT}-1"}},
      {"W/m^2", {"{POWER}/{LENGTH}2", "{POWER} {LENGTH}-2"}},
      {dimension::temperature_difference.name, {"{KELVIN}"}},
      {"K", {"{TEMPERATURE}"}},
      {"W/m/K",
       {"{POWER}/{LENGTH}/{DIFFERENCE}", "{POWER}/({LENGTH} {DIFFERENCE})", "{POWER} {LENGTH}-1 {DIFFERENCE}-1"}},
      {"J/kg/K",
       {"{ENERGY}/{MASS}/{DIFFERENCE}", "{ENERGY}/({MASS} {DIFFERENCE})", "{ENERGY} {MASS}-1 {DIFFERENCE}-1"}},
      {"W/m^2/K",
       {"{POWER}/{LENGTH}2/{DIFFERENCE}", "{POWER}/({LENGTH}2 {DIFFERENCE})", "{POWER} {LENGTH}-2 {DIFFERENCE}-1"}},
      {"1/K", {"1/{DIFFERENCE}", "/{DIFFERENCE}", "{DIFFERENCE}-1", "{NONE}/{DIFFERENCE}"}},
  };
  return all;
}

/// Null of a dimension whose units are not listed.
const UnitForm* forms_of(const Dimension& due) {
  for (const auto* group : {&forms_of_motion(), &forms_of_forces(), &forms_of_heat()})
    for (const UnitForm& known : *group)
      if (known.dimension == due.si_unit || known.dimension == due.name) return &known;
  return nullptr;
}

std::string exponent_pattern(std::string_view digits) { return "(?:\\^|\\*\\*)?" + std::string(digits); }

std::string pattern_of_form(std::string_view form) {
  std::string pattern;
  bool follows_unit = false;
  for (std::size_t i = 0; i < form.size(); ++i) {
    const char c = form[i];
    if (c == '{') {
      const std::size_t end = form.find('}', i);
      pattern += classes().at(form.substr(i + 1, end - i - 1));
      i = end;
      follows_unit = true;
      continue;
    }
    if (c == ' ') pattern += "(?:[ .*]|\u00b7)";
    if (c == '/') pattern += " ?(?:/|per) ?";
    if (c == '(') pattern += "\\(";
    if (c == ')') pattern += "\\)";
    if (c == '-')
      pattern += exponent_pattern(std::string("-") + form[++i]);
    else if (c >= '0' && c <= '9')
      pattern += follows_unit ? exponent_pattern(std::string(1, c)) : std::string(1, c);
    follows_unit = c == ')';
  }
  return pattern;
}

}  // namespace

std::string unit_pattern(const Dimension& due) {
  const UnitForm* const known = forms_of(due);
  if (known == nullptr) return ".+";
  std::string all;
  for (const std::string_view form : known->forms) all += (all.empty() ? "" : "|") + pattern_of_form(form);
  return "(?:" + all + ")";
}

std::string quantity_pattern(const Dimension& due, const Range& allowed) {
  const bool has_zero_elsewhere = due.name == dimension::temperature.name;
  const bool not_negative = allowed.least >= 0.0 && !has_zero_elsewhere;
  const bool positive = not_negative && !allowed.holds(0.0);
  const std::string mantissa = positive ? "(?:[0-9]*[1-9][0-9]*(?:\\.[0-9]*)?|[0-9]*\\.[0-9]*[1-9][0-9]*)"
                                        : "(?:[0-9]+(?:\\.[0-9]*)?|\\.[0-9]+)";
  const std::string sign = not_negative ? "\\+?" : "[+-]?";
  return "^\\s*" + sign + mantissa + "(?:[eE][+-]?[0-9]+)?\\s*" + unit_pattern(due) + "\\s*$";
}

}  // namespace pfdm
