#pragma once
// Numbers as the page holds them: 16 bits between the least and the most, as base64 of a zlib stream.

#include "physics/tensor.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// v = from + (to - from) q / 65535 with an error of at most half a step; what is not finite counts as `from`.
struct Quantised {
  double from = 0.0, to = 0.0;
  std::vector<std::vector<std::uint16_t>> blocks;
};
Quantised quantised(const std::vector<std::vector<double>>& blocks);

/// Low bytes of the first block, its high bytes, then likewise the differences of each block to the one before.
std::string packed(const Quantised& numbers);
/// Differences of each number to the one before, as four planes of bytes, the lowest first.
std::string packed(std::span<const Index> numbers);
std::string packed(std::span<const std::uint8_t> octets);

/// As in RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace pfdm
