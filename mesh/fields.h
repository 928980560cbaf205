#pragma once
// Fields typed by where their values live, so that a cell's value is never read with a face's index.

#include "physics/tensor.h"

#include <concepts>
#include <cstddef>
#include <vector>

namespace pfdm {

/// An index as a size, where both meet in one expression. Subscripts and lengths alone need no such word.
constexpr std::size_t as_size(std::integral auto i) { return static_cast<std::size_t>(i); }

/// Zero, also for Eigen's types, which leave T{} uninitialised.
template <class T>
T zero_of() {
  if constexpr (requires { T::Zero(); })
    return T::Zero();
  else
    return T{};
}

template <class T, class Place>
class Field {
 public:
  Field() = default;
  explicit Field(std::integral auto n, const T& value = zero_of<T>()) : values_(as_size(n), value) {}
  explicit Field(std::vector<T> values) : values_(std::move(values)) {}

  T& operator[](std::integral auto i) { return values_[i]; }
  const T& operator[](std::integral auto i) const { return values_[i]; }
  Index size() const { return count_of(values_); }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }
  std::vector<T>& values() { return values_; }
  const std::vector<T>& values() const { return values_; }
  friend bool operator==(const Field&, const Field&) = default;

 private:
  std::vector<T> values_;
};

struct AtCells;
struct AtFaces;
template <class T>
using CellField = Field<T, AtCells>;
template <class T>
using FaceField = Field<T, AtFaces>;

}  // namespace pfdm
