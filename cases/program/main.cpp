#include "cases/program/program.h"
#include "cases/program/session/terminal/stop_signal.h"
#include "postproc/curves/instruction_set.h"
#include "postproc/files/flush.h"

#include <unistd.h>

#include <csignal>
#include <exception>
#include <iostream>

namespace {

/// What was written waits no longer. Returns the status of the program.
int with_files_flushed(int status) {
  try {
    pfdm::flush_written_files();
  } catch (const std::exception& error) {
    std::cerr << "pfdm: " << error.what() << '\n';
    return status == 0 ? 1 : status;
  }
  return status;
}

volatile std::sig_atomic_t reader_is_gone = 0;

/// As of `pfdm run CASE | head`: the run goes on, only nobody listens. Programs that this one starts end by it, as
/// usual.
void outlive_readers() {
  struct sigaction action {};
  action.sa_handler = [](int) { reader_is_gone = 1; };
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGPIPE, &action, nullptr);
}

/// What was said has reached standard output, unless its reader is gone. Returns the status of the program.
int with_output_flushed(int status) {
  std::cout.flush();
  if (std::cout || reader_is_gone != 0) return status;
  std::cerr << "pfdm: cannot write to standard output: is its disk full?\n";
  return status == 0 ? 1 : status;
}

}  // namespace

int main(int argc, char** argv) {
  if (!pfdm::processor_has_instruction_set()) {
    std::cerr << "pfdm: this program was compiled for " << pfdm::instruction_set()
              << ", which this processor lacks: build it here (./pfdm does), or with -DPFDM_ARCH=x86-64-v2\n";
    return 1;
  }
  outlive_readers();
  pfdm::end_with_parent();
  const bool terminal = isatty(STDOUT_FILENO) == 1;
  const int status = with_files_flushed(pfdm::run_program({argv + 1, argv + argc}, std::cout, std::cerr, terminal));
  for (const int signal : {SIGINT, SIGTERM})
    if (status == pfdm::exit_status_of_signal(signal)) {
      std::cout.flush();
      pfdm::end_by_signal(signal);
    }
  return with_output_flushed(status);
}
