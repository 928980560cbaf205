#include "mesh/files/field_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "mesh/files/flat_mesh.h"
#include "mesh/files/vtk_file.h"
#include "physics/error.h"

namespace pfdm {
namespace {

/// What of a cell of VTK's is used: its corners, the first of its points.
struct Corners {
  int vtk_type;
  int linear_type;
  Index n;
};
constexpr Corners higher_order[] = {
    {21, 3, 2},  {68, 3, 2},  // quadratic and Lagrange lines
    {22, 5, 3},  {69, 5, 3},  // quadratic and Lagrange triangles
    {34, 5, 3},               // with a point within
    {23, 9, 4},  {28, 9, 4},  {70, 9, 4},  {24, 10, 4}, {71, 10, 4}, {25, 12, 8}, {29, 12, 8}, {33, 12, 8},
    {72, 12, 8}, {26, 13, 6}, {31, 13, 6}, {32, 13, 6}, {73, 13, 6}, {27, 14, 5}, {37, 14, 5}, {74, 14, 5},
};

/// The same mesh with cells of first order, as many.
MeshFile with_corners_alone(const MeshFile& file) {
  MeshFile linear;
  linear.points = file.points;
  linear.polyhedron_faces = file.polyhedron_faces;
  for (std::size_t c = 0; c < file.cell_type.size(); ++c) {
    const auto row = std::ranges::find(higher_order, file.cell_type[c], &Corners::vtk_type);
    const auto begin = file.cell_points.begin() + file.cell_offsets[c];
    const Index n = file.cell_offsets[c + 1] - file.cell_offsets[c];
    const bool is_higher = row != std::end(higher_order) && row->n <= n;
    linear.cell_type.push_back(is_higher ? row->linear_type : file.cell_type[c]);
    linear.cell_points.insert(linear.cell_points.end(), begin, begin + (is_higher ? row->n : n));
    linear.cell_offsets.push_back(count_of(linear.cell_points));
  }
  return linear;
}

struct Volumes {
  CellSoup soup;
  std::vector<Index> number;  ///< of each of its cells in the file
};

Volumes volumes_of(const MeshFile& file, double scale) {
  constexpr int voxel = 11, polyhedron = 42;
  Volumes volumes;
  for (const Vector& x : file.points) {
    if (!x.allFinite()) throw InputError("one of its points is not finite");
    volumes.soup.points.push_back(scale * x);
  }
  std::size_t stream = 0;
  for (std::size_t c = 0; c < file.cell_type.size(); ++c) {
    const auto shape = shape_of(file.cell_type[c]);
    if (!shape) continue;
    std::vector<Index> points(file.cell_points.begin() + file.cell_offsets[c],
                              file.cell_points.begin() + file.cell_offsets[c + 1]);
    if (file.cell_type[c] == voxel && points.size() == 8) {
      std::swap(points[2], points[3]);
      std::swap(points[6], points[7]);
    }
    volumes.soup.add_cell(*shape, points, 0);
    if (file.cell_type[c] == polyhedron) volumes.soup.polyhedron_faces.push_back(file.polyhedron_faces[stream++]);
    volumes.number.push_back(static_cast<Index>(c));
  }
  return volumes;
}

FieldFile field_of(MeshFile file, const FileArray& array, int component, double scale) {
  if (component < 0 && array.n_components > 1)
    throw InputError(fmt::format("the array has {} components: name one, from 1", array.n_components));
  if (component >= array.n_components)
    throw InputError(
        fmt::format("the array has {} component{}", array.n_components, array.n_components > 1 ? "s" : ""));
  const auto n_points = count_of(file.points);
  file = with_corners_alone(file);
  std::array<bool, 3> varies{true, true, true};
  Vector fixed = Vector::Zero();
  if (const auto axis = flat_along(file)) {
    const double depth = size_of(file.points), level = file.points[file.cell_points.front()][*axis];
    extrude(file, *axis, depth);
    varies[*axis] = false;
    fixed[*axis] = scale * (level + 0.5 * depth);
  }
  Volumes volumes = volumes_of(file, scale);
  if (volumes.number.empty()) throw InputError("it has no cells with a volume, nor faces in a plane normal to an axis");
  FieldFile read{.field = {.places = KnownPlaces(volumes.soup),
                           .at_points = array.at_points,
                           .entry = array.at_points ? counted_from_zero(volumes.soup.points.size()) : volumes.number,
                           .varies = varies,
                           .fixed = fixed},
                 .values = {}};
  if (array.at_points)
    for (Index& entry : read.field.entry) entry %= n_points;  // the two sides of a layer
  for (auto i = static_cast<std::size_t>(std::max(component, 0)); i < array.values.size();
       i += static_cast<std::size_t>(array.n_components))
    read.values.push_back(array.values[i]);
  return read;
}

}  // namespace

FieldFile read_field_file(const std::filesystem::path& path, const std::string& array, int component, double scale) {
  auto [mesh, field] = read_vtk_array(path, array);
  try {
    return field_of(std::move(mesh), field, component, scale);
  } catch (const InputError& e) {
    throw InputError(fmt::format("the field {}: {}", path.string(), e.what()));
  }
}

}  // namespace pfdm
