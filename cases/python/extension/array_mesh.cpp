#include "cases/python/extension/array_mesh.h"

#include "mesh/files/import_mesh.h"
#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <span>
#include <vector>

namespace pfdm {
namespace {

constexpr const char* numbers_name = "numbers";
constexpr int polyhedron = 42;  // vtkCellType.h

/// `why` and its arguments as of fmt::format, which is called where it does not hold alone.
template <class... Arguments>
void require(bool holds, fmt::format_string<const Arguments&...> why, const Arguments&... arguments) {
  if (!holds) throw InputError("the mesh of arrays: " + fmt::format(why, arguments...));
}

void require_length(const py::array& array, py::ssize_t n, const char* name) {
  require(array.ndim() == 1 && array.size() == n, "{} has the shape {}; ({},) is expected, an entry for each cell",
          name, shape_words(array), n);
}

void add_points(const ArrayOf<double>& points, MeshFile& file) {
  require(points.ndim() == 2 && points.shape(1) == 3 && points.shape(0) > 0,
          "points has the shape {}; (n_points, 3) is expected", shape_words(points));
  require(points.shape(0) < std::numeric_limits<Index>::max(), "it has more points than can be counted");
  const double* x = points.data();
  for (py::ssize_t i = 0; i < points.shape(0); ++i, x += 3) file.points.emplace_back(x[0], x[1], x[2]);
}

/// `point`, which stands at `array`[at].
Index point_number(std::int64_t point, const char* array, std::int64_t at, const MeshFile& file) {
  require(point >= 0 && point < count_of(file.points), "{}[{}] is {}; there are {} points, from 0 on", array, at, point,
          file.points.size());
  return static_cast<Index>(point);
}

void add_cells(const MeshArrays& arrays, MeshFile& file) {
  const py::ssize_t n = arrays.types.size();
  require_length(arrays.types, n, "types");
  require_length(arrays.offsets, n, "offsets");
  require(arrays.connectivity.ndim() == 1, "connectivity must have one dimension");
  file.cell_type.assign(arrays.types.data(), arrays.types.data() + n);
  std::int64_t before = 0;
  for (py::ssize_t i = 0; i < n; ++i) {
    const std::int64_t end = arrays.offsets.data()[i];
    require(end > before && end <= arrays.connectivity.size(),
            "offsets[{}] is {}; it must be above {} and at most {}, where connectivity ends", i, end, before,
            arrays.connectivity.size());
    file.cell_offsets.push_back(static_cast<Index>(end));
    before = end;
  }
  for (std::int64_t i = 0; i < before; ++i) {
    const std::int64_t point = arrays.connectivity.data()[i];
    file.cell_points.push_back(point_number(point, "connectivity", i, file));
  }
}

/// The numbers of `faces`, one after the other.
class FaceStream {
 public:
  explicit FaceStream(const ArrayOf<std::int64_t>& faces) : faces_(faces) {
    require(faces.ndim() == 1, "faces has the shape {}; one dimension is expected", shape_words(faces));
  }
  py::ssize_t at() const { return at_; }
  bool is_at_end() const { return at_ == faces_.size(); }
  std::int64_t next(Index cell) {
    require(!is_at_end(), "faces ends within those of cell {}", cell);
    return faces_.data()[at_++];
  }
  /// Of faces, or of a face's points.
  Index count(Index cell, std::int64_t least, const char* what) {
    const std::int64_t n = next(cell);
    require(n >= least && n <= faces_.size(),
            "faces[{}] is {}, the number of {} of cell {}; at least {} and no more than "
            "faces has numbers are expected",
            at_ - 1, n, what, cell, least);
    return static_cast<Index>(n);
  }

 private:
  const ArrayOf<std::int64_t>& faces_;
  py::ssize_t at_ = 0;
};

std::vector<Index> faces_of_polyhedron(FaceStream& stream, Index cell, const MeshFile& file) {
  std::vector<Index> faces{stream.count(cell, 4, "faces")};
  std::set<Index> points;
  for (Index f = 0; f < faces.front(); ++f) {
    faces.push_back(stream.count(cell, 3, "points of a face"));
    for (Index left = faces.back(); left > 0; --left) {
      const py::ssize_t at = stream.at();
      faces.push_back(point_number(stream.next(cell), "faces", at, file));
      points.insert(faces.back());
    }
  }
  const auto own =
      std::span(file.cell_points)
          .subspan(as_size(file.cell_offsets[cell]), as_size(file.cell_offsets[cell + 1] - file.cell_offsets[cell]));
  require(points == std::set<Index>(own.begin(), own.end()),
          "the faces of cell {} do not have the points that it has in connectivity", cell);
  return faces;
}

void add_faces(const MeshArrays& arrays, MeshFile& file) {
  const auto n = std::ranges::count(file.cell_type, polyhedron);
  require(n == 0 || arrays.faces, "polyhedra (type {}) need the array faces", polyhedron);
  if (!arrays.faces) return;
  FaceStream stream(*arrays.faces);
  for (Index c = 0; c < file.n_cells(); ++c)
    if (file.cell_type[c] == polyhedron) file.polyhedron_faces.push_back(faces_of_polyhedron(stream, c, file));
  require(stream.is_at_end(), "faces has {} numbers; those of its polyhedra (type {}, {} cells) end after {}",
          arrays.faces->size(), polyhedron, n, stream.at());
}

/// Patches of faces whose numbers have no name, as of Gmsh's groups; 0 is none.
void name_patches(const MeshArrays& arrays, MeshFile& file) {
  const std::vector<Index>& numbers = file.integer_arrays.at(numbers_name);
  for (Index c = 0; c < file.n_cells(); ++c)
    if (file.is_face(c) && numbers[c] != 0 && !arrays.patches.contains(numbers[c]))
      file.patch_names.emplace(numbers[c], fmt::format("patch_{}", numbers[c]));
}

}  // namespace

std::optional<MeshArrays> arrays_of(const std::optional<MeshTuple>& given) {
  if (!given) return std::nullopt;
  const auto& [points, connectivity, offsets, types, numbers, regions, patches, faces] = *given;
  return MeshArrays{points, connectivity, offsets, types, numbers, regions, patches, faces};
}

Mesh mesh_of(const MeshArrays& arrays) {
  MeshFile file;
  add_points(arrays.points, file);
  add_cells(arrays, file);
  add_faces(arrays, file);
  ImportSettings settings;
  settings.file = "of arrays";
  if (arrays.numbers) {
    require_length(*arrays.numbers, arrays.types.size(), numbers_name);
    file.integer_arrays[numbers_name] = {arrays.numbers->data(), arrays.numbers->data() + arrays.numbers->size()};
    name_patches(arrays, file);
    settings.region_array = settings.face_array = numbers_name;
  }
  settings.region_names = arrays.regions;
  settings.face_sets = arrays.patches;
  return import_mesh(settings, std::move(file));
}

}  // namespace pfdm
