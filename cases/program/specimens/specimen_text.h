#pragma once
// Values of a specimen and the texts that are made of them.

#include "cases/program/specimens/specimen_file.h"

#include <map>
#include <set>
#include <span>
#include <string>

namespace pfdm {

/// What --set says of the specimen.
struct SpecimenWords {
  std::map<std::string, std::string> texts;  ///< of each value, as the user or the file writes it
  std::set<std::string> given{};             ///< by the user
  std::map<std::string, double> numbers;     ///< in SI, derived ones too
};

/// The values with `words` "NAME=VALUE" in place of defaults. `left_over` takes words of other names: those in
/// `others`. Throws InputError that names the word, for an unknown name, a value without its unit or out of range.
SpecimenWords specimen_words(const SpecimenFile& specimen, std::span<const std::string> words,
                             std::span<const std::string> others, std::map<std::string, std::string>& left_over);

/// Puts a number in place of a default that the user did not give.
void guess(SpecimenWords& words, const SpecimenValue& value, double si);

/// Adds what follows, and checks the rules. Throws InputError with the message of one that does not hold.
void derive(const SpecimenFile& specimen, SpecimenWords& words);

/// The rules that are told where they do not hold, a line each, after derive().
std::string lines_of_doubts(const SpecimenFile& specimen, const SpecimenWords& words);

/// `text` with {{ ... }} replaced: {{ name }} as it was written, quoted if it has a unit; {{ formula : mm }} a quoted
/// quantity; {{ formula : count }} a whole number; {{ formula : 1 }} a number; {{ formula : in mm }} without quotes,
/// with 4 digits; {{ formula : about mm }} with 3.
std::string filled(const std::string& text, const SpecimenWords& words);

}  // namespace pfdm
