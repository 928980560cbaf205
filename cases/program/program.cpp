#include "cases/program/program.h"

#include "cases/program/kinds.h"
#include "cases/program/listing.h"
#include "cases/program/sweep_on_slurm.h"
#include "solver/parallel.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <thread>

namespace pfdm {
namespace {

enum ExitStatus { done = 0, computation_failed = 1, input_wrong = 2 };

struct Options {
  std::string case_directory;
  std::string output;
  int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  Index max_steps = 0;
  bool restart = false;
  bool quiet = false;
  bool laws = false;
  bool slurm = false;
  std::optional<std::string> prepared;
};

struct Commands {
  CLI::App app{"Phase-field damage mechanics on cell-centred finite volumes", "pfdm"};
  CLI::App* run = app.add_subcommand("run", "Run a case: mesh, solve, write results");
  CLI::App* check = app.add_subcommand("check", "Read everything, solve nothing: say what would run or what is wrong");
  CLI::App* mesh = app.add_subcommand("mesh", "Make the mesh, write it with its quality figures");
  CLI::App* cohesive =
      app.add_subcommand("cohesive", "Extract the traction-separation laws of interfaces and planes from the results");
  CLI::App* compare = app.add_subcommand("compare", "Compare the results with the experiments that a case names");
  CLI::App* fit = app.add_subcommand("fit", "Estimate the parameters that a case names from its experiment");
  CLI::App* sweep = app.add_subcommand("sweep", "Run a case with the sets of values that it names");
  CLI::App* report = app.add_subcommand("report", "Draw pictures and plots of the results on one page");
  CLI::App* list = app.add_subcommand("list", "List the cases that ship, a line each");
  CLI::App* test = app.add_subcommand("test", "Run the project's tests (through the launcher, ./pfdm test)");
};

void describe_options(Commands& commands, Options& options) {
  commands.app.require_subcommand(1);
  commands.app.set_version_flag("--version", "pfdm " PFDM_VERSION);
  for (CLI::App* command : {commands.run, commands.check, commands.mesh, commands.cohesive, commands.compare,
                            commands.fit, commands.sweep, commands.report}) {
    command->add_option("CASE", options.case_directory, "the case directory")->required();
    command->add_option("--threads", options.threads, "number of threads (default: all cores)")
        ->check(CLI::Range(1, 4096))
        ->type_name("N");
    command->add_flag("--quiet", options.quiet, "say nothing but errors");
  }
  for (CLI::App* command : {commands.run, commands.mesh, commands.cohesive, commands.compare, commands.fit,
                            commands.sweep, commands.report})
    command->add_option("--output", options.output, "results directory (default: CASE/results)")->type_name("DIR");
  commands.run->add_flag("--restart", options.restart, "go on from the last complete output");
  commands.run->add_option("--max-steps", options.max_steps, "stop after N load steps; --restart goes on from there")
      ->check(CLI::Range(1, 1000000000))
      ->type_name("N");
  commands.sweep->add_flag("--slurm", options.slurm, "hand the runs that are not there to Slurm, or collect them");
  commands.sweep->add_option("--prepared", options.prepared, "make this one of the runs that --slurm has prepared")
      ->type_name("RUN")
      ->needs("--output")
      ->group("");
  commands.list->add_flag("--laws", options.laws, "list laws, boundary conditions and generators instead");
}

/// CLI11 would only say that a command is missing.
void require_known_command(const Commands& commands, const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front().starts_with("-")) return;
  std::vector<std::string> names;
  for (const CLI::App* command : commands.app.get_subcommands({})) names.push_back(command->get_name());
  if (std::ranges::count(names, arguments.front()) > 0) return;
  const auto meant = nearest(arguments.front(), names);
  throw InputError(fmt::format("there is no command \"{}\"{} (there are: {})", arguments.front(),
                               meant ? fmt::format("; did you mean \"{}\"?", *meant) : "", fmt::join(names, ", ")));
}

void do_case(const Commands& commands, const Options& options, std::ostream& out, bool terminal) {
  set_threads(options.threads);
  Log log(out, terminal, options.quiet);
  Session session{.results = options.output,
                  .restart = options.restart,
                  .max_steps = options.max_steps > 0 ? std::optional(options.max_steps) : std::nullopt,
                  .until = std::nullopt,
                  .threads = options.threads,
                  .version = PFDM_VERSION,
                  .log = log,
                  .slurm = options.slurm};
  if (options.prepared) return make_prepared_run(options.case_directory, *options.prepared, session);
  const CaseFile file = open_case(options.case_directory);
  const RunnableCase runnable = read_case(file);
  if (session.results.empty()) session.results = file.directory / "results";
  for (const auto& [command, job] :
       {std::pair(commands.run, &runnable.run), std::pair(commands.check, &runnable.check),
        std::pair(commands.mesh, &runnable.mesh), std::pair(commands.cohesive, &runnable.cohesive),
        std::pair(commands.compare, &runnable.compare), std::pair(commands.fit, &runnable.fit),
        std::pair(commands.sweep, &runnable.sweep), std::pair(commands.report, &runnable.report)}) {
    if (!command->parsed()) continue;
    if (!*job)
      throw InputError(fmt::format("{}: this kind of case has no \"{}\"", options.case_directory, command->get_name()));
    (*job)(session);
  }
}

void do_command(const Commands& commands, const Options& options, std::ostream& out, bool terminal) {
  if (commands.test->parsed())
    throw InputError("the tests are built and run by the launcher at the root of the checkout: ./pfdm test");
  if (!commands.list->parsed()) return do_case(commands, options, out, terminal);
  if (options.laws)
    list_laws(out);
  else
    list_cases(PFDM_CASES_DIR, out);
}

}  // namespace

int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err, bool terminal) {
  Commands commands;
  Options options;
  describe_options(commands, options);
  try {
    require_known_command(commands, arguments);
    commands.app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 wants the last first
    do_command(commands, options, out, terminal);
    return done;
  } catch (const CLI::ParseError& error) {
    return commands.app.exit(error, out, err) == 0 ? done : input_wrong;
  } catch (const InputError& error) {
    err << "pfdm: " << error.what() << '\n';
    return input_wrong;
  } catch (const ComputationError& error) {
    err << "pfdm: " << error.what() << '\n';
  } catch (const std::bad_alloc&) {
    err << "pfdm: there is not enough memory; pfdm check says how much a case needs\n";
  } catch (const std::exception& error) {
    err << "pfdm: internal error: " << error.what() << '\n';
  }
  return computation_failed;
}

}  // namespace pfdm
