#include "solver/fracture/model/toughness_perturbation.h"

namespace pfdm {
namespace {

// A uniform number in [0, 1) for each counter: SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
double uniform_number(std::uint64_t seed, std::uint64_t counter) {
  std::uint64_t z = seed * 0xD1B54A32D192ED03ULL + (counter + 1) * 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1.0p-53;
}

}  // namespace

void perturb_toughness(const Mesh& mesh, double part, std::uint64_t seed, FractureModel& model) {
  CellField<RegionModel> cells(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    cells[c] = model.in_cell(mesh, c);
    if (cells[c].damageable) cells[c].Gc *= 1.0 + part * (2.0 * uniform_number(seed, as_size(c)) - 1.0);
  }
  model.cells = std::move(cells);
}

}  // namespace pfdm
