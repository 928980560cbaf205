#include "cases/program/help_words.h"

#include "cases/program/commands.h"
#include "cases/program/kinds.h"
#include "cases/program/reference/key_help.h"
#include "cases/program/reference/key_search.h"
#include "physics/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <vector>

namespace pfdm {
namespace {

struct Usage {
  std::string words;  ///< "pfdm run --restart"
  std::string meaning;
};

/// Commands and options that tell of words.
std::vector<Usage> usages_of(const std::string& asked) {
  std::vector<Usage> found;
  const auto add = [&](const std::string& words, const std::string& meaning) {
    if (tells_of(words + " " + meaning, asked)) found.push_back({words, meaning});
  };
  for (const CommandWords& command : command_words()) {
    const std::string call = "pfdm " + command.name;
    add(call, command.description);
    for (const CommandWords::Option& option : command.options)
      if (!option.name.empty())
        add(fmt::format("{} {}{}{}", call, option.name, option.value.empty() ? "" : " ", option.value), option.meaning);
  }
  return found;
}

InputError not_found(const std::string& asked, const std::vector<KindKeys>& kinds) {
  const std::vector<std::string> near = keys_like(asked, kinds);
  const bool knows_all = kinds.size() == std::size(all_kind_names);
  const std::string command = unknown_command(asked);
  return InputError(fmt::format("{} is it a key of case.toml{}, or a word that one tells of{}",
                                command + (command.ends_with('?') ? " Nor" : "; nor"),
                                near.empty() ? "" : fmt::format(" (keys like it: {})", fmt::join(near, ", ")),
                                knows_all ? "; all keys: cases/reference; all else: the search of pfdm docs"
                                          : "; this program knows those of fracture cases alone"));
}

}  // namespace

void help_on(const std::string& asked, const std::vector<KindKeys>& kinds, std::ostream& out) {
  const std::vector<Usage> usages = usages_of(asked);
  const auto keys = help_on_word(asked, kinds);
  if (!keys && usages.empty()) throw not_found(asked, kinds);
  if (!keys) {
    out << fmt::format("no key has the name \"{}\"; these commands tell of it:\n\n", asked);
    for (const Usage& usage : usages) out << usage.words << "\n  " << usage.meaning << "\n";
    return;
  }
  out << *keys;
  std::vector<std::string> calls;
  for (const Usage& usage : usages) calls.push_back(usage.words);
  if (!calls.empty()) out << fmt::format("\ncommands that tell of it: {}\n", fmt::join(calls, ", "));
}

}  // namespace pfdm
