#include "cases/program/program.h"

#include <unistd.h>

#include <iostream>

int main(int argc, char** argv) {
  return pfdm::run_program({argv + 1, argv + argc}, std::cout, std::cerr, isatty(STDOUT_FILENO) == 1);
}
