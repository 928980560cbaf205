#pragma once
// A paper that remembers what was drawn on it.

#include "postproc/page/paper.h"
#include "postproc/page/report_page.h"

#include <Eigen/Geometry>

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pfdm::test {

struct RecordingPaper : Paper {
  struct Stroke {
    std::vector<PaperPoint> line;
    Pen pen;
  };
  struct Text {
    std::string text;
    Eigen::AlignedBox2d box;  // from the lowest to the highest letters of the font
  };
  struct Fill {
    std::vector<PaperPoint> polygon;
    Colour colour;
  };

  void stroke(std::span<const PaperPoint> line, const Pen& pen) override {
    strokes.push_back({{line.begin(), line.end()}, pen});
  }
  void fill(std::span<const PaperPoint> polygon, const Colour& colour) override {
    fills.push_back({{polygon.begin(), polygon.end()}, colour});
  }
  void text(const std::string& text, const PaperPoint& point, const TextStyle& style) override {
    if (text.empty()) return;
    const double width = text_width(text, style.size, style.bold), left = -style.alignment * width;
    Text entry{text, {}};
    for (const double x : {left, left + width})
      for (const double y : {-0.21 * style.size, 0.73 * style.size})
        entry.box.extend(point + Eigen::Rotation2Dd(style.angle) * PaperPoint(x, y));
    texts.push_back(entry);
  }
  void clip(const std::optional<Rectangle>&) override {}
  std::string content() override { return {}; }

  std::vector<Stroke> strokes;
  std::vector<Fill> fills;
  std::vector<Text> texts;
};

/// A chart of one line.
inline Chart line_chart(std::vector<double> x, std::vector<double> y) {
  return {.caption = {},
          .x = {.title = "displacement [µm]"},
          .y = {.title = "force [N]"},
          .series = {{.label = {}, .x = std::move(x), .y = std::move(y), .colour = 2}}};
}

}  // namespace pfdm::test
