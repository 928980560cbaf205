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
  double alignment = 0.0;  ///< part of the text that lies before its point: 0.5 centres it, 1 ends it there
};

class Paper {
 public:
  virtual ~Paper() = default;
  /// A line through the points, with round ends and corners; through one point: a dot as wide as the pen.
  virtual void stroke(std::span<const PaperPoint> line, const Pen& pen) = 0;
  /// A polygon. Polygons side by side leave no gap.
  virtual void fill(std::span<const PaperPoint> polygon, const Colour& colour) = 0;
  /// UTF-8, one line; `point` is on the base line. Bytes that are no UTF-8 are taken as Latin-1.
  virtual void text(const std::string& text, const PaperPoint& point, const TextStyle& style) = 0;
  /// Only what lies within is drawn from now on; none: everything.
  virtual void clip(const std::optional<Rectangle>& window) = 0;
  /// What the file holds; nothing can be drawn any more. Throws ComputationError.
  virtual std::string content() = 0;
};

/// Vector graphics with searchable text. All throw ComputationError if the font, Liberation Sans, is not installed.
std::unique_ptr<Paper> pdf_paper(double width, double height, const std::string& title);
std::unique_ptr<Paper> png_paper(double width, double height, double dots_per_inch);
/// On both papers [pt].
double text_width(const std::string& text, double size, bool bold = false);
/// The largest size, up to the given, at which the text is not wider [pt].
double fitting_size(const std::string& text, double size, double width, bool bold = false);

}  // namespace pfdm
