#include "cases/program/completion.h"

#include "physics/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pfdm {
namespace {

// Case directories; where there are none, directories that hold some, or else any.
constexpr std::string_view functions = R"(_pfdm_cases() {
  local directory inner
  local -a cases=() parents=() others=()
  [[ -n ${ZSH_VERSION-} ]] && setopt localoptions nonomatch
  for directory in "$1"*/; do
    [[ -d $directory ]] || continue
    others+=("${directory%/}")
    if [[ -e ${directory}case.toml ]]; then
      cases+=("${directory%/}")
      continue
    fi
    for inner in "$directory"*/case.toml; do
      [[ -e $inner ]] && parents+=("${directory%/}") && break
    done
  done
  if ((${#cases[@]} + ${#parents[@]} > 0)); then
    COMPREPLY=("${cases[@]}" "${parents[@]}")
  else
    COMPREPLY=("${others[@]}")
  fi
}

_pfdm_words() {
  local word=$1 IFS=$' \t\n'
  shift
  COMPREPLY=($(compgen -W "$*" -- "$word"))
}

_pfdm_directories() {
  local IFS=$'\n'
  COMPREPLY=($(compgen -d -- "$1"))
}
)";

std::string completer_of(const CommandWords::Option& option) {
  if (!option.choices.empty()) return fmt::format("_pfdm_words \"$word\" {}", fmt::join(option.choices, " "));
  if (option.value == "CASE") return "_pfdm_cases \"$word\"";
  if (option.value == "DIR") return "_pfdm_directories \"$word\"";
  return ":";
}

/// What follows an option that takes a value.
std::string cases_of_values(const CommandWords& command) {
  std::string text;
  for (const CommandWords::Option& option : command.options)
    if (!option.name.empty() && !option.value.empty())
      text += fmt::format("    {}:{}) {}; return ;;\n", command.name, option.name, completer_of(option));
  return text;
}

std::string case_of_options(const CommandWords& command) {
  std::vector<std::string> names;
  for (const CommandWords::Option& option : command.options)
    if (!option.name.empty()) names.push_back(option.name);
  return fmt::format("    {}:-*) _pfdm_words \"$word\" {} ;;\n", command.name, fmt::join(names, " "));
}

std::string case_of_word(const CommandWords& command, const std::vector<std::string>& keys) {
  for (CommandWords::Option option : command.options) {
    if (!option.name.empty()) continue;
    if (option.value == "COMMAND")
      for (const std::string& key : keys)
        if (std::ranges::count(option.choices, key) == 0) option.choices.push_back(key);
    return fmt::format("    {}:*) {} ;;\n", command.name, completer_of(option));
  }
  return "";
}

}  // namespace

std::string completion_script(std::string_view shell, const std::vector<CommandWords>& commands,
                              const std::vector<std::string>& keys) {
  if (shell != "bash" && shell != "zsh")
    throw InputError(fmt::format("completion: there are scripts for bash and zsh, none for \"{}\"", shell));
  std::vector<std::string> names;
  std::string values, words;
  for (const CommandWords& command : commands) {
    names.push_back(command.name);
    values += cases_of_values(command);
    words += case_of_options(command) + case_of_word(command, keys);
  }
  std::string text = fmt::format("# Completion of pfdm in {0}, made by: pfdm completion {0}\n", shell);
  if (shell == "zsh") text += "autoload -U +X bashcompinit && bashcompinit\n";
  text += functions;
  text += fmt::format(R"(
_pfdm() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command=${{COMP_WORDS[1]}}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _pfdm_words "$word" {0} --help --version
    return
  fi
  case $command:$before in
{1}  esac
  case $command:$word in
{2}  esac
}}
complete -o filenames -F _pfdm pfdm
)",
                      fmt::join(names, " "), values, words);
  return text;
}

}  // namespace pfdm
