#include "cases/program/help_words.h"

#include "cases/program/commands.h"
#include "cases/program/kinds.h"
#include "cases/program/reference/key_help.h"
#include "cases/program/reference/key_search.h"
#include "physics/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <system_error>
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

/// Names of the guides that are about all words that are asked for.
std::vector<std::string> guides_about(const std::string& asked, const std::filesystem::path& guides) {
  std::vector<std::string> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(guides, none))
    if (entry.path().extension() == ".md" && tells_of(entry.path().stem().string(), asked))
      found.push_back(entry.path().filename().string());
  std::ranges::sort(found);
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

void help_on(const std::string& asked, std::vector<KindKeys> kinds, const std::filesystem::path& guides,
             std::ostream& out) {
  std::ranges::stable_partition(kinds, [](const KindKeys& kind) { return kind.kind == "fracture"; });
  const std::vector<Usage> usages = usages_of(asked);
  const auto keys = help_on_word(asked, kinds);
  const std::vector<std::string> about = guides_about(asked, guides);
  if (!keys && usages.empty() && about.empty()) throw not_found(asked, kinds);
  if (!about.empty()) out << fmt::format("guide: cases/guides/{}\n\n", fmt::join(about, ", cases/guides/"));
  if (!keys && usages.empty()) return;
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

void help_on_keys_beside(const std::string& command, const std::vector<KindKeys>& kinds, std::ostream& out) {
  bool is_table = false;
  for_each_key(kinds, [&](const PlacedKey& placed) { is_table = is_table || placed.path == command; });
  if (is_table) out << fmt::format("\n[{0}] is also a table of case.toml, with a dot: pfdm help \"{0}.\"\n", command);
}

}  // namespace pfdm
