#include "cases/program/chain/chain_case.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr ChainJob jobs[] = {
    {"run", "as pfdm run", &RunnableCase::run, "summary.json"},
    {"fit", "as pfdm fit", &RunnableCase::fit, "fit.json"},
};

/// What runs and fits of all kinds write numbers into.
const std::string files_of_numbers[] = {"summary.json",     "fit.json",      "fit_models.json",
                                        "homogenized.json", "cohesive.json", "first_debonding.json"};

ChainFigure read_figure(const ConfigTable& table, const ChainJob& job) {
  ChainFigure figure{.says = table.string("says"),
                     .file = table.string("file", job.outcome),
                     .key = table.string("key"),
                     .unit = std::nullopt,
                     .interval = {},
                     .place = table.at("key")};
  if (table.has("unit")) figure.unit = table.string("unit");
  if (const auto interval = table.find("interval")) figure.interval = interval->list(2);
  if (fs::path(figure.file).has_parent_path())
    throw table.at("file").error(fmt::format("\"{}\" is not the name of a file in the step's results", figure.file));
  if (table.has("file")) table.at("file").one_of(files_of_numbers, "file of numbers in a step's results");
  return figure;
}

Verdict read_accepted(const ConfigTable& table, const ChainJob& job) {
  const auto accept = table.find("accept");
  if (!accept) return worst_sound;
  if (job.name != "fit") throw accept->error("only a step that does \"fit\" has a verdict");
  return accept->choice() == "sound" ? worst_sound : Verdict::questionable;
}

/// Results go beside the step's case: not into folders of others without a word.
bool read_outside(const ConfigTable& table, const ConfigValue& place, const fs::path& where,
                  const fs::path& directory) {
  const bool allowed = table.boolean("outside", false);
  if (lies_in(where, directory)) return false;
  if (allowed) return true;
  throw place.error(
      fmt::format("\"{}\" lies outside of the chain's folder, and the step's results would go there: outside = true in "
                  "its [[step]] allows it",
                  place.string()));
}

ChainStep read_step(const ConfigTable& table, const fs::path& directory) {
  const ConfigValue place = table.at("case");
  const auto does = table.find("does");
  ChainStep step{.name = table.string("name", fs::path(place.string()).lexically_normal().string()),
                 .where = (directory / place.string()).lexically_normal(),
                 .job = does ? &choose(*does, chain_jobs(), "job of a step") : &jobs[0],
                 .figures = {},
                 .place = place};
  if (!fs::path(place.string()).is_relative())
    throw place.error("the way to a step's case starts at the chain's directory; this path does not");
  step.outside = read_outside(table, place, step.where, directory);
  step.accepted = read_accepted(table, *step.job);
  for (const ConfigTable& figure : table.tables("figures")) step.figures.push_back(read_figure(figure, *step.job));
  return step;
}

}  // namespace

bool lies_in(const fs::path& file, const fs::path& folder) {
  const fs::path inner = fs::weakly_canonical(fs::absolute(file)), outer = fs::weakly_canonical(fs::absolute(folder));
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

std::span<const ChainJob> chain_jobs() { return jobs; }

ChainCase read_chain_case(const ConfigTable& root, const fs::path& case_directory) {
  root.with_keys(chain_keys());
  if (const auto sweep = root.find("sweep"))
    throw sweep->error("a chain has no sweep: the cases of its steps may have one");
  ChainCase chain{.title = root.line("title"), .steps = {}};
  for (const ConfigTable& table : root.tables("step")) {
    ChainStep step = read_step(table, case_directory);
    const auto same = [&](const ChainStep& other) { return other.name == step.name; };
    if (std::ranges::any_of(chain.steps, same))
      throw step.place.error(fmt::format("there are two steps \"{}\"; give one of them another \"name\"", step.name));
    chain.steps.push_back(std::move(step));
  }
  if (chain.steps.empty()) throw root.error("there is no step; at least one [[step]] is required");
  return chain;
}

}  // namespace pfdm
