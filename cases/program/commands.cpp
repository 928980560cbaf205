#include "cases/program/commands.h"

#include "cases/program/command_texts.h"
#include "cases/program/input/config/config.h"
#include "physics/system/machine_limits.h"
#include "postproc/curves/instruction_set.h"
#include "postproc/exports/export_formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <thread>

namespace pfdm {
namespace {

/// More take memory and time and give nothing.
int most_threads() { return std::max(64, 4 * static_cast<int>(std::thread::hardware_concurrency())); }

const CLI::Validator& not_empty() {
  static const CLI::Validator validator(
      [](const std::string& word) { return word.empty() ? "a value is required" : ""; }, "");
  return validator;
}

struct Parser {
  CLI::App app{"Phase-field damage mechanics on cell-centred finite volumes", "pfdm"};
  CommandLine line{};

  Parser();
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

 private:
  void add(const CommandText& text) {
    app.add_subcommand(text.name, text.description)->footer(fmt::format("\n{}\n\n{}", text.writes, exit_statuses));
  }
  CLI::App& command(const std::string& name) const { return *app.get_subcommand(name); }
  void add_case_options();
  void add_job_options();
  void add_export_options();
  void add_sensitivity_options();
  void add_other_options();
};

Parser::Parser() {
  line.threads = machine_limits().processors;
  app.require_subcommand(1);
  const std::shared_ptr<CLI::FormatterBase> formatter = app.get_formatter();  // the commands take it over
  formatter->label("SUBCOMMAND", "COMMAND");
  formatter->label("Subcommands", "Commands");
  formatter->label("Positionals", "Arguments");
  formatter->label("REQUIRED", "");
  app.set_version_flag("--version", fmt::format("pfdm " PFDM_VERSION " ({})", instruction_set()),
                       "Print the version and the processors that it was compiled for, and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.footer(
      fmt::format("\npfdm COMMAND --help says more of a command. A case is a directory with a case.toml, as\n"
                  "cases/glass_bead_quick; pfdm help KEY says what a key of it is.\n\n{}",
                  exit_statuses));
  for (const CommandText& text : case_commands) add(text);
  for (const CommandText& text : other_commands) add(text);
  add_case_options();
  add_job_options();
  add_export_options();
  add_sensitivity_options();
  add_other_options();
}

void Parser::add_case_options() {
  for (const CommandText& text : case_commands) {
    CLI::App& of = command(text.name);
    CLI::Option* const where =
        of.get_name() == "report"
            ? of.add_option("CASE", line.cases,
                            "the case directory, or a .toml file in it; several are set side by side")
            : of.add_option("CASE", line.case_directory, "the case directory, or a .toml file in it");
    where->required()->type_name("");
    of.add_option("--threads", line.threads, "number of threads (default: all cores that a control group leaves)")
        ->check(CLI::Range(1, most_threads()).description(""))
        ->type_name("N");
    of.add_option("--set", line.set, "another value for a key of the case; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    of.add_flag("--quiet", line.quiet, "say nothing but warnings and errors");
    if (of.get_name() != "check")
      of.add_option("-o,--output", line.output,
                    of.get_name() == "report"
                        ? "results directory (default: CASE/results); of several cases where their page goes"
                        : "results directory (default: CASE/results)")
          ->check(not_empty())
          ->type_name("DIR");
  }
}

void Parser::add_job_options() {
  CLI::App &run = command("run"), &sweep = command("sweep");
  run.add_flag("--restart", line.restart, "continue from the last complete step");
  run.add_flag("--live", line.live,
               "keep report/index.html in the results up to date while a fracture run goes on; the page "
               "loads itself again");
  run.add_option("--max-steps", line.max_steps, "stop after N load steps; --restart continues from there")
      ->check(CLI::Range(1, 1000000000).description(""))
      ->type_name("N");
  run.add_option("--curve-to", line.curve_to,
                 "also write each row of force_displacement.csv here, as to a script's pipe, when its step is done")
      ->type_name("FILE");
  command("fit").add_flag("--strict", line.strict,
                          "end with status 1 if the verdict on the fit is none of the sound ones");
  sweep.add_flag("--slurm", line.slurm, "submit the missing runs to Slurm, or collect them");
  sweep.add_option("--prepared", line.prepared, "run this one of the runs that --slurm has prepared")
      ->type_name("RUN")
      ->needs("--output")
      ->group("");
}

void Parser::add_export_options() {
  CLI::App& of = command("cohesive");
  ExportWords& words = line.exports;
  of.add_option("--export", words.formats,
                fmt::format("write a law as input of another code, or of several: {}",
                            fmt::join(names_of_export_formats(), ", ")))
      ->type_name("FORMAT")
      ->delimiter(',')
      ->allow_extra_args(false);
  const auto add = [&of](const std::string& name, auto& word, const std::string& meaning, const std::string& value) {
    of.add_option(name, word, meaning)->check(not_empty())->type_name(value)->needs("--export");
  };
  add("--units", words.units, fmt::format("of the files: {}", fmt::join(names_of_unit_systems(), ", ")), "UNITS");
  add("--surface", words.surface, "whose law (default: the one whose law is known best)", "NAME");
  add("--angle", words.angle, "polar angle of the law, \"10 degree\" (default: least mode mixity)", "ANGLE");
  add("--stiffness", words.stiffness, "penalty stiffness, \"1e14 Pa/m\" (default: 50 strength^2/GI)", "STIFFNESS");
  add("--energy", words.energy, "GI of a law that is not known to its end, \"10 J/m^2\"", "ENERGY");
  add("--shear-strength", words.shear_strength, "\"2 MPa\" (default: the strength)", "STRESS");
  add("--shear-energy", words.shear_energy, "GII, \"20 J/m^2\" (default: GI)", "ENERGY");
  add("--exponent", words.exponent, "of the mode mix by Benzeggagh and Kenane (default: 2)", "N");
}

void Parser::add_sensitivity_options() {
  CLI::App& of = command("sensitivity");
  of.add_option(
        "--parameters", line.sensitivity.parameters,
        "keys of the case by which its curve is differentiated, as materials.glass.young_modulus; keys joined by "
        "+ keep their ratio (default: those of [fit], or all positive constants of materials, regions, "
        "interfaces and the phase field)")
      ->type_name("KEY,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  of.add_option("--method", line.sensitivity.method,
                "differences: of four whole runs for each parameter (default); direct: derivatives of each step of one "
                "run, where its models have them")
      ->check(CLI::IsMember({"differences", "direct"}).description(""))
      ->type_name("METHOD");
  of.add_option("--step", line.sensitivity.step,
                "of the differences, relative to the parameter (default: 0.01); half of it tells their error")
      ->check(CLI::Range(1e-4, 0.3).description(""))
      ->type_name("SHARE");
}

void Parser::add_other_options() {
  CLI::App& init = command("init");
  init.add_option("DIR", line.new_directory, "the new case directory")->type_name("");
  init.add_option("--like", line.like, "the case to start from: a directory, or a case that ships")->type_name("CASE");
  init.add_option("--specimen", line.specimen, "a standard specimen in place of a case; alone: which there are")
      ->expected(0, 1)
      ->type_name("NAME")
      ->excludes("--like");
  const auto of_specimen = [&init](const char* name, std::vector<std::string>& words, const char* meaning) {
    return init.add_option(name, words, meaning)->check(not_empty())->allow_extra_args(false)->needs("--specimen");
  };
  of_specimen("--data", line.records, "CSV file of the testing machine; may be repeated")->type_name("FILE");
  of_specimen("--set", line.set, "a dimension or property of the specimen; may be repeated")->type_name("NAME=VALUE");
  command("list").add_flag("--laws", line.laws, "list laws, boundary conditions and generators instead");
  CLI::App& help = command("help");
  help.add_option("COMMAND", line.help_words,
                  "the command, a key as materials.poisson_ratio, or words that keys tell of")
      ->type_name("");
  help.add_flag("--man", line.man, "print the manual page pfdm.1");
  help.add_flag("--schema", line.schema, "print the JSON schema of case.toml, for editors");
  help.add_option("--reference", line.reference, "write the reference of keys to this folder, a page for each table")
      ->type_name("DIR");
  command("completion").add_option("SHELL", line.shell, "bash or zsh")->required()->type_name("");
}

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> names_of_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    if (option->nonpositional() && !option->get_group().empty()) names.push_back("--" + option->get_lnames().front());
  return names;
}

bool is_command(const std::string& word, const CLI::App& app) {
  return std::ranges::count(names_of_commands(app), word) > 0;
}

std::string words_on_unknown(const std::string& word, const std::vector<std::string>& names) {
  return fmt::format("unknown command \"{}\"{} (available: {})", word, did_you_mean(word, names),
                     fmt::join(names, ", "));
}

/// CLI11 would only say that a command is missing.
void require_known_command(const std::string& word, const CLI::App& app) {
  if (!is_command(word, app)) throw InputError(words_on_unknown(word, names_of_commands(app)));
}

void require_command(const std::vector<std::string>& arguments, const CLI::App& app) {
  if (arguments.empty())
    throw InputError(fmt::format(
        "a command is required, as in: pfdm run cases/glass_bead_quick (available: {}); pfdm help says what each does",
        fmt::join(names_of_commands(app), ", ")));
  if (!arguments.front().starts_with("-")) require_known_command(arguments.front(), app);
}

/// Words that no command or option has taken are what is wrong, whatever else CLI11 misses on their account.
InputError wrong_usage(const CLI::App& app, const CLI::ParseError& error) {
  const auto parsed = app.get_subcommands();
  const CLI::App& command = parsed.empty() ? app : *parsed.back();
  const std::string called = command.get_name(), help = parsed.empty() ? "pfdm help" : "pfdm help " + called;
  const std::vector<std::string> left = app.remaining(true);
  const auto option = std::ranges::find_if(left, [](const std::string& word) { return word.starts_with("-"); });
  if (option != left.end()) {
    const std::vector<std::string> names = names_of_options(command);
    const std::string word = option->substr(0, option->find('='));
    if (std::ranges::count(names, word) > 0)
      return InputError(fmt::format("{} must follow the command, as in: pfdm {} ... {}", word, called, word));
    return InputError(fmt::format("{} has no option \"{}\"{} (available: {})", called, word, did_you_mean(word, names),
                                  fmt::join(names, ", ")));
  }
  if (!left.empty())
    return InputError(fmt::format("{}: unexpected argument \"{}\"; see {}", called, left.front(), help));
  return InputError(fmt::format("{}: {}; see {}", called, error.what(), help));
}

CommandWords::Option words_of(const CLI::Option& option, const std::vector<std::string>& commands) {
  CommandWords::Option words{.name = "", .value = option.get_name(true)};
  if (option.nonpositional())
    words = {.name = "--" + option.get_lnames().front(),
             .value = option.get_items_expected_max() > 0 ? option.get_type_name() : ""};
  words.meaning = option.get_description();
  if (!option.get_snames().empty()) words.short_name = "-" + option.get_snames().front();
  if (words.value == "COMMAND") words.choices = commands;
  if (words.value == "SHELL") words.choices = {"bash", "zsh"};
  if (words.value == "FORMAT") words.choices = names_of_export_formats();
  if (words.value == "METHOD") words.choices = {"differences", "direct"};
  if (words.value == "UNITS") words.choices = names_of_unit_systems();
  return words;
}

}  // namespace

std::optional<CommandLine> read_command_line(const std::vector<std::string>& arguments, std::ostream& out) {
  Parser parser;
  CLI::App& app = parser.app;
  require_command(arguments, app);
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 wants the last first
  } catch (const CLI::Success& asked) {
    app.exit(asked, out, out);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw wrong_usage(app, error);
  }
  CommandLine& line = parser.line;
  line.command = app.get_subcommands().front()->get_name();
  if (line.cases.size() == 1) line.case_directory = line.cases.front();
  if (line.sensitivity.method == "direct" && app.get_subcommands().front()->count("--step") > 0)
    throw InputError("sensitivity: --step is that of differences; --method direct takes none");
  if (line.command != "help" || line.man || line.schema || !line.reference.empty()) return line;
  line.key = fmt::format("{}", fmt::join(line.help_words, " "));
  if (line.key.empty()) return read_command_line({"--help"}, out);
  if (is_command(line.key, app) && !read_command_line({line.key, "--help"}, out)) line.told_command = line.key;
  return line;
}

std::string unknown_command(const std::string& word) {
  return fmt::format("unknown command \"{}\"{}", word, did_you_mean(word, names_of_commands(Parser().app)));
}

std::vector<CommandWords> command_words() {
  const Parser parser;
  const std::vector<std::string> names = names_of_commands(parser.app);
  std::vector<CommandWords> commands;
  for (const CLI::App* command : parser.app.get_subcommands({})) {
    commands.push_back({command->get_name(), command->get_description(), writes_of(command->get_name()), {}});
    for (const CLI::Option* option : command->get_options())
      if (!option->get_group().empty()) commands.back().options.push_back(words_of(*option, names));
  }
  return commands;
}

}  // namespace pfdm
