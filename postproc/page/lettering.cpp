#include "postproc/page/lettering.h"

#include "physics/error.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <Eigen/Geometry>

#include <map>
#include <memory>

namespace pfdm {
namespace {

constexpr int segments_of_curve = 4;

/// In units of the font's size.
struct Glyph {
  Outline outline;
  double advance = 0.0;  // from its start to that of the next
};

/// Collects what FreeType tells of an outline.
struct OutlineMaker {
  Outline outline;
  double scale = 1.0;

  PaperPoint at(const FT_Vector* p) const {
    return scale * PaperPoint(static_cast<double>(p->x), static_cast<double>(p->y));
  }
  void curve_to(const PaperPoint& b, const PaperPoint& c, const PaperPoint& end) {
    const PaperPoint a = outline.back().back();
    for (int i = 1; i <= segments_of_curve; ++i) {
      const double t = static_cast<double>(i) / segments_of_curve, s = 1.0 - t;
      outline.back().push_back(s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * end);
    }
  }
  static OutlineMaker& of(void* user) { return *static_cast<OutlineMaker*>(user); }
  static int move(const FT_Vector* to, void* user) {
    of(user).outline.push_back({of(user).at(to)});
    return 0;
  }
  static int line(const FT_Vector* to, void* user) {
    of(user).outline.back().push_back(of(user).at(to));
    return 0;
  }
  static int conic(const FT_Vector* control, const FT_Vector* to, void* user) {
    const PaperPoint a = of(user).outline.back().back(), b = of(user).at(control), c = of(user).at(to);
    of(user).curve_to((a + 2.0 * b) / 3.0, (c + 2.0 * b) / 3.0, c);
    return 0;
  }
  static int cubic(const FT_Vector* b, const FT_Vector* c, const FT_Vector* to, void* user) {
    of(user).curve_to(of(user).at(b), of(user).at(c), of(user).at(to));
    return 0;
  }
};

class Font {
 public:
  explicit Font(const char* file) {
    if (FT_Init_FreeType(&library_) != 0 || FT_New_Face(library_, file, 0, &face_) != 0)
      throw ComputationError(
          fmt::format("{}: the font of reports cannot be read; the Debian package fonts-liberation provides it", file));
  }
  ~Font() { FT_Done_FreeType(library_); }  // its faces go with it
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  /// A character that the font has not is its empty box.
  const Glyph& glyph(char32_t character) {
    const auto [entry, is_new] = glyphs_.try_emplace(character);
    if (is_new) entry->second = load(character);
    return entry->second;
  }

 private:
  Glyph load(char32_t character) const {
    Glyph glyph;
    if (FT_Load_Glyph(face_, FT_Get_Char_Index(face_, character), FT_LOAD_NO_SCALE) != 0) return glyph;
    OutlineMaker maker{.outline = {}, .scale = 1.0 / face_->units_per_EM};
    const FT_Outline_Funcs functions{
        &OutlineMaker::move, &OutlineMaker::line, &OutlineMaker::conic, &OutlineMaker::cubic, 0, 0};
    FT_Outline_Decompose(&face_->glyph->outline, &functions, &maker);
    glyph.outline = std::move(maker.outline);
    glyph.advance = maker.scale * static_cast<double>(face_->glyph->metrics.horiAdvance);
    return glyph;
  }

  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
  std::map<char32_t, Glyph> glyphs_;
};

Font& font(bool bold) {
  static Font regular(PFDM_FONT), thick(PFDM_BOLD_FONT);
  return bold ? thick : regular;
}

/// What is no UTF-8 is taken byte by byte.
std::u32string characters(const std::string& utf8) {
  std::u32string result;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    std::size_t length = first < 0xc0 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (i + length > utf8.size()) length = 1;
    char32_t character = length == 1 ? first : first & (0x7fU >> length);
    for (std::size_t k = 1; k < length; ++k)
      character = (character << 6) | (static_cast<unsigned char>(utf8[i + k]) & 0x3fU);
    result += character;
    i += length;
  }
  return result;
}

}  // namespace

double text_width(const std::string& text, double size, bool bold) {
  double width = 0.0;
  for (const char32_t character : characters(text)) width += font(bold).glyph(character).advance;
  return size * width;
}

Outline text_outline(const std::string& text, double size, bool bold) {
  Outline outline;
  PaperPoint start(0.0, 0.0);
  for (const char32_t character : characters(text)) {
    const Glyph& glyph = font(bold).glyph(character);
    for (const auto& polygon : glyph.outline) {
      outline.emplace_back();
      for (const PaperPoint& p : polygon) outline.back().push_back(size * (start + p));
    }
    start.x() += glyph.advance;
  }
  return outline;
}

PaperPoint turned(const PaperPoint& point, const PaperPoint& start, double angle) {
  return start + Eigen::Rotation2Dd(angle) * point;
}

}  // namespace pfdm
