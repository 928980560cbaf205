#include "cases/program/program.h"
#include "cases/program/session/stop_signal.h"
#include "postproc/curves/instruction_set.h"

#include <unistd.h>

#include <csignal>
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

}  // namespace

int main(int argc, char** argv) {
  if (!can_run_here()) {
    std::cerr << "pfdm: this program was compiled for " << pfdm::instruction_set()
              << ", which this processor lacks: build it here (./pfdm does), or with -DPFDM_ARCH=x86-64-v2\n";
    return 1;
  }
  const int status = pfdm::run_program({argv + 1, argv + argc}, std::cout, std::cerr, isatty(STDOUT_FILENO) == 1);
  for (const int signal : {SIGINT, SIGTERM})
    if (status == pfdm::exit_status_of_signal(signal)) {
      std::cout.flush();
      pfdm::end_by_signal(signal);
    }
  return status;
}
