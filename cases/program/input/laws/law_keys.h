#pragma once
// Rows of keys for laws that are rows of tables with their parameters: a name, or { law = "name", parameter = ... }.

#include "cases/program/input/config/key.h"
#include "physics/law_parameters.h"

#include <algorithm>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace pfdm {

/// What a parameter of a law is; of laws that share its name alike.
struct ParameterWords {
  std::string_view name;
  std::string_view sentence;
};

KeyType type_of(const LawParameter& parameter);
std::string default_of(const LawParameter& parameter);
std::string_view sentence_of(std::string_view parameter, std::span<const ParameterWords> words);

/// The rows of "law" and of the parameters of all laws; one that several laws have is one row with each of them.
template <class Law>
std::vector<Key> law_keys(const std::string& noun, std::span<const Law> laws, std::string_view sentence,
                          std::span<const ParameterWords> words) {
  std::vector<Key> keys{{"law", keys::one_of(noun, laws), "", sentence}};
  for (const Law& law : laws)
    for (const LawParameter& parameter : law.parameters)
      keys.push_back(
          {parameter.name, type_of(parameter), default_of(parameter), sentence_of(parameter.name, words), law.name});
  return keys;
}

/// The name alone of a law whose parameters have defaults, or the table of these rows.
template <class Law>
KeyType law_type(std::string noun, std::span<const Law> laws, const KeyTable& (*rows)()) {
  std::vector<std::string> names;
  for (const Law& law : laws)
    if (std::ranges::none_of(law.parameters, [](const LawParameter& p) { return default_of(p).empty(); }))
      names.emplace_back(law.name);
  return keys::either({keys::choice(std::move(noun), std::move(names)), keys::table(rows)});
}

}  // namespace pfdm
