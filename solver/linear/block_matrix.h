#pragma once
// Sparse matrices of 3x3 blocks in single precision, columns padded to four floats so that a block times a vector is
// three vector instructions.

#include "physics/tensor.h"

#include <vector>

namespace pfdm {

using Lane = Eigen::Array4f;  ///< three components and a zero

struct Block {  // NOLINT(bugprone-reserved-identifier): clang-tidy 14 takes a name of an intrinsic for its
  Lane column[3];
  Block() { column[0] = column[1] = column[2] = Lane::Zero(); }
  Block& operator+=(const Block& b) {
    for (int k = 0; k < 3; ++k) column[k] += b.column[k];
    return *this;
  }
  Block& operator-=(const Block& b) {
    for (int k = 0; k < 3; ++k) column[k] -= b.column[k];
    return *this;
  }
  Lane operator*(const Lane& x) const { return column[0] * x[0] + column[1] * x[1] + column[2] * x[2]; }
};

inline Block to_block(const Tensor& a) {
  Block b;
  for (int k = 0; k < 3; ++k) b.column[k].head<3>() = a.col(k).cast<float>();
  return b;
}

inline Tensor to_tensor(const Block& b) {
  Tensor a;
  for (int k = 0; k < 3; ++k) a.col(k) = b.column[k].head<3>().cast<double>();
  return a;
}

/// A symmetric matrix by its parts: diagonal blocks, and off-diagonal blocks a_ij (a_ji is the transpose) in any order.
struct BlockTriplets {
  struct Entry {
    Index row, column;
    Tensor value;
  };
  std::vector<Tensor> diagonal;
  std::vector<Entry> off_diagonal;
};

/// Compressed rows; the diagonal apart, with its inverse. What a row adds up to stands apart as well: the stiffness
/// that holds a part of a body which moves as a whole, and which is lost in the diagonal's rounding if the part is
/// stiff.
struct BlockMatrix {
  std::vector<Index> offsets;
  std::vector<Index> columns;
  std::vector<Block> blocks;
  std::vector<Block> diagonal;
  std::vector<Block> inverse_diagonal;
  std::vector<Block> row_sum;  ///< diagonal and blocks together

  Index n_rows() const { return count_of(diagonal); }
};

}  // namespace pfdm
