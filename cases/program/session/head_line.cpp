#include "cases/program/session/head_line.h"

#include "postproc/curves/instruction_set.h"

#include <fmt/format.h>

namespace pfdm {

std::string counted(Index n, const std::string& noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

std::string head_line(const Session& session, const std::string& what) {
  return fmt::format("pfdm {} ({}), {}; {}", session.version, instruction_set(), what,
                     counted(session.threads, "thread"));
}

}  // namespace pfdm
