#pragma once
// Vectors and second-order tensors of three-dimensional space, and the index type of the meshes' tables.

#include <Eigen/Dense>

#include <cstdint>

namespace pfdm {

using Index = std::int32_t;
using Vector = Eigen::Vector3d;
using Tensor = Eigen::Matrix3d;

/// Number of values of a container, as an index.
template <class Container>
constexpr Index count_of(const Container& values) {
  return static_cast<Index>(values.size());
}

inline Tensor symmetric_part(const Tensor& a) { return 0.5 * (a + a.transpose()); }

inline Tensor deviator(const Tensor& a) { return a - (a.trace() / 3.0) * Tensor::Identity(); }

/// Double contraction a:b.
inline double contract(const Tensor& a, const Tensor& b) { return a.cwiseProduct(b).sum(); }

}  // namespace pfdm
