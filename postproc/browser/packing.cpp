#include "postproc/browser/packing.h"

#include "physics/error.h"

#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double steps = 65535.0;

std::string zipped(const std::string& bytes) {
  vtkNew<vtkZLibDataCompressor> compressor;
  compressor->SetCompressionLevel(9);
  std::string zipped(compressor->GetMaximumCompressionSpace(bytes.size()), '\0');
  const std::size_t n = compressor->Compress(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                                             reinterpret_cast<unsigned char*>(zipped.data()), zipped.size());
  if (n == 0 && !bytes.empty()) throw ComputationError("zlib could not compress the numbers of a page");
  zipped.resize(n);
  return zipped;
}

char byte_of(std::uint32_t value, unsigned place) { return static_cast<char>((value >> (8U * place)) & 0xffU); }

}  // namespace

Quantised quantised(const std::vector<std::vector<double>>& blocks) {
  Quantised q;
  bool is_first = true;
  for (const auto& block : blocks)
    for (const double value : block) {
      if (!std::isfinite(value)) continue;
      q.from = is_first ? value : std::min(q.from, value);
      q.to = is_first ? value : std::max(q.to, value);
      is_first = false;
    }
  const double scale = q.to > q.from ? steps / (q.to - q.from) : 0.0;
  for (const auto& block : blocks) {
    q.blocks.emplace_back();
    for (const double value : block)
      q.blocks.back().push_back(std::isfinite(value) ? static_cast<std::uint16_t>(std::lround(scale * (value - q.from)))
                                                     : std::uint16_t{0});
  }
  return q;
}

std::string packed(const Quantised& numbers) {
  std::string bytes;
  for (std::size_t b = 0; b < numbers.blocks.size(); ++b) {
    const auto& block = numbers.blocks[b];
    const auto difference = [&](std::size_t i) {
      return static_cast<std::uint16_t>(block[i] - (b == 0 ? 0 : numbers.blocks[b - 1][i]));
    };
    for (const unsigned place : {0U, 1U})
      for (std::size_t i = 0; i < block.size(); ++i) bytes.push_back(byte_of(difference(i), place));
  }
  return base64(zipped(bytes));
}

std::string packed(std::span<const Index> numbers) {
  std::string bytes;
  for (const unsigned place : {0U, 1U, 2U, 3U})
    for (std::size_t i = 0; i < numbers.size(); ++i)
      bytes.push_back(byte_of(
          static_cast<std::uint32_t>(numbers[i]) - (i == 0 ? 0U : static_cast<std::uint32_t>(numbers[i - 1])), place));
  return base64(zipped(bytes));
}

std::string packed(std::span<const std::uint8_t> octets) {
  return base64(zipped(std::string(octets.begin(), octets.end())));
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = (three << 8U) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text.push_back(i + k > bytes.size() ? '=' : letters[(three >> (18U - 6U * static_cast<unsigned>(k))) & 63U]);
  }
  return text;
}

}  // namespace pfdm
