#include "cases/program/chain/chain_step.h"

#include "cases/program/input/case_files/kept_case.h"
#include "cases/program/input/config/result_number.h"
#include "cases/program/input/fields/field_reader.h"
#include "postproc/fits/fit_json.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// Keys of the figures, each with the place that messages name.
template <class Visit>
void for_each_key(const ChainFigure& figure, const Visit& visit) {
  visit(figure.key, figure.place);
  for (const ConfigValue& end : figure.interval) visit(end.string(), end);
}

/// "" of a case that cannot be read: what is wrong is said when its turn comes.
std::string kind_of(const ChainStep& step) {
  try {
    return open_case(step.where).config.root().string("kind");
  } catch (const InputError&) {
    return "";
  }
}

}  // namespace

fs::path results_of(const ChainStep& step) {
  return (step.where.extension() == ".toml" ? step.where.parent_path() : step.where) / "results";
}

ReadyStep get_ready(const ChainStep& step, const Session& session) {
  return step.place.in_context([&] {
    CaseFile file = open_case(step.where);
    if (file.config.root().string("kind") == "chain") throw InputError("a step of a chain cannot be a chain itself");
    ReadyStep ready{step, file, session.read_case(file), own_results(file), ""};
    for (const std::string& remark : ready.file.config.remarks()) session.log.say(remark);
    if (!ready.job()) throw InputError(fmt::format("this kind of case has no \"{}\"", step.job->name));
    std::vector<fs::path> data = data_files_named(file);
    const std::vector<fs::path> fields = field_files(file);  // with the frames that their lists name
    data.insert(data.end(), fields.begin(), fields.end());
    ready.key = case_hash(file, data);
    return ready;
  });
}

void require_known_figures(const ChainStep& step, const Session& session) {
  const std::string kind = kind_of(step);
  if (kind.empty()) return;
  for (const ChainFigure& figure : step.figures) {
    std::string like;
    if (figure.file == "fit.json")
      like = fit_json_like(kind);
    else if (session.numbers_like != nullptr)
      like = session.numbers_like(kind, figure.file);
    if (like.empty()) continue;
    for_each_key(figure, [&](const std::string& key, const ConfigValue& place) {
      place.in_context([&] { require_key_like(like, figure.file, key); });
    });
  }
}

void warn_of_absent_figures(const ReadyStep& ready, Log& log) {
  for (const ChainFigure& figure : ready.step.figures) {
    if (!fs::is_regular_file(ready.results / figure.file)) continue;
    for_each_key(figure, [&](const std::string& key, const ConfigValue& place) {
      try {
        place.in_context([&] { number_in_results(ready.results, figure.file, key); });
      } catch (const InputError& error) {
        log.warn(fmt::format("{}, of the results that are there", error.what()));
      }
    });
  }
}

}  // namespace pfdm
