#pragma once
// The first line of a log.

#include "cases/program/session/session.h"

#include <string>

namespace pfdm {

/// "1 thread", "2 threads".
std::string counted(Index n, const std::string& noun);

/// "pfdm 0.2.0 (x86-64-v3), case bar: A bar in tension; 2 threads". `what`: what is done.
std::string head_line(const Session& session, const std::string& what);

}  // namespace pfdm
