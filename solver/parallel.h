#pragma once
// Loops over std::thread. Work is cut into chunks of a fixed size and sums are added chunk by chunk in order, so
// results do not depend on the number of threads.

#include "physics/tensor.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace pfdm {

/// Number of threads of all later loops, at least 1. One loop at a time has them: one that is begun beside it, or
/// within one of its tasks, runs in the thread that began it, with the same result.
void set_threads(int n);
int n_threads();

constexpr Index chunk_size = 2048;

namespace detail {
/// Calls task(0) ... task(n_tasks - 1), each once, on all threads; returns when all are done.
/// An exception of a task is rethrown here.
void run_tasks(Index n_tasks, const std::function<void(Index)>& task);
}  // namespace detail

/// body(begin, end) over chunks of `grain` items of [0, n).
template <class Body>
void parallel_chunks(Index n, const Body& body, Index grain = chunk_size) {
  // One task object for one thread and for many: compiled twice, the body could be rounded in two ways.
  detail::run_tasks((n + grain - 1) / grain, [&](Index c) { body(c * grain, std::min(n, (c + 1) * grain)); });
}

/// body(i) for every i of [0, n).
template <class Body>
void parallel_for(Index n, const Body& body) {
  parallel_chunks(n, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) body(i);
  });
}

/// Sum of term(i) over [0, n), of any type with +=.
template <class T = double, class Term>
T parallel_sum(Index n, const Term& term, T zero = T{}, Index grain = chunk_size) {
  std::vector<T> partial((n + grain - 1) / grain, zero);
  parallel_chunks(
      n,
      [&](Index begin, Index end) {
        T sum = zero;
        for (Index i = begin; i < end; ++i) sum += term(i);
        partial[begin / grain] = sum;
      },
      grain);
  T total = zero;
  for (const T& p : partial) total += p;
  return total;
}

/// Largest term(i), at least `least`.
template <class Term>
double parallel_max(Index n, const Term& term, double least = 0.0) {
  std::vector<double> partial((n + chunk_size - 1) / chunk_size, least);
  parallel_chunks(n, [&](Index begin, Index end) {
    double largest = least;
    for (Index i = begin; i < end; ++i) largest = std::max(largest, static_cast<double>(term(i)));
    partial[begin / chunk_size] = largest;
  });
  return partial.empty() ? least : *std::max_element(partial.begin(), partial.end());
}

}  // namespace pfdm
