#include "postproc/page/raster.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

/// Twice the area; positive or negative by the sense.
double twice_area(std::span<const PixelPoint> polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PixelPoint& a = polygon[i];
    const PixelPoint& b = polygon[(i + 1) % polygon.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

std::uint8_t blended(std::uint8_t below, double colour, double cover) {
  return static_cast<std::uint8_t>(std::lround(below + (255.0 * std::clamp(colour, 0.0, 1.0) - below) * cover));
}

}  // namespace

Raster::Raster(int width, int height)
    : width_(width),
      height_(height),
      right_(width),
      bottom_(height),
      first_row_(height),
      first_column_(width),
      pixels_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255),
      cover_(static_cast<std::size_t>(width + 2) * static_cast<std::size_t>(height), 0.0) {}

void Raster::set_window(int left, int top, int right, int bottom) {
  left_ = std::clamp(left, 0, width_);
  top_ = std::clamp(top, 0, height_);
  right_ = std::clamp(right, left_, width_);
  bottom_ = std::clamp(bottom, top_, height_);
}

void Raster::add(std::span<const PixelPoint> polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) add_edge(polygon[i], polygon[(i + 1) % polygon.size()]);
}

void Raster::add_convex(std::span<const PixelPoint> polygon) {
  if (twice_area(polygon) >= 0.0) return add(polygon);
  const std::vector<PixelPoint> turned(polygon.rbegin(), polygon.rend());
  add(turned);
}

void Raster::add_edge(PixelPoint a, PixelPoint b) {
  const double sense = a.y() < b.y() ? 1.0 : -1.0;
  if (sense < 0.0) std::swap(a, b);
  const double top = std::max(a.y(), 0.0), bottom = std::min(b.y(), static_cast<double>(height_));
  if (!(top < bottom)) return;
  const double slope = (b.x() - a.x()) / (b.y() - a.y());
  const int last = std::min(static_cast<int>(bottom), height_ - 1);
  for (int row = static_cast<int>(top); row <= last; ++row) {
    const double y0 = std::max(top, static_cast<double>(row)), y1 = std::min(bottom, row + 1.0);
    if (y1 > y0) add_row(row, a.x() + slope * (y0 - a.y()), a.x() + slope * (y1 - a.y()), sense * (y1 - y0));
  }
  first_row_ = std::min(first_row_, static_cast<int>(top));
  last_row_ = std::max(last_row_, last);
}

/// An edge within one row: the pixels to its right are covered by its height, those it crosses by the part to its
/// right. The cover is kept as differences from pixel to pixel.
void Raster::add_row(int row, double x0, double x1, double height) {
  if (x0 > x1) std::swap(x0, x1);
  const double limit = width_;
  x0 = std::clamp(x0, 0.0, limit);
  x1 = std::clamp(x1, 0.0, limit);
  double* cover = cover_.data() + static_cast<std::ptrdiff_t>(row) * (width_ + 2);
  const int first = static_cast<int>(x0), last = static_cast<int>(x1);
  const double length = x1 - x0;
  first_column_ = std::min(first_column_, first);
  last_column_ = std::max(last_column_, last);
  for (int pixel = first; pixel <= last; ++pixel) {
    const double from = std::max(x0, static_cast<double>(pixel)), to = std::min(x1, pixel + 1.0);
    const double part = length > 0.0 ? height * (to - from) / length : height;
    const double to_the_right = part * (pixel + 1.0 - 0.5 * (from + to));
    cover[pixel] += to_the_right;
    cover[pixel + 1] += part - to_the_right;
  }
}

void Raster::paint(const Colour& colour) {
  for (int row = first_row_; row <= last_row_; ++row) {
    double* cover = cover_.data() + static_cast<std::ptrdiff_t>(row) * (width_ + 2);
    double sum = 0.0;
    for (int x = first_column_; x <= std::min(last_column_ + 1, width_ - 1); ++x) {
      sum += cover[x];
      const double part = std::min(std::abs(sum), 1.0);
      if (part < 1e-3 || x < left_ || x >= right_ || row < top_ || row >= bottom_) continue;
      std::uint8_t* pixel = pixels_.data() + 3 * (static_cast<std::ptrdiff_t>(row) * width_ + x);
      pixel[0] = blended(pixel[0], colour.red, part);
      pixel[1] = blended(pixel[1], colour.green, part);
      pixel[2] = blended(pixel[2], colour.blue, part);
    }
    std::fill(cover + std::min(first_column_, width_), cover + std::min(last_column_, width_) + 2, 0.0);
  }
  first_row_ = height_;
  last_row_ = -1;
  first_column_ = width_;
  last_column_ = -1;
}

}  // namespace pfdm
