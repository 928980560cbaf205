#include "postproc/page/paper.h"  // drawn by Cairo: the only place that knows it

#include "physics/error.h"
#include "postproc/files/utf8.h"

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace pfdm {
namespace {

constexpr double points_per_inch = 72.0;
constexpr double seam_width = 0.2;  // [pt]; without a line, viewers show hairlines between polygons side by side
constexpr double farthest = 1e6;    // [pt]; Cairo's coordinates have 24 bits before the point
constexpr const char* family = "Liberation Sans";

template <auto destroy>
struct Destroy {
  void operator()(auto* object) const { destroy(object); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Destroy<cairo_destroy>>;
using Font = std::unique_ptr<cairo_scaled_font_t, Destroy<cairo_scaled_font_destroy>>;
using FontFace = std::unique_ptr<cairo_font_face_t, Destroy<cairo_font_face_destroy>>;
using FontOptions = std::unique_ptr<cairo_font_options_t, Destroy<cairo_font_options_destroy>>;

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw ComputationError(fmt::format("the page cannot be drawn: {}", cairo_status_to_string(status)));
}

/// Letters keep their shapes and widths at all sizes.
FontOptions unhinted() {
  FontOptions options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  return options;
}

constexpr double size_of_measures = 1000.0;

/// Fontconfig gives another font where this one is missing, perhaps without Greek letters.
Font installed_font(bool bold) {
  const FontFace face(cairo_toy_font_face_create(family, CAIRO_FONT_SLANT_NORMAL,
                                                 bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL));
  cairo_matrix_t size, upright;
  cairo_matrix_init_scale(&size, size_of_measures, size_of_measures);
  cairo_matrix_init_identity(&upright);
  Font font(cairo_scaled_font_create(face.get(), &size, &upright, unhinted().get()));
  const FT_Face found = cairo_ft_scaled_font_lock_face(font.get());
  const std::string name = found == nullptr ? "no font" : found->family_name;
  if (found != nullptr) cairo_ft_scaled_font_unlock_face(font.get());
  if (name != family)
    throw ComputationError(
        fmt::format("the font of reports, {}, is not installed ({} stands in for it); the Debian package "
                    "fonts-liberation provides it",
                    family, name));
  return font;
}

cairo_scaled_font_t* font(bool bold) {
  static const Font regular = installed_font(false), thick = installed_font(true);
  return (bold ? thick : regular).get();
}

/// Cairo refuses what is no UTF-8: bytes that are none are taken as Latin-1.
std::string utf8(const std::string& text) {
  std::string result;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t length = utf8_length(rest);
    if (length > 0) {
      result += rest.substr(0, length);
    } else {
      const auto byte = static_cast<unsigned char>(rest.front());
      result += {static_cast<char>(0xc0 | (byte >> 6)), static_cast<char>(0x80 | (byte & 0x3f))};
    }
    rest.remove_prefix(std::max<std::size_t>(1, length));
  }
  return result;
}

cairo_status_t append(void* file, const unsigned char* bytes, unsigned int n) {
  static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(bytes), n);
  return CAIRO_STATUS_SUCCESS;
}

class CairoPaper : public Paper {
 public:
  /// A surface that writes into `file`, with `scale` of its units to the point.
  CairoPaper(std::unique_ptr<std::string> file, Surface surface, double height, double scale)
      : file_(std::move(file)), surface_(std::move(surface)), cairo_(cairo_create(surface_.get())) {
    cairo_scale(cairo(), scale, -scale);  // y upwards
    cairo_translate(cairo(), 0.0, -height);
    cairo_set_font_options(cairo(), unhinted().get());
    cairo_set_line_join(cairo(), CAIRO_LINE_JOIN_ROUND);
    set({1.0, 1.0, 1.0});
    if (is_picture()) cairo_paint(cairo());
  }

  void stroke(std::span<const PaperPoint> line, const Pen& pen) override {
    path(line);
    if (line.size() == 1) path(line);
    set(pen.colour);
    cairo_set_line_width(cairo(), pen.width);
    cairo_set_line_cap(cairo(), pen.dashes.empty() ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    cairo_set_dash(cairo(), pen.dashes.data(), static_cast<int>(pen.dashes.size()), 0.0);
    cairo_stroke(cairo());
  }

  void fill(std::span<const PaperPoint> polygon, const Colour& colour) override {
    path(polygon);
    cairo_close_path(cairo());
    set(colour);
    cairo_set_line_width(cairo(), seam_width);
    cairo_set_dash(cairo(), nullptr, 0, 0.0);
    cairo_fill_preserve(cairo());
    cairo_stroke(cairo());
  }

  void text(const std::string& text, const PaperPoint& point, const TextStyle& style) override {
    const std::string line = utf8(text);
    cairo_save(cairo());
    set(style.colour);
    cairo_translate(cairo(), point.x(), point.y());
    cairo_rotate(cairo(), style.angle);
    cairo_scale(cairo(), 1.0, -1.0);
    cairo_set_font_face(cairo(), cairo_scaled_font_get_font_face(font(style.bold)));
    cairo_set_font_size(cairo(), style.size);
    cairo_move_to(cairo(), -style.alignment * text_width(line, style.size, style.bold), 0.0);
    if (is_picture()) {  // letters as text would begin at whole pixels
      cairo_text_path(cairo(), line.c_str());
      cairo_fill(cairo());
    } else {
      cairo_show_text(cairo(), line.c_str());
      cairo_new_path(cairo());
    }
    cairo_restore(cairo());
  }

  void clip(const std::optional<Rectangle>& window) override {
    cairo_reset_clip(cairo());
    if (!window) return;
    cairo_rectangle(cairo(), window->left, window->bottom, window->width, window->height);
    cairo_clip(cairo());
  }

  std::string content() override {
    check(cairo_status(cairo()));
    if (is_picture()) check(cairo_surface_write_to_png_stream(surface_.get(), append, file_.get()));
    cairo_surface_finish(surface_.get());
    check(cairo_surface_status(surface_.get()));
    return std::move(*file_);
  }

 private:
  cairo_t* cairo() const { return cairo_.get(); }
  bool is_picture() const { return cairo_surface_get_type(surface_.get()) == CAIRO_SURFACE_TYPE_IMAGE; }
  void set(const Colour& c) { cairo_set_source_rgb(cairo(), c.red, c.green, c.blue); }
  void path(std::span<const PaperPoint> points) {
    for (const PaperPoint& p : points)
      cairo_line_to(cairo(), std::clamp(p.x(), -farthest, farthest), std::clamp(p.y(), -farthest, farthest));
  }

  std::unique_ptr<std::string> file_;
  Surface surface_;
  Context cairo_;
};

}  // namespace

std::unique_ptr<Paper> pdf_paper(double width, double height, const std::string& title) {
  auto file = std::make_unique<std::string>();
  Surface surface(cairo_pdf_surface_create_for_stream(append, file.get(), width, height));
  const auto tell = [&](cairo_pdf_metadata_t what, const std::string& value) {
    cairo_pdf_surface_set_metadata(surface.get(), what, value.c_str());
  };
  tell(CAIRO_PDF_METADATA_TITLE, utf8(title));
  tell(CAIRO_PDF_METADATA_CREATOR, "pfdm");
  tell(CAIRO_PDF_METADATA_CREATE_DATE, "");  // the same page gives the same bytes
  return std::make_unique<CairoPaper>(std::move(file), std::move(surface), height, 1.0);
}

std::unique_ptr<Paper> png_paper(double width, double height, double dots_per_inch) {
  const double scale = dots_per_inch / points_per_inch;
  const auto pixels = [scale](double points) { return static_cast<int>(std::lround(scale * points)); };
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(width), pixels(height)));
  return std::make_unique<CairoPaper>(std::make_unique<std::string>(), std::move(surface), height, scale);
}

double text_width(const std::string& text, double size, bool bold) {
  cairo_text_extents_t extents;
  cairo_scaled_font_text_extents(font(bold), utf8(text).c_str(), &extents);
  return size / size_of_measures * extents.x_advance;
}

double fitting_size(const std::string& text, double size, double width, bool bold) {
  const double natural = text_width(text, size, bold);
  return natural > width ? size * width / natural : size;
}

}  // namespace pfdm
