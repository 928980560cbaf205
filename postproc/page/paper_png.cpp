// png_paper() of paper.h. The only place that encodes PNG (VTK).

#include "postproc/page/lettering.h"
#include "postproc/page/paper.h"
#include "postproc/page/raster.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

constexpr double points_per_inch = 72.0;

/// The part of a line between two of its lengths.
struct Piece {
  PixelPoint from, to;
};

class PngPaper : public Paper {
 public:
  PngPaper(double width, double height, double dots_per_inch)
      : scale_(dots_per_inch / points_per_inch),
        raster_(static_cast<int>(std::lround(width * scale_)), static_cast<int>(std::lround(height * scale_))) {}

  void stroke(std::span<const PaperPoint> line, const Pen& pen) override {
    const double half_width = std::max(0.5 * scale_ * pen.width, 0.35);
    const std::vector<PixelPoint> points = pixels(line);
    if (pen.dashes.empty()) {
      for (std::size_t i = 1; i < points.size(); ++i) add_segment({points[i - 1], points[i]}, half_width);
      for (const PixelPoint& p : points) add_dot(p, half_width);
    } else {
      for (const Piece& dash : dashes_of(points, pen.dashes)) add_segment(dash, half_width);
    }
    raster_.paint(pen.colour);
  }

  void fill(std::span<const PaperPoint> polygon, const Colour& colour) override {
    std::vector<PixelPoint> points = pixels(polygon);
    if (points.size() < 3) return;
    raster_.add(points);
    raster_.paint(colour);
    points.push_back(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) add_segment({points[i - 1], points[i]}, seam_half_width);
    raster_.paint(colour);  // pixels that two polygons share would show what is below them
  }

  void text(const std::string& text, const PaperPoint& start, const TextStyle& style) override {
    for (const auto& polygon : text_outline(text, style.size, style.bold)) {
      std::vector<PixelPoint> points;
      for (const PaperPoint& p : polygon) points.push_back(pixel(turned(p, start, style.angle)));
      raster_.add(points);
    }
    raster_.paint(style.colour);
  }

  void clip(const std::optional<Rectangle>& window) override {
    if (!window) return raster_.set_window(0, 0, raster_.width(), raster_.height());
    const auto round = [](double x) { return static_cast<int>(std::lround(x)); };
    const PixelPoint top_left = pixel({window->left, window->top()});
    const PixelPoint bottom_right = pixel({window->right(), window->bottom});
    raster_.set_window(round(top_left.x()), round(top_left.y()), round(bottom_right.x()), round(bottom_right.y()));
  }

  std::string content() override {
    vtkNew<vtkImageData> image;
    image->SetDimensions(raster_.width(), raster_.height(), 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    const std::ptrdiff_t row_length = 3 * static_cast<std::ptrdiff_t>(raster_.width());
    for (int row = 0; row < raster_.height(); ++row)  // VTK's first row is the lowest
      std::copy_n(raster_.pixels().data() + row * row_length, row_length,
                  static_cast<std::uint8_t*>(image->GetScalarPointer(0, raster_.height() - 1 - row, 0)));
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->WriteToMemoryOn();
    writer->Write();
    const auto* bytes = writer->GetResult();
    return {reinterpret_cast<const char*>(const_cast<vtkUnsignedCharArray*>(bytes)->GetPointer(0)),
            static_cast<std::size_t>(bytes->GetNumberOfValues())};
  }

 private:
  static constexpr double seam_half_width = 0.3;  // [pixel]

  PixelPoint pixel(const PaperPoint& p) const { return {scale_ * p.x(), raster_.height() - scale_ * p.y()}; }

  std::vector<PixelPoint> pixels(std::span<const PaperPoint> points) const {
    std::vector<PixelPoint> result;
    for (const PaperPoint& p : points) result.push_back(pixel(p));
    return result;
  }

  void add_segment(const Piece& piece, double half_width) {
    const PixelPoint along = piece.to - piece.from;
    if (!(along.norm() > 0.0)) return;
    const PixelPoint side = half_width / along.norm() * PixelPoint(-along.y(), along.x());
    const PixelPoint corners[] = {piece.from + side, piece.to + side, piece.to - side, piece.from - side};
    raster_.add_convex(corners);
  }

  void add_dot(const PixelPoint& centre, double radius) {
    constexpr int n = 12;
    std::vector<PixelPoint> polygon;
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      polygon.push_back(centre + radius * PixelPoint(std::cos(angle), std::sin(angle)));
    }
    raster_.add_convex(polygon);
  }

  std::vector<Piece> dashes_of(const std::vector<PixelPoint>& line, const std::vector<double>& lengths) const {
    std::vector<Piece> pieces;
    std::size_t phase = 0;
    double left = scale_ * lengths.front();
    for (std::size_t i = 1; i < line.size(); ++i) {
      const PixelPoint along = line[i] - line[i - 1];
      const double length = along.norm();
      for (double done = 0.0; done < length;) {
        const double next = std::min(length, done + left);
        if (phase % 2 == 0)
          pieces.push_back({line[i - 1] + done / length * along, line[i - 1] + next / length * along});
        left -= next - done;
        done = next;
        if (left <= 1e-9) left = scale_ * lengths[++phase % lengths.size()];
      }
    }
    return pieces;
  }

  double scale_;  // pixels per point
  Raster raster_;
};

}  // namespace

std::unique_ptr<Paper> png_paper(double width, double height, double dots_per_inch) {
  return std::make_unique<PngPaper>(width, height, dots_per_inch);
}

}  // namespace pfdm
