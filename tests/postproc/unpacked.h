#pragma once
// The numbers of a page as its script reads them, by another code than the one that packs them.

#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm::test {

inline std::string from_base64(std::string_view text) {
  std::string bytes;
  unsigned bits = 0, n = 0;
  for (const char c : text) {
    if (c == '=') break;
    const unsigned v = c >= 'a'   ? static_cast<unsigned>(c - 'a') + 26U
                       : c >= 'A' ? static_cast<unsigned>(c - 'A')
                       : c >= '0' ? static_cast<unsigned>(c - '0') + 52U
                       : c == '+' ? 62U
                                  : 63U;
    bits = (bits << 6U) | v;
    n += 6;
    if (n >= 8) {
      n -= 8;
      bytes.push_back(static_cast<char>((bits >> n) & 255U));
    }
  }
  return bytes;
}

/// `size`: of what comes out [byte].
inline std::string inflated(std::string_view base64, std::size_t size) {
  const std::string packed = from_base64(base64);
  std::string bytes(size, '\0');
  const vtkNew<vtkZLibDataCompressor> compressor;
  const std::size_t n = compressor->Uncompress(reinterpret_cast<const unsigned char*>(packed.data()), packed.size(),
                                               reinterpret_cast<unsigned char*>(bytes.data()), bytes.size());
  bytes.resize(n);
  return bytes;
}

/// `rows` blocks of n numbers between `from` and `to`.
inline std::vector<std::vector<double>> unpacked_blocks(std::string_view base64, std::size_t rows, std::size_t n,
                                                        double from, double to) {
  const std::string bytes = inflated(base64, 2 * rows * n);
  std::vector<std::vector<double>> blocks;
  std::vector<std::uint16_t> q(n, 0);
  for (std::size_t r = 0; r < rows; ++r) {
    blocks.emplace_back();
    for (std::size_t i = 0; i < n; ++i) {
      const auto low = static_cast<unsigned char>(bytes.at(2 * r * n + i));
      const auto high = static_cast<unsigned char>(bytes.at((2 * r + 1) * n + i));
      q[i] = static_cast<std::uint16_t>(q[i] + low + 256 * high);
      blocks.back().push_back(from + (to - from) * q[i] / 65535.0);
    }
  }
  return blocks;
}

}  // namespace pfdm::test
