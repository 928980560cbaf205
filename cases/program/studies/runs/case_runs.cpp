#include "cases/program/studies/runs/case_runs.h"

#include "cases/program/input/case_files/kept_case.h"
#include "cases/program/session/runnable_case.h"
#include "cases/program/session/terminal/stop_signal.h"
#include "postproc/curves/summary.h"
#include "postproc/displacements/displacement_field.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/folder_lock.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <sstream>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr const char* failure_file = "failure.txt";
enum RunStatus { run_went_well = 0, run_did_not_converge = 1, run_broke_off = 2 };

constexpr std::string_view laws_in_key = "_laws";  // of runs that record them

/// Tables that a run does not look at, or whose files it does not write here.
constexpr std::string_view without_influence[] = {"experiment", "fit", "sweep"};

/// Nothing if there is no run in the folder, or none that has come as far as is asked for. One that has, and failed
/// later, is as good as any.
std::optional<DoneRun> done_run_in(const fs::path& folder, std::optional<double> until) {
  const auto summary = read_summary(folder / summary_file);
  if (summary && summary->status == "complete") return DoneRun{folder, {}};
  if (summary && until && summary->number("final_displacement_m") >= *until) return DoneRun{folder, {}};
  if (!fs::exists(folder / failure_file)) return std::nullopt;
  return DoneRun{folder, std::string(trimmed(read_file(folder / failure_file)))};
}

}  // namespace

std::string CaseRuns::Wanted::known_as() const { return until ? fmt::format("{} until {}", key, *until) : key; }

CaseRuns::CaseRuns(fs::path folder, const Session& session) : folder_(std::move(folder)), session_(session) {
  session_.meshes = &meshes_;
}

std::string CaseRuns::key_of(const CaseVariant& variant) {
  const std::vector<fs::path> data = session_.read_case(variant.file).data_files;
  return fmt::format("{}{}_{}", case_hash(variant.file, data, without_influence), recorded_, session_.version);
}

void CaseRuns::record(const std::vector<FieldPlace>& places) {
  if (places.empty()) return;
  session_.places = &places;
  recorded_ = fmt::format("_{:016x}", hash_of(places));
}

void CaseRuns::record_laws() {
  session_.records_laws = true;
  recorded_ += laws_in_key;
}

/// A variant that cannot be is remembered so; its key is what is shown of it.
std::vector<CaseRuns::Wanted> CaseRuns::wanted(const std::vector<CaseVariant>& variants, std::optional<double> until) {
  std::vector<Wanted> all;
  for (const CaseVariant& variant : variants) {
    all.push_back({variant.shown, &variant, until, {}});
    Wanted& wanted = all.back();
    try {
      wanted.key = key_of(variant);
      wanted.folder = folder_ / wanted.key;
    } catch (const InputError& error) {  // values that the case's own rules exclude
      if (!known_.contains(wanted.known_as()))
        session_.log.warn(fmt::format("the case cannot be run with {}: {}", variant.shown, error.what()));
      remember(wanted, {{}, error.what()});
    }
  }
  return all;
}

std::vector<CaseRuns::Wanted> CaseRuns::not_there(const std::vector<Wanted>& all) {
  std::vector<Wanted> missing;
  for (const Wanted& wanted : all) {
    const bool asked_for = std::ranges::any_of(missing, [&](const Wanted& other) { return other.key == wanted.key; });
    if (!asked_for && !find(wanted)) missing.push_back(wanted);
  }
  return missing;
}

std::vector<DoneRun> CaseRuns::run(const std::vector<CaseVariant>& variants, std::optional<double> until) {
  const std::vector<Wanted> all = wanted(variants, until);
  const std::vector<Wanted> missing = not_there(all);
  if (!missing.empty()) make(missing);
  std::vector<DoneRun> results;
  results.reserve(all.size());
  for (const Wanted& wanted : all) results.push_back(known_.at(wanted.known_as()));
  return results;
}

std::vector<MissingRun> CaseRuns::missing(const std::vector<CaseVariant>& variants) {
  std::vector<MissingRun> result;
  for (const Wanted& wanted : not_there(wanted(variants, std::nullopt))) result.push_back({wanted.key, wanted.variant});
  return result;
}

void CaseRuns::run_here(const CaseVariant& variant, const std::string& key) {
  if (key.find(laws_in_key) != std::string::npos && !session_.records_laws) record_laws();
  if (key_of(variant) != key)
    throw InputError(fmt::format(
        "{}: the program or files that the case reads have changed since this run was prepared", variant.shown));
  const Wanted wanted{key, &variant, std::nullopt, folder_ / key};
  if (!find(wanted)) ended(wanted, {.status = do_run(wanted, session_.threads, session_.log), .signal = 0});
}

void CaseRuns::remember(const Wanted& wanted, const DoneRun& done) {
  known_[wanted.known_as()] = done;
  if (!done.went_well()) failed_.insert(wanted.key);
}

bool CaseRuns::find(const Wanted& wanted) {
  if (known_.contains(wanted.known_as())) return true;
  const auto done = done_run_in(wanted.folder, wanted.until);
  if (!done) return false;
  remember(wanted, *done);
  if (!made_.contains(wanted.key) && reused_.insert(wanted.key).second)
    session_.log.step(
        fmt::format("  reused: {}{}", wanted.variant->shown, done->went_well() ? "" : ", did not converge"));
  return true;
}

void CaseRuns::make(const std::vector<Wanted>& missing) {
  const RunnableCase first = session_.read_case(missing.front().variant->file);
  if (first.prepare) first.prepare(session_);
  std::vector<Job> jobs;
  jobs.reserve(missing.size());
  for (const Wanted& wanted : missing)
    jobs.push_back({.work =
                        [this, &wanted](int threads) {
                          std::ostringstream unseen;
                          Log log(unseen, unseen, false, true);
                          return do_run(wanted, threads, log);
                        },
                    .ended = [this, &wanted](const JobEnd& end) { ended(wanted, end); }});
  run_side_by_side(jobs, session_.threads);
}

/// In a process of its own.
int CaseRuns::do_run(const Wanted& wanted, int threads, Log& log) {
  Session session{.results = wanted.folder,
                  .restart = true,
                  .max_steps = std::nullopt,
                  .until = wanted.until,
                  .threads = threads,
                  .version = session_.version,
                  .read_case = session_.read_case,
                  .log = log,
                  .figures_only = true,
                  .records_laws = session_.records_laws,
                  .meshes = &meshes_,
                  .places = session_.places};
  const auto give_up = [&](const std::exception& failure) {
    write_file(wanted.folder / failure_file, std::string(failure.what()) + "\n");
    return run_did_not_converge;
  };
  try {
    make_folder(wanted.folder);
    mark_folder(wanted.folder);
    keep_case(wanted.variant->file, session_.version, wanted.folder, wanted.folder);
    session_.read_case(wanted.variant->file).run(session);
    return run_went_well;
  } catch (const NoConvergence& failure) {
    return give_up(failure);
  } catch (const FolderInUse& failure) {
    log.say(fmt::format("failed: {}", failure.what()));
    return run_broke_off;
  } catch (const InputError& failure) {
    return give_up(failure);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& failure) {
    log.say(fmt::format("failed: {}", failure.what()));
    return run_broke_off;
  }
}

void CaseRuns::ended(const Wanted& wanted, const JobEnd& end) {
  if (end.signal != 0)
    throw ComputationError(fmt::format("the run in {} was killed by signal {}{}; completed steps are kept",
                                       wanted.folder.string(), end.signal,
                                       end.signal == SIGKILL ? " (is there enough memory?)" : ""));
  const bool is_an_answer = end.status == run_went_well || end.status == run_did_not_converge;
  const auto done = is_an_answer ? done_run_in(wanted.folder, wanted.until) : std::nullopt;
  if (!done)
    throw ComputationError(fmt::format(
        "the run in {} ended without a result; see its run.log; completed steps are kept", wanted.folder.string()));
  remember(wanted, *done);
  const bool went_on = !made_.insert(wanted.key).second;
  reused_.erase(wanted.key);
  if (done->went_well()) {
    const std::string told =
        fmt::format("  {}: {}", went_on ? "continued" : fmt::format("run {}", n_made()), wanted.variant->shown);
    session_.log.step(told);
    session_.log.progress(told);
  } else {
    session_.log.warn(fmt::format("run {} did not converge: {}: {}", n_made(), wanted.variant->shown, done->failure));
  }
}

}  // namespace pfdm
