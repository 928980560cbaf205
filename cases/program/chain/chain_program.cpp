#include "cases/program/chain/chain_program.h"

#include "cases/program/chain/chain_case.h"
#include "cases/program/chain/chain_page.h"
#include "cases/program/chain/chain_record.h"
#include "cases/program/chain/chain_step.h"
#include "cases/program/input/config/result_number.h"
#include "cases/program/session/head_line.h"
#include "cases/program/session/report_parts.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/folder_lock.h"
#include "postproc/files/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

struct ChainProgram {
  std::string name;
  ChainCase chain;
};

fs::path folder_of(const ChainStep& step) { return results_of(step).parent_path(); }

/// The step's case, if it is a file of its own, and its data.
std::vector<fs::path> files_of(const ReadyStep& ready) {
  std::vector<fs::path> named = data_files_named(ready.file);
  if (ready.step.where.extension() == ".toml") named.push_back(ready.step.where);
  return named;
}

/// Of the step's case and data, those that are results of earlier steps, by their way from the step's folder.
std::vector<std::string> files_taken(const ChainProgram& program, const ReadyStep& ready) {
  std::vector<std::string> taken;
  for (const ChainStep& earlier : program.chain.steps) {
    if (&earlier == &ready.step) break;
    for (const fs::path& file : files_of(ready))
      if (lies_in(file, results_of(earlier))) taken.push_back(fs::relative(file, folder_of(ready.step)).string());
  }
  return taken;
}

/// Whether a file or a number of the step is a result of `earlier`.
bool takes_from(const ReadyStep& ready, const ChainStep& earlier) {
  std::vector<fs::path> sources = files_of(ready);
  for (const TakenNumber& number : numbers_taken(ready.file)) sources.push_back(ready.file.directory / number.from);
  return std::ranges::any_of(sources, [&](const fs::path& file) { return lies_in(file, results_of(earlier)); });
}

/// Throws InputError for a step that takes files or numbers from one after it: it would be done with what that had
/// before, and the chain be complete all the same.
void require_order(const ChainProgram& program, const ReadyStep& ready) {
  std::vector<fs::path> known{ready.results};  // of the step and those before it
  bool is_later = false;
  for (const ChainStep& other : program.chain.steps) {
    if (&other == &ready.step)
      is_later = true;
    else if (!is_later)
      known.push_back(results_of(other));
    else if (std::ranges::find(known, results_of(other)) == known.end() && takes_from(ready, other))
      throw ready.step.place.error(fmt::format(
          "\"{}\" takes from results of \"{}\", which comes after it; put that first", ready.step.name, other.name));
  }
}

/// Whether a file of the step's results is gone that a later step took, as the record has it.
bool lacks_what_was_taken(const ChainProgram& program, const ReadyStep& ready, const ChainRecord& record) {
  for (const ChainStep& other : program.chain.steps) {
    const DoneStep* const done = record.find(other.name);
    if (&other == &ready.step || done == nullptr) continue;
    std::vector<fs::path> files;
    for (const std::string& file : done->files) files.push_back(folder_of(other) / file);
    for (const TakenNumber& number : done->taken) files.push_back(folder_of(other) / number.from);
    if (std::ranges::any_of(files, [&](const fs::path& f) { return lies_in(f, ready.results) && !fs::exists(f); }))
      return true;
  }
  return false;
}

/// The record of a step that need not be done again; null if it must.
const DoneStep* done_before(const ChainProgram& program, const ChainRecord& record, const ReadyStep& ready,
                            const std::string& version) {
  const DoneStep* const done = record.version == version ? record.find(ready.step.name) : nullptr;
  if (done == nullptr || done->does != ready.step.job->name || done->key != ready.key) return nullptr;
  if (!fs::is_regular_file(ready.outcome()) || content_hash(ready.outcome()) != done->outcome) return nullptr;
  return lacks_what_was_taken(program, ready, record) ? nullptr : done;
}

/// "sound" of a fit; empty for other jobs. Throws NoConvergence for one on which nothing may be built: that has failed,
/// or whose verdict is worse than the step accepts.
std::string verdict_of(const ReadyStep& ready, Log& log) {
  if (ready.step.job->name != "fit") return "";
  std::string verdict = read_json(ready.outcome(), "fit",
                                  [](const auto& json) { return json.at("verdict").template get<std::string>(); });
  const Verdict found = verdict_named(verdict);
  if (found == Verdict::failed)
    throw NoConvergence(fmt::format("step {}: the fit has failed ({} says why); the chain ends here", ready.step.name,
                                    ready.outcome().string()));
  if (found > ready.step.accepted)
    throw NoConvergence(
        fmt::format("step {}: the fit is {} ({} says why); the chain ends here. accept = \"{}\" in its "
                    "[[step]] builds on it all the same",
                    ready.step.name, verdict, ready.outcome().string(), verdict));
  if (!is_sound(found))
    log.warn(fmt::format("step {}: the fit is {} ({} says why); later steps use its estimates all the same",
                         ready.step.name, verdict, ready.outcome().string()));
  return verdict;
}

DoneStep record_of(const ChainProgram& program, const ReadyStep& ready, double seconds, Log& log) {
  DoneStep done{.name = ready.step.name,
                .does = std::string(ready.step.job->name),
                .key = ready.key,
                .outcome = content_hash(ready.outcome()),
                .wall_seconds = seconds,
                .verdict = verdict_of(ready, log),
                .taken = numbers_taken(ready.file),
                .files = files_taken(program, ready)};
  for (const ChainFigure& figure : ready.step.figures) {
    const auto number = [&](const std::string& key, const ConfigValue& place) {
      return place.in_context([&] { return number_in_results(ready.results, figure.file, key); });
    };
    done.figures.push_back({figure.says, number(figure.key, figure.place), figure.unit.value_or("")});
    for (const ConfigValue& end : figure.interval) done.figures.back().interval.push_back(number(end.string(), end));
  }
  return done;
}

DoneStep do_step(const ChainProgram& program, const ReadyStep& ready, bool restart, Session& session) {
  const Stopwatch watch;
  const std::unique_ptr<Log> log = session.log.with_own_file();
  Session own{.results = ready.results,
              .restart = restart && ready.runnable.goes_on,
              .max_steps = std::nullopt,
              .until = std::nullopt,
              .threads = session.threads,
              .version = session.version,
              .read_case = session.read_case,
              .log = *log};
  make_folder(ready.results);
  ready.job()(own);
  return record_of(program, ready, watch.seconds(), session.log);
}

void say_taken(const ReadyStep& ready, Log& log) {
  for (const TakenNumber& number : numbers_taken(ready.file))
    log.say(fmt::format("  {} = {:.6g}, {} of {}", number.into, number.value, number.key, number.from));
}

/// Whose results go elsewhere than into the chain's folder.
void say_outside(const ChainProgram& program, Log& log) {
  std::vector<std::string> outside;
  for (const ChainStep& step : program.chain.steps)
    if (step.outside) outside.push_back(fmt::format("{} ({})", step.name, results_of(step).string()));
  if (!outside.empty())
    log.say(fmt::format("results of {} go outside of the chain's folder: {}",
                        counted(static_cast<Index>(outside.size()), "step"), fmt::join(outside, ", ")));
}

void check(const ChainProgram& program, Session& session) {
  Log& log = session.log;
  log.say(fmt::format("{}: {}", program.name, program.chain.title));
  say_outside(program, log);
  for (const ChainStep& step : program.chain.steps) require_known_figures(step, session);
  const ChainRecord record = read_chain(session.results);
  const ChainStep* waited_for = nullptr;  // the first that has to be done
  std::vector<const ChainStep*> open;     // what has to be done, and what depends on it
  for (const ChainStep& step : program.chain.steps) {
    std::optional<ReadyStep> read;
    try {
      read.emplace(get_ready(step, session));
    } catch (const InputError& error) {
      if (waited_for == nullptr) throw;
      log.say(
          fmt::format("step {}: {}, waits for \"{}\" ({})", step.name, step.job->name, waited_for->name, error.what()));
      continue;
    }
    const ReadyStep& ready = *read;
    require_order(program, ready);
    warn_of_absent_figures(ready, log);
    const bool done = done_before(program, record, ready, session.version) != nullptr;
    if (!done && waited_for == nullptr) waited_for = &step;
    const auto source = std::ranges::find_if(open, [&](const ChainStep* s) { return takes_from(ready, *s); });
    const std::string state = !done ? "to be done"
                              : source == open.end()
                                  ? "done"
                                  : fmt::format("done again if \"{}\" gives it other values", (*source)->name);
    if (!done || source != open.end()) open.push_back(&step);
    log.say(fmt::format("step {}: {}, {}", step.name, step.job->name, state));
    say_taken(ready, log);
  }
  log.say(fmt::format("results go to {}, those of the steps to their own cases", session.results.string()));
  log.say("the input is valid");
}

/// What an interruption leaves: steps that come later may still be as they were done.
ChainRecord with_later_steps(ChainRecord record, const ChainRecord& earlier) {
  for (const DoneStep& step : earlier.steps)
    if (record.find(step.name) == nullptr) record.steps.push_back(step);
  return record;
}

void run_case(const ChainProgram& program, Session& session) {
  if (session.max_steps) throw InputError("a chain has no load steps: --max-steps is for the cases of its steps");
  for (const ChainStep& step : program.chain.steps) require_known_figures(step, session);
  const FolderLock lock(session.results);
  Log& log = session.log;
  log.open_file(session.results / "run.log", false);
  log.say(head_line(session, fmt::format("case {}: {}", program.name, program.chain.title)));
  say_outside(program, log);
  const ChainRecord earlier = read_chain(session.results);
  ChainRecord record{.case_name = program.name, .status = "incomplete", .version = session.version, .steps = {}};
  const Stopwatch watch;
  bool restart = session.restart;
  for (const ChainStep& step : program.chain.steps) {
    const ReadyStep ready = get_ready(step, session);
    require_order(program, ready);
    const std::string place =
        fmt::format("step {} of {}: {}", record.steps.size() + 1, program.chain.steps.size(), step.name);
    if (const DoneStep* done = done_before(program, earlier, ready, session.version)) {
      log.say(fmt::format("{}: done before", place));
      record.steps.push_back(*done);
      continue;
    }
    log.say(fmt::format("{}: {} {}", place, step.job->name, step.where.string()));
    say_taken(ready, log);
    record.steps.push_back(do_step(program, ready, std::exchange(restart, false), session));
    write_chain(session.results, with_later_steps(record, earlier));
  }
  record.status = "complete";
  write_chain(session.results, record);
  write_report({.report = chain_page(record, program.chain.title)}, session);
  log.say(fmt::format("complete after {:.1f} s; results in {}", watch.seconds(), session.results.string()));
}

CasePage page_of(const ChainProgram& program, const Session& session) {
  const ChainRecord record = read_chain(session.results);
  if (record.steps.empty())
    throw InputError(fmt::format("{}: there are no results; pfdm run makes them", session.results.string()));
  return {.report = chain_page(record, program.chain.title)};
}

RunnableCase read_program(const CaseFile& file) {
  const auto program = std::make_shared<const ChainProgram>(
      ChainProgram{.name = case_name(file), .chain = read_chain_case(file.config.root(), file.directory)});
  return {.title = program->chain.title,
          .check = [program](Session& session) { check(*program, session); },
          .run = [program](Session& session) { run_case(*program, session); },
          .page = [program](const Session& session) { return page_of(*program, session); },
          .goes_on = true};
}

}  // namespace

CaseKind chain_kind() {
  return {.name = "chain",
          .description = "jobs of other cases one after the other, which take numbers from each other's results",
          .read = read_program,
          .keys = [] { return std::vector<const KeyTable*>{&chain_keys()}; }};
}

}  // namespace pfdm
