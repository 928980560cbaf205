#pragma once
// The words of the command line: commands, their options, help. The only place that knows CLI11.

#include "cases/program/session/export_words.h"
#include "cases/program/session/sensitivity_words.h"
#include "physics/tensor.h"

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace pfdm {

/// What was asked for.
struct CommandLine {
  std::string command;
  std::string case_directory;
  std::vector<std::string> cases{};  ///< of report: one or several
  std::string output;                ///< directory; empty: the case's own
  std::vector<std::string> set;      ///< KEY=VALUE
  int threads = 1;
  std::optional<Index> max_steps{};
  bool restart = false;
  bool quiet = false;
  bool laws = false;
  bool slurm = false;
  bool strict = false;   ///< of fit
  bool live = false;     ///< of run
  std::string curve_to;  ///< of run: a file, as a script's pipe
  std::optional<std::string> prepared{};
  ExportWords exports{};  ///< of cohesive
  SensitivityWords sensitivity{};
  std::string new_directory;              ///< of init
  std::string like;                       ///< of init: a case
  std::optional<std::string> specimen{};  ///< of init: a standard specimen; empty: which there are
  std::vector<std::string> records{};     ///< of init: CSV files of its test
  std::string shell;                      ///< of completion
  bool schema = false;                    ///< of help
  bool man = false;                       ///< of help: the manual page
  std::string reference;                  ///< of help: a folder for its pages
  std::vector<std::string> help_words{};
  std::string told_command;  ///< of help: the one whose help has been printed; a key may have its name
  std::string key;           ///< of help: no command, so a key of case.toml, or words that keys tell of
};

/// Nothing if help or the version was asked for and written to `out`. Throws InputError that names what was meant.
std::optional<CommandLine> read_command_line(const std::vector<std::string>& arguments, std::ostream& out);

/// That there is no such command, and what was meant.
std::string unknown_command(const std::string& word);

/// What may be typed, for completion and the manual page.
struct CommandWords {
  struct Option {
    std::string name;                    ///< "--threads"; empty: a word in its place
    std::string value;                   ///< what it takes, as "N", "DIR" or "CASE"; empty: nothing
    std::vector<std::string> choices{};  ///< all values there are, where they are known
    std::string short_name{};            ///< "-o"
    std::string meaning{};               ///< what help says of it
  };
  std::string name;
  std::string description;
  std::string writes;  ///< what it writes and where
  std::vector<Option> options;
};
std::vector<CommandWords> command_words();

}  // namespace pfdm
