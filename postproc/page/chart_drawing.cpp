#include "postproc/page/chart_drawing.h"

#include "postproc/page/chart_ticks.h"
#include "postproc/page/lettering.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkContextDevice2D.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlotArea.h>
#include <vtkPlotLine.h>
#include <vtkPlotPoints.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#if __has_include(<vtkUnicodeString.h>)
#include <vtkUnicodeString.h>  // up to VTK 9.1, whose device has to draw such strings too
#define PFDM_VTK_HAS_UNICODE_STRING
#endif
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace pfdm {
namespace {

constexpr double unit_of_scene = 0.1;  // VTK counts in whole ones [pt]
constexpr double label_size = 7.0, title_size = 7.5, tick_length = 2.5, label_offset = 4.5;  // [pt]
constexpr Colour frame_colour{0.25, 0.25, 0.25}, grid_colour{0.88, 0.88, 0.88};

/// What VTK paints, on a Paper. It paints charts of lines, points and areas: what else a device can do, textures and
/// sprites, is not called for.
class PaperDevice : public vtkContextDevice2D {
 public:
  static PaperDevice* New();
  vtkTypeMacro(PaperDevice, vtkContextDevice2D)

      void draw_on(Paper& paper, const Rectangle& place) {
    paper_ = &paper;
    place_ = place;
    Geometry[0] = static_cast<int>(place.width / unit_of_scene);
    Geometry[1] = static_cast<int>(place.height / unit_of_scene);
  }

  void DrawPoly(float* points, int n, unsigned char*, int) override {
    if (this->Pen->GetLineType() != vtkPen::NO_PEN) paper_->stroke(on_paper(points, n), line_pen());
  }
  void DrawLines(float* points, int n, unsigned char* colours, int components) override {
    for (int i = 0; i + 1 < n; i += 2) DrawPoly(points + 2 * i, 2, colours, components);
  }
  void DrawPoints(float* points, int n, unsigned char*, int) override { DrawMarkers(0, false, points, n, nullptr, 0); }
  /// Discs as wide as the pen, as VTK has it.
  void DrawMarkers(int, bool, float* points, int n, unsigned char*, int) override {
    const double radius = 0.5 * unit_of_scene * this->Pen->GetWidth();
    for (const PaperPoint& centre : on_paper(points, n)) paper_->fill(disc(centre, radius), line_pen().colour);
  }
  void DrawQuad(float* points, int n) override { DrawPolygon(points, n); }
  void DrawPolygon(float* points, int n) override {
    if (this->Brush->GetOpacity() > 0) paper_->fill(on_paper(points, n), brush());
  }
  void DrawQuadStrip(float* points, int n) override {
    if (this->Brush->GetOpacity() == 0) return;
    const std::vector<PaperPoint> p = on_paper(points, n);
    for (std::size_t i = 0; i + 3 < p.size(); i += 2)
      paper_->fill(std::array{p[i], p[i + 1], p[i + 3], p[i + 2]}, brush());
  }

  void DrawString(float* point, const vtkStdString& string) override {
    const double size = font_size(), width = text_width(string, size, this->TextProp->GetBold() != 0);
    const PaperPoint shift(-share(this->TextProp->GetJustification()) * width,
                           -share(this->TextProp->GetVerticalJustification()) * cap_height * size);
    const double angle = this->TextProp->GetOrientation() * std::numbers::pi / 180.0;
    const double* rgb = this->TextProp->GetColor();
    paper_->text(string, turned(shift, on_paper(point, 1).front(), angle),
                 {size, this->TextProp->GetBold() != 0, angle, {rgb[0], rgb[1], rgb[2]}});
  }
  void ComputeStringBounds(const vtkStdString& string, float bounds[4]) override {
    const double width = text_width(string, font_size(), this->TextProp->GetBold() != 0);
    bounds[0] = bounds[1] = 0.0F;
    bounds[2] = static_cast<float>(width / unit_of_scene);
    bounds[3] = static_cast<float>(line_height * font_size() / unit_of_scene);
  }
  void ComputeJustifiedStringBounds(const char* string, float bounds[4]) override {
    ComputeStringBounds(vtkStdString(string), bounds);
    bounds[0] = static_cast<float>(-share(this->TextProp->GetJustification())) * bounds[2];
    bounds[1] = static_cast<float>(-share(this->TextProp->GetVerticalJustification())) * bounds[3];
  }

  void SetMatrix(vtkMatrix3x3* matrix) override { transforms_.back() = transform_of(matrix); }
  void GetMatrix(vtkMatrix3x3* matrix) override {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) matrix->SetElement(row, column, transforms_.back()(row, column));
  }
  void MultiplyMatrix(vtkMatrix3x3* matrix) override { transforms_.back() *= transform_of(matrix); }
  void PushMatrix() override { transforms_.push_back(transforms_.back()); }
  void PopMatrix() override { transforms_.pop_back(); }

  void SetClipping(int* x) override {
    clip_ = Rectangle{place_.left + unit_of_scene * x[0], place_.bottom + unit_of_scene * x[1], unit_of_scene * x[2],
                      unit_of_scene * x[3]};
  }
  void EnableClipping(bool enable) override { paper_->clip(enable ? std::optional(clip_) : std::nullopt); }

  void SetColor4(unsigned char*) override {}
  void SetPointSize(float) override {}
  void SetLineWidth(float) override {}
  void SetLineType(int) override {}
  bool MathTextIsSupported() override { return false; }
  void DrawPointSprites(vtkImageData*, float*, int, unsigned char*, int) override {}
  void DrawEllipseWedge(float, float, float, float, float, float, float, float) override {}
  void DrawEllipticArc(float, float, float, float, float, float) override {}
  void DrawMathTextString(float*, const vtkStdString&) override {}
  void DrawImage(float*, float, vtkImageData*) override {}
  void DrawImage(const vtkRectf&, vtkImageData*) override {}
  void SetTexture(vtkImageData*, int) override {}
#ifdef PFDM_VTK_HAS_UNICODE_STRING
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  void DrawString(float*, const vtkUnicodeString&) override {}
  void ComputeStringBounds(const vtkUnicodeString&, float*) override {}
#pragma GCC diagnostic pop
#endif

 private:
  static constexpr double cap_height = 0.72, line_height = 0.95;  // over the font's size

  double font_size() const { return unit_of_scene * this->TextProp->GetFontSize(); }

  /// Of the text that lies left of, or below, its point: VTK's numbers are 0, 1, 2 for none, half and all of it.
  static double share(int justification) { return 0.5 * justification; }

  static Eigen::Matrix3d transform_of(vtkMatrix3x3* matrix) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(matrix->GetData());
  }

  std::vector<PaperPoint> on_paper(const float* points, int n) const {
    std::vector<PaperPoint> result;
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector3d p = transforms_.back() * Eigen::Vector3d(points[2 * i], points[2 * i + 1], 1.0);
      result.emplace_back(place_.left + unit_of_scene * p.x(), place_.bottom + unit_of_scene * p.y());
    }
    return result;
  }

  static std::vector<PaperPoint> disc(const PaperPoint& centre, double radius) {
    constexpr int n = 12;
    std::vector<PaperPoint> corners;
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      corners.emplace_back(centre + radius * PaperPoint(std::cos(angle), std::sin(angle)));
    }
    return corners;
  }

  static Colour colour_of(const unsigned char* rgb) { return {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0}; }
  Colour brush() const { return colour_of(this->Brush->GetColorObject().GetData()); }
  pfdm::Pen line_pen() const {
    pfdm::Pen pen{.colour = colour_of(this->Pen->GetColorObject().GetData()),
                  .width = unit_of_scene * this->Pen->GetWidth()};
    if (this->Pen->GetLineType() == vtkPen::DASH_LINE) pen.dashes = {4.0, 2.0};
    return pen;
  }

  Paper* paper_ = nullptr;
  Rectangle place_, clip_;
  std::vector<Eigen::Matrix3d> transforms_{Eigen::Matrix3d::Identity()};
};
vtkStandardNewMacro(PaperDevice)

    struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void take(double value, bool positive) {
    if (!std::isfinite(value) || (positive && value <= 0.0)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

float in_scene(double points) { return static_cast<float>(points / unit_of_scene); }

void set_colour(vtkPen* pen, const Colour& colour, double width) {
  pen->SetColorF(colour.red, colour.green, colour.blue);
  pen->SetWidth(in_scene(width));
}

/// VTK counts from 0 at an axis's beginning to 1 at its end: it draws nothing where values differ little from one
/// another beside their size.
double part_of_axis(double value, const AxisTicks& ticks) { return (value - ticks.from) / (ticks.to - ticks.from); }

/// Without its title: how far VTK puts that from the numbers depends on its version.
void set_axis(vtkAxis* axis, const AxisTicks& ticks) {
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (std::size_t i = 0; i < ticks.positions.size(); ++i) {
    positions->InsertNextValue(part_of_axis(ticks.positions[i], ticks));
    labels->InsertNextValue(ticks.labels[i]);
  }
  axis->SetTitle("");
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(0.0, 1.0);
  axis->SetCustomTickPositions(positions, labels);
  axis->SetTickLength(in_scene(tick_length));
  axis->SetLabelOffset(in_scene(label_offset));
  axis->GetLabelProperties()->SetFontSize(static_cast<int>(label_size / unit_of_scene));
  axis->GetLabelProperties()->SetColor(0.0, 0.0, 0.0);
  set_colour(axis->GetPen(), frame_colour, 0.6);
  set_colour(axis->GetGridPen(), grid_colour, 0.4);
}

/// Where the axes are.
struct ChartLayout {
  AxisTicks x, y;
  double label_width = 0.0;  // the widest of the numbers beside the y axis [pt]
  Rectangle window;
};

/// Series cut where they are interrupted, in parts of the axes.
std::vector<Series> unbroken(const Series& series, const Chart& chart, const ChartLayout& layout) {
  std::vector<Series> pieces;
  bool open = false;
  const bool band = series.style == SeriesStyle::band;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const auto place = [](double value, const ChartAxis& axis, const AxisTicks& ticks) {
      return part_of_axis(axis.logarithmic ? std::log10(value) : value, ticks);
    };
    const double x = place(series.x[i], chart.x, layout.x), y = place(series.y[i], chart.y, layout.y);
    const double upper = band ? place(series.upper[i], chart.y, layout.y) : 0.0;
    const bool finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(upper);
    if (finite && !open)
      pieces.push_back({.label = {}, .x = {}, .y = {}, .style = series.style, .colour = series.colour});
    open = finite;
    if (!finite) continue;
    pieces.back().x.push_back(x);
    pieces.back().y.push_back(y);
    if (band) pieces.back().upper.push_back(upper);
  }
  // Between two gaps a single point makes no line.
  const bool line = series.style == SeriesStyle::line || series.style == SeriesStyle::dashed;
  if (line) std::erase_if(pieces, [](const Series& piece) { return piece.x.size() < 2; });
  return pieces;
}

vtkNew<vtkTable> table_of(const Series& series) {
  vtkNew<vtkTable> table;
  const auto add = [&](const char* name, const std::vector<double>& values) {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name);
    for (const double value : values) column->InsertNextValue(value);
    table->AddColumn(column);
  };
  add("x", series.x);
  add("y", series.y);
  if (!series.upper.empty()) add("upper", series.upper);
  return table;
}

vtkSmartPointer<vtkPlot> line_plot(const Series& series) {
  const vtkNew<vtkTable> table = table_of(series);
  vtkNew<vtkPlotLine> plot;
  plot->SetInputData(table.Get(), 0, 1);
  set_colour(plot->GetPen(), series_colour(series.colour), 0.9);
  if (series.style == SeriesStyle::dashed) plot->GetPen()->SetLineType(vtkPen::DASH_LINE);
  if (series.style == SeriesStyle::points) plot->GetPen()->SetLineType(vtkPen::NO_PEN);
  const bool marks = series.style == SeriesStyle::points || series.style == SeriesStyle::line_with_points;
  plot->SetMarkerStyle(marks ? vtkPlotPoints::CIRCLE : vtkPlotPoints::NONE);
  plot->SetMarkerSize(in_scene(1.8));
  return plot;
}

vtkSmartPointer<vtkPlot> area_plot(const Series& series) {
  const vtkNew<vtkTable> table = table_of(series);
  vtkNew<vtkPlotArea> plot;
  plot->SetInputData(table.Get());
  plot->SetInputArray(0, "x");
  plot->SetInputArray(1, "y");
  plot->SetInputArray(2, "upper");
  const Colour c = series_colour(series.colour);
  plot->GetBrush()->SetColorF(c.red, c.green, c.blue);
  plot->GetPen()->SetLineType(vtkPen::NO_PEN);
  return plot;
}

ChartLayout layout_of(const Rectangle& place, const Chart& chart) {
  constexpr double room_below = 24.0, room_above = 5.0, room_right = 8.0;
  Range x, y;
  for (const Series& series : chart.series)
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      x.take(series.x[i], chart.x.logarithmic);
      y.take(series.y[i], chart.y.logarithmic);
      if (series.style == SeriesStyle::band) y.take(series.upper[i], chart.y.logarithmic);
    }
  ChartLayout layout{.x = axis_ticks(chart.x, x.least, x.most, std::max(2, static_cast<int>(place.width / 45.0))),
                     .y = axis_ticks(chart.y, y.least, y.most, std::max(2, static_cast<int>(place.height / 25.0))),
                     .window = {}};
  for (const std::string& label : layout.y.labels)
    layout.label_width = std::max(layout.label_width, text_width(label, label_size));
  const double room_left = layout.label_width + label_offset + title_size + 4.0;
  layout.window = {place.left + room_left, place.bottom + room_below, place.width - room_left - room_right,
                   place.height - room_below - room_above};
  return layout;
}

void draw_titles(Paper& paper, const ChartLayout& layout, const Chart& chart) {
  const Rectangle& w = layout.window;
  const double x_length = text_width(chart.x.title, title_size), y_length = text_width(chart.y.title, title_size);
  paper.text(chart.x.title, {w.left + 0.5 * (w.width - x_length), w.bottom - 20.0}, {.size = title_size});
  paper.text(chart.y.title, {w.left - label_offset - layout.label_width - 5.0, w.bottom + 0.5 * (w.height - y_length)},
             {.size = title_size, .angle = 0.5 * std::numbers::pi});
}

void paint(vtkChartXY& chart, Paper& paper, const Rectangle& place) {
  vtkNew<vtkContextScene> scene;
  scene->AddItem(&chart);
  scene->SetGeometry(static_cast<int>(in_scene(place.width)), static_cast<int>(in_scene(place.height)));
  vtkNew<PaperDevice> device;
  device->draw_on(paper, place);
  vtkNew<vtkContext2D> painter;
  painter->Begin(device);
  scene->Paint(painter);
  painter->End();
  paper.clip(std::nullopt);
}

}  // namespace

Colour series_colour(int number) {
  // Okabe and Ito's colours for all kinds of colour vision, then greys for bands.
  static constexpr std::array<Colour, 8> colours{{{0.0, 0.0, 0.0},
                                                  {0.0, 0.447, 0.698},
                                                  {0.835, 0.369, 0.0},
                                                  {0.0, 0.62, 0.451},
                                                  {0.8, 0.475, 0.655},
                                                  {0.902, 0.624, 0.0},
                                                  {0.337, 0.706, 0.914},
                                                  {0.83, 0.83, 0.83}}};
  return colours[static_cast<std::size_t>(number) % colours.size()];
}

void draw_chart(Paper& paper, const Rectangle& place, const Chart& chart) {
  const ChartLayout layout = layout_of(place, chart);
  vtkNew<vtkChartXY> plot;
  plot->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  plot->SetShowLegend(false);
  const Rectangle& window = layout.window;
  plot->SetSize(vtkRectf(in_scene(window.left - place.left), in_scene(window.bottom - place.bottom),
                         in_scene(window.width), in_scene(window.height)));
  set_axis(plot->GetAxis(vtkAxis::BOTTOM), layout.x);
  set_axis(plot->GetAxis(vtkAxis::LEFT), layout.y);
  for (const Series& series : chart.series)
    for (const Series& piece : unbroken(series, chart, layout))
      plot->AddPlot(series.style == SeriesStyle::band ? area_plot(piece) : line_plot(piece));
  if (plot->GetNumberOfPlots() == 0) plot->AddPlot(line_plot({}));  // VTK paints no axes otherwise
  paint(*plot, paper, place);
  draw_titles(paper, layout, chart);
}

}  // namespace pfdm
