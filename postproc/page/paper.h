#pragma once
// A page that is drawn on, and the two files that it can become. Lengths are points (1/72 inch), from the lower left
// corner; both files show the same. Nothing here needs a display.

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

using PaperPoint = Eigen::Vector2d;  ///< [pt]

struct Colour {
  double red = 0.0, green = 0.0, blue = 0.0;  ///< 0 to 1
};

struct Pen {
  Colour colour;
  double width = 0.6;               ///< [pt]
  std::vector<double> dashes = {};  ///< lengths of dash, gap ... [pt]; empty: unbroken
};

struct Rectangle {
  double left = 0.0, bottom = 0.0, width = 0.0, height = 0.0;  ///< [pt]
  double right() const { return left + width; }
  double top() const { return bottom + height; }
};

struct TextStyle {
  double size = 8.0;  ///< of the font [pt]
  bool bold = false;
  double angle = 0.0;  ///< counter-clockwise [rad]
  Colour colour{};
};

class Paper {
 public:
  virtual ~Paper() = default;
  /// A line through the points, with round ends and corners.
  virtual void stroke(std::span<const PaperPoint> line, const Pen& pen) = 0;
  /// A polygon without holes. Polygons side by side leave no gap.
  virtual void fill(std::span<const PaperPoint> polygon, const Colour& colour) = 0;
  /// UTF-8; `start` is the left end of the base line.
  virtual void text(const std::string& text, const PaperPoint& start, const TextStyle& style) = 0;
  /// Only what lies within is drawn from now on; none: everything.
  virtual void clip(const std::optional<Rectangle>& window) = 0;
  /// What the file holds.
  virtual std::string content() = 0;
};

/// Vector graphics with searchable text; characters beyond Latin-1 as outlines.
std::unique_ptr<Paper> pdf_paper(double width, double height, const std::string& title);
std::unique_ptr<Paper> png_paper(double width, double height, double dots_per_inch);

}  // namespace pfdm
