#pragma once
// What a PNG shows, read by VTK.

#include <string>
#include <vector>

namespace pfdm::test {

struct Pixels {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  // row by row from the top

  const unsigned char* at(int x, int y) const { return rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * width + x); }
};

Pixels read_png(const std::string& content);

}  // namespace pfdm::test
