#include "cases/python/extension/array_mesh.h"

#include "mesh/files/import_mesh.h"
#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace pfdm {
namespace {

constexpr const char* numbers_name = "numbers";

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

void add_cells(const MeshArrays& arrays, MeshFile& file) {
  const py::ssize_t n = arrays.types.size();
  require_length(arrays.types, n, "types");
  require_length(arrays.offsets, n, "offsets");
  require(arrays.connectivity.ndim() == 1, "connectivity must have one dimension");
  file.cell_type.assign(arrays.types.data(), arrays.types.data() + n);
  require(std::ranges::find(file.cell_type, 42) == file.cell_type.end(),
          "polyhedra (type 42) have faces, which arrays do not tell: write a .vtu file and name it in [mesh]");
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
    require(point >= 0 && point < count_of(file.points), "connectivity[{}] is {}; there are {} points, from 0 on", i,
            point, file.points.size());
    file.cell_points.push_back(static_cast<Index>(point));
  }
}

/// Patches of faces whose numbers have no name, as of Gmsh's groups; 0 is none.
void name_patches(const MeshArrays& arrays, MeshFile& file) {
  const std::vector<Index>& numbers = file.integer_arrays.at(numbers_name);
  for (Index c = 0; c < file.n_cells(); ++c)
    if (file.is_face(c) && numbers[c] != 0 && !arrays.patches.contains(numbers[c]))
      file.patch_names.emplace(numbers[c], fmt::format("patch_{}", numbers[c]));
}

}  // namespace

Mesh mesh_of(const MeshArrays& arrays) {
  MeshFile file;
  add_points(arrays.points, file);
  add_cells(arrays, file);
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
