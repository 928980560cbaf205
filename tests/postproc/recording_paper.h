#pragma once
// A paper that remembers what was drawn on it.

#include "postproc/page/lettering.h"
#include "postproc/page/paper.h"

#include <Eigen/Geometry>

namespace pfdm::test {

struct RecordingPaper : Paper {
  struct Stroke {
    std::vector<PaperPoint> line;
    Pen pen;
  };
  struct Text {
    std::string text;
    Eigen::AlignedBox2d box;  // about its letters
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
  void text(const std::string& text, const PaperPoint& start, const TextStyle& style) override {
    Text entry{text, {}};
    for (const auto& polygon : text_outline(text, style.size, style.bold))
      for (const PaperPoint& p : polygon) entry.box.extend(turned(p, start, style.angle));
    if (!entry.box.isEmpty()) texts.push_back(entry);
  }
  void clip(const std::optional<Rectangle>&) override {}
  std::string content() override { return {}; }

  std::vector<Stroke> strokes;
  std::vector<Fill> fills;
  std::vector<Text> texts;
};

}  // namespace pfdm::test
