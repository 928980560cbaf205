#include "cases/program/session/runnable_case.h"

#include "physics/error.h"

#include <fmt/format.h>

namespace pfdm {

std::function<void(Session&)> job_without_table(const CaseFile& file, std::string_view table, std::string_view needed,
                                                std::string_view example) {
  return [message = fmt::format(
              "{}: the case has no [{}] table; it needs {}. cases/{} has one, and cases/README.md lists its keys",
              file.config.root().at("kind").file(), table, needed, example)](Session&) { throw InputError(message); };
}

}  // namespace pfdm
