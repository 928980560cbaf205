#include "solver/fracture/cells/crack_closures.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double broken = 0.5;  // stiffness factor of cells whose closure matters to their neighbours
constexpr Index restless = 3;   // reversals from which on a cell is between open and closed
constexpr float growth = 1.2F;  // of the stride of a closure that goes on in one direction

}  // namespace

void CrackClosures::start_step(Index n_cells) {
  const std::size_t n = as_size(n_cells);
  lags_ = CellField<float>(n, 0.0F);
  strides_ = CellField<float>(n, 1.0F);
  turns_ = CellField<Index>(n, 0);
  moves_ = CellField<char>(n, 0);
}

double CrackClosures::next(Index cell, double g, double closure, double wanted) {
  const double lag = wanted - closure;
  moves_[cell] = 0;
  if (lag == 0.0) return closure;
  float& stride = strides_[cell];
  if (lag * lags_[cell] < 0.0) {
    ++turns_[cell];
    stride *= 0.5F;
  } else if (lags_[cell] != 0.0F) {
    stride = std::min(growth * stride, 1.0F);
  }
  lags_[cell] = static_cast<float>(lag);
  moves_[cell] = g < broken && std::abs(lag) > 0.5 && turns_[cell] < restless ? 1 : 0;
  const double kept = g + closure * (1.0 - g), end = g + wanted * (1.0 - g), far = std::pow(g, stride);
  const double then = lag > 0.0 ? std::min(kept / far, end) : std::max(kept * far, end);
  const bool is_there = std::abs(then / end - 1.0) < 1e-3 || g == 1.0;
  return is_there ? wanted : (then - g) / (1.0 - g);
}

std::vector<Index> CrackClosures::moving() const {
  std::vector<Index> cells;
  for (Index c = 0; c < moves_.size(); ++c)
    if (moves_[c] != 0) cells.push_back(c);
  return cells;
}

}  // namespace pfdm
