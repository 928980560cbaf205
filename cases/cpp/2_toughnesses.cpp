// 2. A sweep over a case that is read from its folder: how the strength of a bar grows with its toughness.
//
// Problem: the shipped case bar_at2, a bar of concrete (E = 30 GPa) whose cross section breaks within 5 mm; its
// toughness is set to 60, 80 and 100 J/m^2.
//
//          ____________________________
//   held  |             ::             | -> u_x            the middle is 1 % weaker
//         +----------------------------+---> x
//
// Result: the strength sqrt(27 E Gc / (256 ell)) of an AT2 bar (Pham et al., JMPS 59 (2011) 1163); the program ends
// with 1 unless each is met within 1 %, and unless a key that does not exist is refused.
//
//   cmake -S cases/cpp -B build/cpp -DCMAKE_PREFIX_PATH=DIR && cmake --build build/cpp
//   build/cpp/2_toughnesses cases/bar_at2

#include "cases/program/fracture/case/opened_case.h"
#include "physics/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

/// Greatest force on the bar's end [N], toughness in J/m^2.
double strength(const char* folder, double toughness) {
  pfdm::OpenedCase bar(folder, {"materials.concrete.toughness=" + std::to_string(toughness) + " J/m^2",
                                "regions.weak.toughness=" + std::to_string(0.99 * toughness) + " J/m^2"});
  double greatest = 0.0;
  pfdm::FractureState state = bar.run().initial_state();
  while (!bar.run().is_complete(state)) {
    const double force = bar.reaction(bar.run().step(state), "xmax").x();
    if (force < greatest) break;
    greatest = force;
  }
  return greatest;
}

}  // namespace

int main(int n, char** words) {
  if (n != 2) {
    std::fprintf(stderr, "usage: 2_toughnesses .../cases/bar_at2\n");
    return 2;
  }
  const double E = 30e9, ell = 5e-3, area = 1e-6;
  int status = 0;
  for (const double toughness : {60.0, 80.0, 100.0}) {
    const double found = strength(words[1], toughness),
                 expected = area * std::sqrt(27.0 * E * toughness / (256.0 * ell));
    std::printf("%g J/m^2: %.4f N, expected %.4f N\n", toughness, found, expected);
    if (std::abs(found - expected) > 0.01 * expected) status = 1;
  }
  try {
    pfdm::OpenedCase(words[1], {"fracture.lenght=3 mm"});
    status = 1;
  } catch (const pfdm::InputError& error) {
    std::printf("refused as it should be: %s\n", error.what());
  }
  return status;
}
