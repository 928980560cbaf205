#include "mesh/surfaces/surface_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "physics/error.h"

namespace pfdm {
namespace {

constexpr std::size_t stl_head = 84, stl_record = 50;  // bytes: title and count; a triangle

// One line of a text file after the other, for messages that say where.
class TextLines {
 public:
  TextLines(const std::filesystem::path& path, const std::string& content) : path_(path), stream_(content) {}

  bool next(std::istringstream& words) {
    std::string line;
    if (!std::getline(stream_, line)) return false;
    ++number_;
    words = std::istringstream(line);
    return true;
  }
  InputError error(const std::string& reason) const {
    return InputError(fmt::format("the surface {}, line {}: {}", path_.string(), number_, reason));
  }
  Vector point(std::istringstream& words) const {
    Vector x;
    if (!(words >> x[0] >> x[1] >> x[2]) || !x.allFinite()) throw error("expected three coordinates of a point");
    return x;
  }

 private:
  const std::filesystem::path& path_;
  std::istringstream stream_;
  std::size_t number_ = 0;
};

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Points of triangles that are given by their coordinates.
class PointMerger {
 public:
  void add_triangle(const std::array<Vector, 3>& corners) {
    surface_.triangles.push_back({number(corners[0]), number(corners[1]), number(corners[2])});
  }
  TriangleSurface take() { return std::move(surface_); }

 private:
  Index number(const Vector& x) {
    const std::array<double, 3> key{x[0] + 0.0, x[1] + 0.0, x[2] + 0.0};  // -0 becomes 0
    const auto [entry, is_new] = numbers_.try_emplace(key, count_of(surface_.points));
    if (is_new) surface_.points.push_back(x);
    return entry->second;
  }

  std::map<std::array<double, 3>, Index> numbers_;
  TriangleSurface surface_;
};

std::string surface_content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (!file || !(content << file.rdbuf()))
    throw InputError(
        fmt::format("cannot read the surface {}: {}", path.string(), file ? "it is empty" : std::strerror(errno)));
  return std::move(content).str();
}

bool has_binary_length(const std::string& content) {
  if (content.size() < stl_head) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + stl_head - sizeof count, sizeof count);
  return content.size() == stl_head + stl_record * count;
}

TriangleSurface read_binary_stl(const std::filesystem::path& path, const std::string& content) {
  PointMerger merger;
  for (std::size_t at = stl_head; at < content.size(); at += stl_record) {
    std::array<float, 12> numbers{};  // normal, then the corners
    std::memcpy(numbers.data(), content.data() + at, sizeof numbers);
    std::array<Vector, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = Vector(numbers[3 * i + 3], numbers[3 * i + 4], numbers[3 * i + 5]);
      if (!corners[i].allFinite())
        throw InputError(fmt::format("the surface {}, at byte {}: a coordinate is not finite", path.string(), at));
    }
    merger.add_triangle(corners);
  }
  return merger.take();
}

TriangleSurface read_text_stl(const std::filesystem::path& path, const std::string& content) {
  TextLines lines(path, content);
  PointMerger merger;
  std::array<Vector, 3> corners;
  std::size_t n = 0;
  std::istringstream words;
  for (std::string word; lines.next(words);) {
    if (!(words >> word)) continue;
    word = lower_case(word);
    if (word == "vertex") {
      if (n == 3) throw lines.error("a facet has more than three vertices");
      corners[n++] = lines.point(words);
    } else if (word == "endfacet") {
      if (n != 3) throw lines.error(fmt::format("a facet has {} vertices instead of three", n));
      merger.add_triangle(corners);
      n = 0;
    } else if (word != "solid" && word != "facet" && word != "outer" && word != "endloop" && word != "endsolid") {
      throw lines.error(fmt::format("expected facet, vertex or another word of STL, found \"{}\"", word));
    }
  }
  if (n != 0) throw lines.error("the file ends within a facet");
  return merger.take();
}

TriangleSurface read_stl(const std::filesystem::path& path, const std::string& content) {
  if (has_binary_length(content)) return read_binary_stl(path, content);
  if (lower_case(content.substr(0, 5)) == "solid") return read_text_stl(path, content);
  throw InputError(
      fmt::format("the surface {} is no STL: it neither begins with \"solid\" nor has the length that its number of "
                  "triangles asks for ({} bytes for each, {} before them)",
                  path.string(), stl_record, stl_head));
}

// "7", "7/1", "7//3", "-1": points count from 1, or back from the last one.
Index obj_point(const std::string& word, std::size_t n_points, const TextLines& lines) {
  std::istringstream digits(word.substr(0, word.find('/')));
  long number = 0;
  if (!(digits >> number) || !digits.eof())
    throw lines.error(fmt::format("expected the number of a point, as in 7 or 7/1/3, found \"{}\"", word));
  const long index = number > 0 ? number - 1 : static_cast<long>(n_points) + number;
  if (number == 0 || index < 0 || index >= static_cast<long>(n_points))
    throw lines.error(fmt::format("there is no point {}: {} points come before this line", number, n_points));
  return static_cast<Index>(index);
}

TriangleSurface read_obj(const std::filesystem::path& path, const std::string& content, std::size_t& n_merged) {
  TextLines lines(path, content);
  std::vector<Vector> points;
  PointMerger merger;
  std::set<Index> used;
  std::istringstream words;
  for (std::string word; lines.next(words);) {
    if (!(words >> word)) continue;
    if (word == "v") points.push_back(lines.point(words));
    if (word != "f") continue;
    std::vector<Vector> polygon;
    while (words >> word) {
      const Index p = obj_point(word, points.size(), lines);
      used.insert(p);
      polygon.push_back(points[p]);
    }
    if (polygon.size() < 3) throw lines.error(fmt::format("a face has {} points; it needs three", polygon.size()));
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) merger.add_triangle({polygon[0], polygon[i], polygon[i + 1]});
  }
  TriangleSurface surface = merger.take();
  n_merged = used.size() - surface.points.size();
  return surface;
}

void check_areas(const std::filesystem::path& path, const TriangleSurface& surface) {
  if (surface.triangles.empty()) throw InputError(fmt::format("the surface {} has no triangles", path.string()));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const Vector ab = surface.points[b] - surface.points[a];
    const Vector ac = surface.points[c] - surface.points[a];
    if (!(ab.cross(ac).norm() > 1e-12 * (ab.squaredNorm() + ac.squaredNorm())))
      throw InputError(fmt::format("the surface {}: its triangle {} has no area: its corners are equal or on a line",
                                   path.string(), t + 1));
  }
}

}  // namespace

TriangleSurface read_surface_file(const std::filesystem::path& path, std::size_t* n_merged) {
  const std::string kind = lower_case(path.extension().string());
  if (kind != ".stl" && kind != ".obj")
    throw InputError(fmt::format("the surface {} must be a file .stl or .obj", path.string()));
  const std::string content = surface_content(path);
  std::size_t merged = 0;
  TriangleSurface surface = kind == ".stl" ? read_stl(path, content) : read_obj(path, content, merged);
  if (n_merged != nullptr) *n_merged = merged;
  check_areas(path, surface);
  return surface;
}

}  // namespace pfdm
