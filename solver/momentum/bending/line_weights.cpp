#include "solver/momentum/bending/line_weights.h"

#include "solver/momentum/bending/cubic_fit.h"

#include <cstddef>

namespace pfdm {

// The components that two ends hold have the change that both make together, those that one of them holds its own.
LineWeights line_weights(std::span<const LinePlace> places) {
  const auto mean = [&](const std::vector<std::size_t>& held) {
    std::array<double, 4> at{};
    for (std::size_t k = 0; k < places.size(); ++k) at[k] = places[k].at;
    for (const std::size_t k : held) at[k] = places[k].at_held;
    return cubic::mean_weights(at, places.size());
  };
  const auto less = [](std::array<double, 4> a, const std::array<double, 4>& b) {
    for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
    return a;
  };
  LineWeights weights{.of_all = mean({}), .of_held = {}};
  std::vector<std::size_t> ends;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (!places[k].held.isZero()) ends.push_back(k);
  for (const std::size_t k : ends)
    weights.of_held.push_back({.part = places[k].held, .change = less(mean({k}), weights.of_all)});
  if (ends.size() == 2) {
    const LineWeights::Change first = weights.of_held[0];
    weights.of_held.push_back({.part = first.part * weights.of_held[1].part,
                               .change = less(less(mean(ends), mean({ends[1]})), first.change)});
  }
  return weights;
}

}  // namespace pfdm
