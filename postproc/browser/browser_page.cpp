#include "postproc/browser/browser_page.h"

#include "postproc/browser/body_json.h"
#include "postproc/browser/page_script.h"
#include "postproc/files/atomic_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <string_view>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

/// Seven digits; what is not finite becomes null.
Json number(double value) {
  return std::isfinite(value) ? Json(std::stod(fmt::format("{:.7g}", value))) : Json(nullptr);
}

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

Json json_of(const ChartAxis& axis) {
  Json json{{"title", axis.title}, {"logarithmic", axis.logarithmic}};
  if (axis.from) json["from"] = number(*axis.from);
  if (axis.to) json["to"] = number(*axis.to);
  return json;
}

std::string_view name_of(SeriesStyle style) {
  switch (style) {
    case SeriesStyle::line: return "line";
    case SeriesStyle::dashed: return "dashed";
    case SeriesStyle::points: return "points";
    case SeriesStyle::line_with_points: return "line_with_points";
    case SeriesStyle::band: return "band";
  }
  return "";
}

Json json_of(const Series& series) {
  Json json{{"label", series.label},
            {"style", name_of(series.style)},
            {"colour", series.colour},
            {"x", numbers(series.x)},
            {"y", numbers(series.y)}};
  if (!series.upper.empty()) json["upper"] = numbers(series.upper);
  if (series.of_steps) json["of_steps"] = true;
  return json;
}

Json json_of(const Chart& chart) {
  Json series = Json::array();
  for (const Series& one : chart.series) series.push_back(json_of(one));
  return {{"kind", "chart"},
          {"caption", chart.caption},
          {"x", json_of(chart.x)},
          {"y", json_of(chart.y)},
          {"series", series}};
}

/// Rows whose values have the signs of print; names and words stay as they are, and so do tables of keys, whose values
/// are those of a case file.
std::vector<std::vector<std::string>> rows_in_print(const Table& table) {
  std::vector<std::vector<std::string>> rows = table.rows;
  if (table.has_header && !rows.empty() && !rows[0].empty() && rows[0][0] == "key") return rows;
  const auto begins_with_digit = [](std::string_view cell) {
    const std::size_t at = cell.starts_with('-') ? 1 : 0;
    return at < cell.size() && cell[at] >= '0' && cell[at] <= '9';
  };
  for (auto& row : rows)
    for (std::string& cell : row)
      if (begins_with_digit(cell)) cell = in_print(std::move(cell));
  return rows;
}

Json json_of(const Table& table) {
  return {
      {"kind", "table"}, {"caption", table.caption}, {"has_header", table.has_header}, {"rows", rows_in_print(table)}};
}

Json json_of(const TextBlock& text) { return {{"kind", "text"}, {"caption", text.caption}, {"lines", text.lines}}; }

Json short_number(double value) { return std::stod(fmt::format("{:.5g}", value)); }

/// Whether four corners are those of a rectangle along the axes, the first and the third opposite.
bool is_rectangle(const std::vector<Eigen::Vector2d>& p) {
  if (p.size() != 4) return false;
  const bool starts_along_x = p[0].y() == p[1].y();
  const auto same = [](double a, double b) { return a == b; };
  return starts_along_x ? same(p[1].x(), p[2].x()) && same(p[2].y(), p[3].y()) && same(p[3].x(), p[0].x())
                        : same(p[0].x(), p[1].x()) && same(p[1].y(), p[2].y()) && same(p[2].x(), p[3].x()) &&
                              same(p[3].y(), p[0].y());
}

/// Of each cell its value and its corners, two of a rectangle, of each line its points, in one list.
Json json_of(const Picture& picture) {
  Json cells = Json::array(), lines = Json::array();
  for (const Picture::Cell& cell : picture.cells) {
    Json flat = Json::array({short_number(cell.value)});
    const bool two_do = is_rectangle(cell.corners);
    for (std::size_t i = 0; i < cell.corners.size(); i += two_do ? 2 : 1)
      flat.insert(flat.end(), {short_number(cell.corners[i].x()), short_number(cell.corners[i].y())});
    cells.push_back(std::move(flat));
  }
  for (const auto& line : picture.lines) {
    Json flat = Json::array();
    for (const Eigen::Vector2d& p : line) flat.insert(flat.end(), {short_number(p.x()), short_number(p.y())});
    lines.push_back(std::move(flat));
  }
  return {{"kind", "picture"},
          {"caption", picture.caption},
          {"x_title", picture.x_title},
          {"y_title", picture.y_title},
          {"value_title", picture.value_title},
          {"least", number(picture.least)},
          {"most", number(picture.most)},
          {"stretched", picture.stretched},
          {"cells", std::move(cells)},
          {"lines", std::move(lines)}};
}

Json json_of(const HeadFigure& figure) {
  return {{"label", figure.label}, {"value", figure.value}, {"note", figure.note}};
}

Json json_of(const PageBlock& block) {
  return std::visit([](const auto& one) { return json_of(one); }, block);
}

Json blocks_of(const ReportPage& page) {
  Json blocks = Json::array();
  for (const PageRow& row : page.rows)
    for (const PageBlock& block : row.blocks) blocks.push_back(json_of(block));
  return blocks;
}

Json json_of(const RunSet& runs) {
  Json columns = Json::array(), curves = Json::array();
  for (const RunColumn& column : runs.columns)
    columns.push_back({{"words", column.words},
                       {"unit", column.unit},
                       {"is_key", column.is_key},
                       {"values", numbers(column.values)}});
  for (const Series& curve : runs.curves)
    curves.push_back(curve.x.empty() ? Json(nullptr) : Json{{"x", numbers(curve.x)}, {"y", numbers(curve.y)}});
  Json json{{"labels", runs.labels}, {"notes", runs.notes}, {"columns", columns}, {"curves", curves}};
  json["curve"] = runs.curves.empty() ? Json(nullptr) : Json{{"x", runs.x_title}, {"y", runs.y_title}};
  return json;
}

/// Of several bodies each has its share of a page that is larger than that of one.
Json json_of(const std::vector<NamedBody>& bodies, std::vector<PagePart>& parts) {
  constexpr std::size_t room = 7000000;  // [byte]
  Json list = Json::array();
  for (const NamedBody& one : bodies) {
    std::vector<Index> kept;
    Json body = body_json(one.body, parts, room / bodies.size(), &kept);
    Json at = Json::array();
    for (const Index frame : kept) at.push_back(number(one.at[frame]));
    list.push_back({{"name", one.name}, {"steps", one.steps}, {"at", std::move(at)}, {"body", std::move(body)}});
  }
  return list;
}

/// What only some pages have.
void add_rare(Json& json, const BrowserPage& page, std::vector<PagePart>& parts) {
  if (!page.first.empty()) {
    json["first"] = Json::array();
    for (const PageBlock& block : page.first) json["first"].push_back(json_of(block));
  }
  if (!page.keys.empty()) json["keys"] = page.keys;
  if (!page.bodies.empty()) {
    json["bodies"] = json_of(page.bodies, parts);
    json["bodies_axis"] = {{"words", page.bodies_axis.words}, {"unit", page.bodies_axis.unit}};
  }
  if (page.runs) json["runs"] = json_of(*page.runs);
  if (page.live)
    json["live"] = {{"words", page.live->words},
                    {"share", number(page.live->share)},
                    {"every", number(page.live->every)},
                    {"made", page.live->made}};
}

Json json_of(const BrowserPage& page, std::vector<PagePart>& parts) {
  Json figures = Json::array();
  for (const HeadFigure& figure : page.figures) figures.push_back(json_of(figure));
  Json json{{"title", page.report.title},    {"subtitle", page.report.subtitle}, {"headline", page.headline},
            {"figures", std::move(figures)}, {"warnings", page.warnings},        {"origin", page.origin},
            {"command", page.command},       {"case_text", page.case_text},      {"steps", page.steps},
            {"beside", page.beside},         {"blocks", blocks_of(page.report)}};
  json["body"] = page.body ? body_json(*page.body, parts) : Json(nullptr);
  add_rare(json, page, parts);
  return json;
}

std::string replaced_all(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// JSON that may stand in a script element.
std::string embedded(const Json& json) {
  return replaced_all(json.dump(-1, ' ', false, Json::error_handler_t::replace), "<", "\\u003c");
}

/// For the title, which is no script's.
std::string escaped(std::string text) {
  text = replaced_all(std::move(text), "&", "&amp;");
  return replaced_all(std::move(text), "<", "&lt;");
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

}  // namespace

std::string page_as_html(const BrowserPage& page) {
  std::vector<PagePart> parts;
  const Json json = json_of(page, parts);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" "
      "content=\"light dark\">\n<link rel=\"icon\" href=\"data:,\">\n<title>{}</title>\n</head>\n<body>\n"
      "<noscript>This page draws its curves and pictures by JavaScript, which is switched off. report.pdf in the same "
      "folder does without.</noscript>\n",
      escaped(page.report.title));
  for (const PagePart& part : parts)
    html += fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", part.id, part.base64);
  html += "<script type=\"application/json\" id=\"pfdm-data\">" + embedded(json) + "</script>\n<script>\n";
  html += page_script();
  html += "</script>\n</body>\n</html>\n";
  return html;
}

void write_browser_page(const std::filesystem::path& folder, const BrowserPage& page) {
  make_folder(folder);
  write_file(folder / "index.html", page_as_html(page));
}

std::string in_print(std::string text) {
  constexpr std::array<std::string_view, 4> micro{"um", "uN", "uJ", "us"};
  for (std::size_t at = text.find('u'); at != std::string::npos; at = text.find('u', at + 1)) {
    const bool after_number =
        at > 1 && text[at - 1] == ' ' && (text[at - 2] == ')' || (text[at - 2] >= '0' && text[at - 2] <= '9'));
    const bool begins = after_number || (at > 0 && text[at - 1] == '/');
    const bool ends = at + 2 >= text.size() || !is_letter(text[at + 2]);
    const bool is_unit =
        std::ranges::any_of(micro, [&](std::string_view unit) { return text.compare(at, 2, unit) == 0; });
    if (begins && ends && is_unit) text.replace(at, 1, "µ");
  }
  text = replaced_all(std::move(text), "^2", "²");
  text = replaced_all(std::move(text), "^3", "³");
  return replaced_all(std::move(text), " degrees", "°");
}

}  // namespace pfdm
