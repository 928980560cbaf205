#pragma once
// Values of case.toml that a fit or a sweep changes, named by their keys.

#include "cases/program/input/case_files/case_file.h"

#include <span>
#include <string>
#include <vector>

namespace pfdm {

struct CaseParameter {
  std::string name;               ///< the first of its keys
  std::vector<std::string> keys;  ///< as in "materials.glass.young_modulus"; all keep their ratios
  std::vector<double> ratios;     ///< of the keys' values to the first's
  Dimension dimension{};
  std::string unit;                  ///< as in the file, "MPa"; empty of a bare number
  double value = 0.0;                ///< in the file [dimension.si_unit]
  double unit_in_si = 1.0;           ///< [dimension.si_unit]
  double zero_in_si = 0.0;           ///< of the unit's scale; not zero of temperatures alone
  std::vector<std::string> words{};  ///< what the values 0, 1, ... stand for, of a key that holds no number

  double in_file_units(double si) const { return (si - zero_in_si) / unit_in_si; }
  double in_si(double file) const { return file * unit_in_si + zero_in_si; }
  /// The name without the table that all such keys are in: "glass.young_modulus".
  std::string short_name() const { return name.substr(name.find('.') + 1); }
  /// An SI value with the parameter's unit, "75 MPa", in the eight digits with which it is written into a case; a word.
  std::string shown(double si) const;
};

/// The value of `file` at a key. Throws InputError if it is not there, or is neither a quantity nor a number.
CaseParameter case_parameter(const std::string& key, const CaseFile& file);
/// Adds the keys of `other`, which keep their ratios to the first. Throws InputError if it has another dimension, or
/// the first value is zero.
void keep_ratio(CaseParameter& parameter, const CaseParameter& other);

/// `key` is a key of `file`, or a list of keys whose values keep their ratios. Throws InputError if one is not there,
/// or is neither a quantity nor a number.
CaseParameter read_case_parameter(const ConfigValue& key, const CaseFile& file);

/// Whether a key, or the first of a list, takes words, not numbers: its value in `file` is a word, a formula, the name
/// of a file, true or false, or one of `values` is "free", as of "free" and "0 mm". Throws InputError if the key is
/// not there.
bool takes_words(const ConfigValue& key, std::span<const ConfigValue> values, const CaseFile& file);

/// Likewise for a key that takes_words(), or a list of them, which all take one value: the places among `values`, texts
/// of one line or truth values. Throws InputError if a key or a value is of another type.
CaseParameter read_word_parameter(const ConfigValue& key, std::span<const ConfigValue> values, const CaseFile& file);

/// Throws InputError if the last of the parameters, which `key` is, has a key that another one has as well.
void require_named_once(const ConfigValue& key, std::span<const CaseParameter> parameters);

/// A value of the parameter as it stands in the case, a quantity or a bare number [SI].
double read_parameter_value(const ConfigValue& value, const CaseParameter& parameter);

/// "glass.young_modulus = 70 GPa, ..."
std::string shown(std::span<const CaseParameter> parameters, std::span<const double> values);

/// The case with other values [SI], rounded to eight digits: two sets of values that differ by rounding are one case.
CaseFile with_values(const CaseFile& file, std::span<const CaseParameter> parameters, std::span<const double> values);

}  // namespace pfdm
