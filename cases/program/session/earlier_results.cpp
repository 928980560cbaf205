#include "cases/program/session/earlier_results.h"

#include "cases/program/input/case_files/kept_case.h"
#include "physics/error.h"
#include "postproc/curves/summary.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

/// A summary that cannot be read is as good as none: a new one takes its place.
std::optional<ReadSummary> find_earlier(const std::filesystem::path& results) {
  try {
    return read_summary(results / summary_file);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

struct Remark {
  std::string what;     ///< the earlier results are
  std::string restart;  ///< what it would do
  bool of_other_input = false;
};

Remark remark_on(const std::optional<ReadSummary>& earlier, const std::string& hash) {
  constexpr const char* goes_on = "; --restart would continue them";
  if (!earlier) return {"are of an unfinished run", goes_on};
  if (earlier->case_hash != hash) return {"belong to different input", "", true};
  if (earlier->status == "complete") return {"are complete", "; with --restart they would be kept"};
  return {fmt::format("are of a run that ended early ({})", earlier->status), goes_on};
}

}  // namespace

std::optional<std::string> status_of_earlier(const std::filesystem::path& results) {
  const auto earlier = find_earlier(results);
  return earlier ? std::optional(earlier->status) : std::nullopt;
}

void say_what_is_replaced(Session& session, const CaseFile& file, const std::string& hash, bool can_go_on) {
  const Remark remark = remark_on(find_earlier(session.results), hash);
  const std::string more = remark.of_other_input ? words_on_changes(file, session.results)
                           : can_go_on           ? remark.restart
                                                 : std::string();
  session.log.say(fmt::format("the results in {} {}: this run starts anew and replaces them once it has its own{}",
                              session.results.string(), remark.what, more));
}

}  // namespace pfdm
