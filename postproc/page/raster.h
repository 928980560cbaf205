#pragma once
// A picture of pixels on which polygons are filled, each pixel by the part of it that they cover.

#include "postproc/page/paper.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfdm {

/// A picture's corner; x to the right, y down [pixel].
using PixelPoint = Eigen::Vector2d;

class Raster {
 public:
  /// White.
  Raster(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Red, green, blue; row by row from the top.
  const std::vector<std::uint8_t>& pixels() const { return pixels_; }

  /// Nothing changes outside of [left, right) x [top, bottom).
  void set_window(int left, int top, int right, int bottom);
  /// Adds a polygon to the shape that is painted next; parts that go round the other way are taken off it.
  void add(std::span<const PixelPoint> polygon);
  /// Adds a convex polygon, whichever way it goes round: shapes of several, as thick lines are, have no holes.
  void add_convex(std::span<const PixelPoint> polygon);
  /// Paints what was added, and forgets it.
  void paint(const Colour& colour);

 private:
  void add_edge(PixelPoint a, PixelPoint b);
  void add_row(int row, double x0, double x1, double height);

  int width_, height_;
  int left_ = 0, top_ = 0, right_, bottom_;
  int first_row_, last_row_ = -1;        // of the shape
  int first_column_, last_column_ = -1;  // likewise
  std::vector<std::uint8_t> pixels_;
  std::vector<double> cover_;  // what each pixel adds to the cover of those from it on, a row has one more
};

}  // namespace pfdm
