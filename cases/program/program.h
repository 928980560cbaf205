#pragma once
// The command line.

#include <ostream>
#include <string>
#include <vector>

namespace pfdm {

/// Does what `arguments` (without the program's name) say. Returns the exit status: 0 done, 1 the computation failed,
/// 2 the input is wrong, 130 or 143 interrupted (SIGINT, SIGTERM); a failure is one message on `err`. `terminal` says
/// whether `out` is one.
int run_program(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err, bool terminal = false);

}  // namespace pfdm
