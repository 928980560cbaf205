// pdf_paper() of paper.h: one page of vector graphics (ISO 32000-1). The only place that knows zlib.

#include "physics/error.h"
#include "postproc/page/lettering.h"
#include "postproc/page/paper.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace pfdm {
namespace {

struct NamedCharacter {
  std::string_view utf8;
  char code;
};
/// Characters that WinAnsiEncoding has beyond ISO 8859-1 and that a text may well hold.
constexpr std::array<NamedCharacter, 4> beyond_latin1{
    {{"\u2013", '\x96'}, {"\u2014", '\x97'}, {"\u2019", '\x92'}, {"\u2022", '\x95'}}};

/// In WinAnsiEncoding; none if a character is not in it.
std::optional<std::string> win_ansi(const std::string& utf8) {
  std::string text;
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const auto byte = static_cast<unsigned char>(utf8[i]);
    if (byte < 0x80) {
      text += utf8[i];
    } else if ((byte == 0xc2 || byte == 0xc3) && i + 1 < utf8.size()) {
      text += static_cast<char>(((byte & 0x03) << 6) | (static_cast<unsigned char>(utf8[++i]) & 0x3f));
    } else {
      const auto rest = std::string_view(utf8).substr(i);
      const auto* found = std::ranges::find_if(beyond_latin1, [&](const auto& c) { return rest.starts_with(c.utf8); });
      if (found == beyond_latin1.end()) return std::nullopt;
      text += found->code;
      i += found->utf8.size() - 1;
    }
  }
  return text;
}

/// As a literal string of PDF.
std::string literal(const std::string& bytes) {
  std::string text = "(";
  for (const char c : bytes) {
    if (c == '(' || c == ')' || c == '\\') text += '\\';
    text += c;
  }
  return text + ")";
}

std::string deflated(const std::string& bytes) {
  uLongf n = compressBound(bytes.size());
  std::string result(n, '\0');
  if (compress2(reinterpret_cast<Bytef*>(result.data()), &n, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                Z_BEST_COMPRESSION) != Z_OK)
    throw ComputationError("the page cannot be compressed: there is not enough memory");
  result.resize(n);
  return result;
}

class PdfPaper : public Paper {
 public:
  PdfPaper(double width, double height, const std::string& title)
      : width_(width), height_(height), title_(win_ansi(title).value_or("")) {
    drawing_ = "1 j\n";
  }

  void stroke(std::span<const PaperPoint> line, const Pen& pen) override {
    if (line.size() < 2) return;
    const auto& c = pen.colour;
    put("{:.3g} {:.3g} {:.3g} RG {:.4g} w {} J [", c.red, c.green, c.blue, pen.width, pen.dashes.empty() ? 1 : 0);
    for (const double dash : pen.dashes) put("{:.4g} ", dash);
    put("] 0 d\n");
    path(line);
    put("S\n");
  }

  void fill(std::span<const PaperPoint> polygon, const Colour& c) override {
    if (polygon.size() < 3) return;
    put("{0:.3g} {1:.3g} {2:.3g} rg {0:.3g} {1:.3g} {2:.3g} RG ", c.red, c.green, c.blue);
    put("{} w [] 0 d\n", seam_width);  // without a line, viewers leave hairlines between polygons side by side
    path(polygon);
    put("b\n");
  }

  void text(const std::string& text, const PaperPoint& start, const TextStyle& style) override {
    if (text.empty()) return;
    put("{:.3g} {:.3g} {:.3g} rg\n", style.colour.red, style.colour.green, style.colour.blue);
    const auto encoded = win_ansi(text);
    if (!encoded) return show_outline(text_outline(text, style.size, style.bold), start, style.angle);
    const double c = std::cos(style.angle), s = std::sin(style.angle);
    put("BT /F{} {:.4g} Tf {:.5f} {:.5f} {:.5f} {:.5f} {:.2f} {:.2f} Tm ", style.bold ? 2 : 1, style.size, c, s, -s, c,
        start.x(), start.y());
    drawing_ += literal(*encoded);
    put(" Tj ET\n");
  }

  void clip(const std::optional<Rectangle>& window) override {
    if (clipped_) put("Q\n");
    clipped_ = window.has_value();
    if (clipped_)
      put("q {:.2f} {:.2f} {:.2f} {:.2f} re W n\n", window->left, window->bottom, window->width, window->height);
  }

  std::string content() override {
    clip(std::nullopt);
    file_ = "%PDF-1.4\n%\xb5\xb6\xb7\xb8\n";
    offsets_.clear();
    add_object("<< /Type /Catalog /Pages 2 0 R >>");
    add_object("<< /Type /Pages /Kids [3 0 R] /Count 1 >>");
    add_object(
        fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {} {}] /Contents 6 0 R /Resources << /Font << /F1 4 0 "
                    "R /F2 5 0 R >> >> >>",
                    width_, height_));
    for (const char* font : {"Helvetica", "Helvetica-Bold"})
      add_object(fmt::format("<< /Type /Font /Subtype /Type1 /BaseFont /{} /Encoding /WinAnsiEncoding >>", font));
    const std::string packed = deflated(drawing_);
    add_object(fmt::format("<< /Length {} /Filter /FlateDecode >>\nstream\n{}\nendstream", packed.size(), packed));
    add_object(fmt::format("<< /Title {} /Creator (pfdm) >>", literal(title_)));
    add_trailer();
    return file_;
  }

 private:
  static constexpr double seam_width = 0.15;  // [pt]

  template <class... Arguments>
  void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(drawing_), format, std::forward<Arguments>(arguments)...);
  }

  void path(std::span<const PaperPoint> points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      put("{:.2f} {:.2f} {}\n", points[i].x(), points[i].y(), i == 0 ? 'm' : 'l');
  }

  void show_outline(const Outline& outline, const PaperPoint& start, double angle) {
    for (const auto& polygon : outline) {
      std::vector<PaperPoint> points;
      points.reserve(polygon.size());
      for (const PaperPoint& p : polygon) points.push_back(turned(p, start, angle));
      path(points);
      put("h\n");
    }
    put("f\n");
  }

  void add_object(const std::string& body) {
    offsets_.push_back(file_.size());
    file_ += fmt::format("{} 0 obj\n", offsets_.size()) + body + "\nendobj\n";
  }

  void add_trailer() {
    const std::size_t start = file_.size();
    file_ += fmt::format("xref\n0 {}\n0000000000 65535 f \n", offsets_.size() + 1);
    for (const std::size_t offset : offsets_) file_ += fmt::format("{:010} 00000 n \n", offset);
    file_ += fmt::format("trailer\n<< /Size {} /Root 1 0 R /Info {} 0 R >>\nstartxref\n{}\n%%EOF\n",
                         offsets_.size() + 1, offsets_.size(), start);
  }

  double width_, height_;
  std::string title_;
  std::string drawing_;
  std::string file_;
  std::vector<std::size_t> offsets_;  // of the objects in the file
  bool clipped_ = false;
};

}  // namespace

std::unique_ptr<Paper> pdf_paper(double width, double height, const std::string& title) {
  return std::make_unique<PdfPaper>(width, height, title);
}

}  // namespace pfdm
