#pragma once
// A page of a report as data: rows of charts, tables and pictures. Numbers are in the units that their captions and
// axes name.

#include <Eigen/Core>

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace pfdm {

enum class SeriesStyle { line, dashed, points, line_with_points, band };

struct Series {
  std::string label;  ///< empty: not in the key
  std::vector<double> x, y;
  SeriesStyle style = SeriesStyle::line;
  int colour = 0;               ///< number in the page's list of colours
  std::vector<double> upper{};  ///< of a band, whose lower edge is y
  bool of_steps = false;        ///< a point for each row of the run's curve
};

struct ChartAxis {
  std::string title;  ///< with the unit, as in "force [N]"
  bool logarithmic = false;
  std::optional<double> from{}, to{};  ///< none: as far as the series go
};

struct Chart {
  std::string caption;
  ChartAxis x, y;
  std::vector<Series> series;
};

struct Table {
  std::string caption;
  std::vector<std::vector<std::string>> rows;  ///< as many cells in each
  bool has_header = false;                     ///< the first row names the columns
};

struct TextBlock {
  std::string caption;
  std::vector<std::string> lines;  ///< broken where they are too long
};

/// Polygons filled by the colours of a value, and lines.
struct Picture {
  struct Cell {
    std::vector<Eigen::Vector2d> corners;
    double value = 0.0;
  };
  std::string caption;
  std::string x_title, y_title;  ///< with the unit
  std::string value_title;
  double least = 0.0, most = 1.0;  ///< ends of the colours
  std::vector<Cell> cells;
  std::vector<std::vector<Eigen::Vector2d>> lines;
  bool stretched = false;  ///< fills its place; otherwise both directions have one scale
};

using PageBlock = std::variant<Chart, Table, TextBlock, Picture>;

/// Blocks side by side. The height that tables and texts leave is shared among the rows with charts and pictures.
struct PageRow {
  std::vector<PageBlock> blocks;
  std::vector<double> widths{};  ///< in proportion; none: equal
  double height = 1.0;           ///< of a row with charts or pictures, in proportion
};

struct ReportPage {
  std::string title;
  std::string subtitle;
  std::vector<PageRow> rows;
};

}  // namespace pfdm
