#include "cases/program/program.h"

#include "cases/program/commands.h"
#include "cases/program/completion.h"
#include "cases/program/help_words.h"
#include "cases/program/input/case_files/case_override.h"
#include "cases/program/input/case_files/kept_case.h"
#include "cases/program/kinds.h"
#include "cases/program/listing.h"
#include "cases/program/manual_page.h"
#include "cases/program/new_case.h"
#include "cases/program/reference/key_help.h"
#include "cases/program/reference/key_reference.h"
#include "cases/program/reference/key_schema.h"
#include "cases/program/reference/key_search.h"
#include "cases/program/session/page_origin.h"
#include "cases/program/session/terminal/external_program.h"
#include "cases/program/session/terminal/message_text.h"
#include "cases/program/session/terminal/stop_signal.h"
#include "cases/program/specimens/new_specimen.h"
#include "cases/program/specimens/specimen_file.h"
#include "cases/program/studies/sweep/comparison_page.h"
#include "cases/program/studies/sweep/sweep_on_slurm.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/other_case.h"
#include "solver/parallel.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

namespace pfdm {
namespace {

enum ExitStatus { done = 0, computation_failed = 1, input_wrong = 2 };

/// Those of a job's options that say which case and which results its next command is about.
std::string options_of(const CommandLine& line) {
  std::string options;
  for (const std::string& word : line.set) options += fmt::format(" --set {}", quoted(word));
  return line.output.empty() ? options : fmt::format("{} --output {}", options, shell_word(line.output));
}

/// A command on the same case and results, as the user would give it.
std::string command_on_same(const CommandLine& line, std::string_view command) {
  return fmt::format("{} {} {}{}", called_as(), command, shell_word(line.case_directory), options_of(line));
}

/// What is kept after an interruption, and how the job is continued.
std::string way_on(const CommandLine& line, const RunnableCase& runnable) {
  const bool keeps_runs = line.command == "sensitivity" && line.sensitivity.method != "direct";
  if (line.command == "sweep" || keeps_runs || (line.command == "fit" && runnable.goes_on))
    return "; what has been computed is kept, and the same command continues it";
  if (!runnable.goes_on && (line.command == "run" || line.command == "fit"))
    return fmt::format("; earlier results are unchanged, and the same command starts the {} from the beginning",
                       line.command);
  if (line.command != "run") return "";
  return fmt::format("; {} --restart continues from the last complete step", command_on_same(line, "run"));
}

LiveCommands live_commands(const CommandLine& line) {
  return {.command = command_on_same(line, "run"), .report = command_on_same(line, "report")};
}

/// The command that looks at what a run, or a sweep, has made.
void say_next(const CommandLine& line, const RunnableCase& runnable, Log& log) {
  if ((line.command == "run" || (line.command == "sweep" && !line.slurm)) && runnable.report)
    log.say("next: " + command_on_same(line, "report"));
}

const std::function<void(Session&)>& job_of(const CommandLine& line, const RunnableCase& runnable) {
  const std::pair<const char*, const std::function<void(Session&)>*> jobs[] = {
      {"run", &runnable.run},           {"check", &runnable.check},     {"mesh", &runnable.mesh},
      {"cohesive", &runnable.cohesive}, {"compare", &runnable.compare}, {"reduce", &runnable.reduce},
      {"fit", &runnable.fit},           {"sweep", &runnable.sweep},     {"sensitivity", &runnable.sensitivity},
      {"analyse", &runnable.analyse},   {"report", &runnable.report}};
  for (const auto& [command, job] : jobs)
    if (line.command == command && *job) return *job;
  throw InputError(fmt::format("{}: this kind of case has no \"{}\"", line.case_directory, line.command));
}

CaseFile open_case_or_name_nearest(const std::string& where) {
  if (!std::filesystem::exists(where))
    if (const auto near = nearest_case(where, shipped_cases()))
      throw InputError(fmt::format("{}: there is no such case directory; did you mean \"{}\"?", where, *near));
  return open_case(where);
}

/// Signals that come while no loop looks for them end the process with one line, on a terminal in place of the
/// progress.
std::string said_at_once(const std::string& way) {
  return fmt::format("{}pfdm: interrupted{}\n", isatty(STDERR_FILENO) == 1 ? "\r\x1b[K" : "", way);
}

void do_job(const std::function<void(Session&)>& job, Session& session, const std::string& way) {
  const StopSignals signals(said_at_once(way));
  try {
    job(session);
  } catch (const Interrupted& wish) {
    throw Interrupted(wish.signal, wish.what() + way);
  }
}

/// Parts of the program that know no file speak of interfaces and patches: the case is named before what they say.
std::string with_place(const std::string& message, const CaseFile& file) {
  const bool names_one = message.find('/') < message.find(": ") || message.starts_with("--");
  if (names_one || message.find(".toml") != std::string::npos) return message;
  return fmt::format("{}: {}", (file.directory / (file.stem + ".toml")).string(), message);
}

void do_comparison(const CommandLine& line, Session& session) {
  if (!line.set.empty()) throw InputError("--set is for one case: runs that are set side by side are as they ran");
  if (session.results.empty()) session.results = "comparison";
  const StopSignals signals(said_at_once(""));
  report_compared(line.cases, session);
}

void do_case(const CommandLine& line, std::ostream& out, std::ostream& err, bool terminal) {
  set_threads(line.threads);
  Log log(out, err, terminal, line.quiet);
  Session session{.results = line.output,
                  .restart = line.restart,
                  .max_steps = line.max_steps,
                  .until = std::nullopt,
                  .threads = line.threads,
                  .version = PFDM_VERSION,
                  .read_case = read_case,
                  .log = log,
                  .strict = line.strict,
                  .slurm = line.slurm,
                  .curve_to = line.curve_to,
                  .exports = line.exports,
                  .sensitivity = line.sensitivity,
                  .numbers_like = numbers_like};
  if (line.cases.size() > 1) return do_comparison(line, session);
  if (line.prepared)
    return do_job([&](Session& s) { make_prepared_run(line.case_directory, *line.prepared, s); }, session, "");
  const CaseFile file = with_overrides(open_case_or_name_nearest(line.case_directory), line.set);
  try {
    const RunnableCase runnable = read_case(file);
    for (const std::string& remark : file.config.remarks()) log.say(remark);
    if (session.results.empty()) session.results = own_results(file);
    if ((!line.curve_to.empty() || line.live) && !runnable.has_steps)
      throw InputError(
          fmt::format("{}: only runs of kind \"fracture\", and of kind \"homogenize\" along a path of loads, "
                      "have steps to follow",
                      line.live ? "--live" : "--curve-to"));
    if (line.live) session.live = live_commands(line);
    do_job(job_of(line, runnable), session, way_on(line, runnable));
    say_next(line, runnable, log);
  } catch (const OtherCase& error) {
    throw InputError(error.what() + words_on_changes(file, session.results));
  } catch (const InputError& error) {
    throw InputError(with_place(error.what(), file));
  }
}

/// What --specimen would pass over.
void require_name_of_specimen(const CommandLine& line) {
  const bool lists = line.specimen->empty() || line.new_directory.empty();
  if (!lists || (line.new_directory.empty() && line.records.empty() && line.set.empty())) return;
  throw InputError(fmt::format(
      "init: {}, as in: pfdm init my_test --specimen double_cantilever_beam --data record.csv",
      line.specimen->empty()
          ? fmt::format("--specimen needs the name of one ({})", fmt::join(specimen_names(shipped_cases()), ", "))
          : "a new directory is required beside --specimen, --data and --set"));
}

void do_specimen(const CommandLine& line, std::ostream& out) {
  require_name_of_specimen(line);
  if (line.specimen->empty()) return list_specimens(shipped_cases(), out);
  if (line.new_directory.empty()) return list_specimen_values(shipped_cases(), *line.specimen, out);
  require_empty(line.new_directory);
  make_specimen({.directory = line.new_directory,
                 .specimen = *line.specimen,
                 .records = {line.records.begin(), line.records.end()},
                 .set = line.set,
                 .cases = shipped_cases(),
                 .called_as = called_as()},
                out);
}

void do_init(const CommandLine& line, std::ostream& out) {
  if (line.specimen) return do_specimen(line, out);
  if (line.like.empty() || line.new_directory.empty()) {
    list_cases(shipped_cases(), out);
    throw InputError(
        "init: a new directory and a case to start from are required, one of those above or any other, as in: pfdm "
        "init my_case --like glass_bead_quick");
  }
  const std::filesystem::path shipped = shipped_cases() / line.like;
  const bool by_name = !std::filesystem::exists(line.like) && std::filesystem::exists(shipped / "case.toml");
  if (!by_name) open_case_or_name_nearest(line.like);
  make_case(line.new_directory, by_name ? shipped : std::filesystem::path(line.like), out);
}

std::vector<KindKeys> keys_of_kinds() {
  std::vector<KindKeys> kinds;
  for (const CaseKind& kind : case_kinds()) kinds.push_back({kind.name, kind.keys()});
  return kinds;
}

void require_all_kinds() {
  if (case_kinds().size() < std::size(all_kind_names))
    throw InputError(
        "this program was built for fracture cases alone; the schema of all kinds is cases/case.schema.json, the "
        "reference "
        "cases/reference");
}

void write_schema(const CommandLine& line, std::ostream& out) {
  require_all_kinds();
  if (line.reference.empty()) {
    out << key_schema(keys_of_kinds());
    return;
  }
  std::filesystem::create_directories(line.reference);
  for (const auto& [name, text] : key_reference(keys_of_kinds()))
    write_file(std::filesystem::path(line.reference) / name, text);
}

void do_command(const CommandLine& line, std::ostream& out, std::ostream& err, bool terminal) {
  if (line.command == "test")
    throw InputError("the tests are built and run by the launcher at the root of the checkout: ./pfdm test");
  if (line.command == "init") return do_init(line, out);
  if (line.man) {
    out << manual_page(command_words(), PFDM_VERSION);
    return;
  }
  if (!line.told_command.empty()) return help_on_keys_beside(line.told_command, keys_of_kinds(), out);
  if (line.command == "help")
    return line.key.empty() ? write_schema(line, out)
                            : help_on(line.key, keys_of_kinds(), shipped_cases() / "guides", out);
  if (line.command == "completion") {
    out << completion_script(line.shell, command_words(), names_of_keys(keys_of_kinds()));
    return;
  }
  if (line.command != "list") return do_case(line, out, err, terminal);
  if (line.laws)
    list_laws(out);
  else
    list_cases(shipped_cases(), out);
}

/// Whether the fault is in the name of a file, not in what became of it.
bool is_about_a_name(const std::error_code& code) {
  constexpr std::errc faults[] = {std::errc::filename_too_long, std::errc::no_such_file_or_directory,
                                  std::errc::not_a_directory, std::errc::permission_denied,
                                  std::errc::too_many_symbolic_link_levels};
  return std::ranges::any_of(faults, [&](std::errc fault) { return code == fault; });
}

}  // namespace

int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err, bool terminal) {
  const auto say_error = [&err](std::string_view message) { err << "pfdm: " << error_text(message) << '\n'; };
  try {
    if (const auto line = read_command_line(arguments, out)) do_command(*line, out, err, terminal);
    return done;
  } catch (const Interrupted& wish) {
    err << "pfdm: " << wish.what() << '\n';
    return exit_status_of_signal(wish.signal);
  } catch (const InputError& error) {
    say_error(error.what());
    return input_wrong;
  } catch (const ComputationError& error) {
    err << "pfdm: " << message_text(error.what()) << '\n';  // with all advice
  } catch (const std::bad_alloc&) {
    say_error("there is not enough memory; pfdm check says how much a fracture case needs");
  } catch (const std::filesystem::filesystem_error& error) {
    say_error(fmt::format("{}: {}", error.path1().string(), error.code().message()));
    if (is_about_a_name(error.code())) return input_wrong;
  } catch (const std::system_error& error) {
    say_error(fmt::format("the system refuses a thread, a file or memory: {}", error.code().message()));
  } catch (const std::exception& error) {
    say_error(fmt::format("internal error: {}", error.what()));
  }
  return computation_failed;
}

}  // namespace pfdm
