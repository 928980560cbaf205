// The strength of the shipped AT2 bar over its toughness, by a program of one's own that reads the case: it must be
// sqrt(27 E Gc / (256 ell)).
//
//   toughnesses .../cases/bar_at2

#include "cases/program/fracture/opened_case.h"
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

int main(int, char** words) {
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
