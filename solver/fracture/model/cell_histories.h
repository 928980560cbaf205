#pragma once
// Memory of the materials of the cells. Each cell with a history has the displacement gradient that it has reached,
// then the numbers of its law (physics/materials/material.h) and of its gaps (relaxing_gaps.h).

#include "mesh/fields.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfdm {

struct CellHistories {
  static constexpr std::size_t n_gradient = 9;
  std::vector<std::uint64_t> first;  ///< of each cell among the values, and the end; empty without any history
  std::vector<double> values;

  CellHistories() = default;
  /// A virgin gradient and as many zeros as each cell's law and gaps ask for; cells without a history have size 0.
  explicit CellHistories(const std::vector<std::size_t>& sizes) : first{0} {
    first.reserve(sizes.size() + 1);
    for (const std::size_t n : sizes) first.push_back(first.back() + (n > 0 ? n_gradient + n : 0));
    values.assign(first.back(), 0.0);
  }

  /// Virgin gradients of as many cells, whose laws remember nothing else.
  static CellHistories gradients_only(std::size_t n_cells) {
    CellHistories histories;
    for (std::size_t c = 0; c <= n_cells; ++c) histories.first.push_back(c * n_gradient);
    histories.values.assign(n_cells * n_gradient, 0.0);
    return histories;
  }

  Eigen::Map<Tensor> gradient(Index cell) { return Eigen::Map<Tensor>(values.data() + first[cell]); }
  Eigen::Map<const Tensor> gradient(Index cell) const { return Eigen::Map<const Tensor>(values.data() + first[cell]); }
  /// The numbers of the cell's law, then those of its gaps.
  std::span<double> of(Index cell) { return std::span(values).subspan(begin(cell), size(cell)); }
  std::span<const double> of(Index cell) const { return std::span(values).subspan(begin(cell), size(cell)); }
  friend bool operator==(const CellHistories&, const CellHistories&) = default;

 private:
  bool has(Index cell) const { return first[cell + 1] > first[cell]; }
  std::size_t begin(Index cell) const { return first[cell] + (has(cell) ? n_gradient : 0); }
  std::size_t size(Index cell) const { return first[cell + 1] - begin(cell); }
};

}  // namespace pfdm
