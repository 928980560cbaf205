#include "cases/program/program.h"
#include "cases/program/session/stop_signal.h"
#include "postproc/curves/instruction_set.h"
#include "postproc/files/flush.h"

#include <unistd.h>

#include <csignal>
#include <exception>
#include <iostream>

namespace {

bool can_run_here() {
#if defined(__AVX512VL__)
  return __builtin_cpu_supports("avx512vl");
#elif defined(__AVX2__)
  return __builtin_cpu_supports("avx2");
#else
  return true;
#endif
}

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

}  // namespace

int main(int argc, char** argv) {
  if (!can_run_here()) {
    std::cerr << "pfdm: this program was compiled for " << pfdm::instruction_set()
              << ", which this processor lacks: build it here (./pfdm does), or with -DPFDM_ARCH=x86-64-v2\n";
    return 1;
  }
  const bool terminal = isatty(STDOUT_FILENO) == 1;
  const int status = with_files_flushed(pfdm::run_program({argv + 1, argv + argc}, std::cout, std::cerr, terminal));
  for (const int signal : {SIGINT, SIGTERM})
    if (status == pfdm::exit_status_of_signal(signal)) {
      std::cout.flush();
      pfdm::end_by_signal(signal);
    }
  return status;
}
