#include "cases/program/program.h"
#include "cases/program/stop_signal.h"

#include <unistd.h>

#include <csignal>
#include <iostream>

int main(int argc, char** argv) {
  const int status = pfdm::run_program({argv + 1, argv + argc}, std::cout, std::cerr, isatty(STDOUT_FILENO) == 1);
  for (const int signal : {SIGINT, SIGTERM})
    if (status == pfdm::exit_status_of_signal(signal)) {
      std::cout.flush();
      pfdm::end_by_signal(signal);
    }
  return status;
}
