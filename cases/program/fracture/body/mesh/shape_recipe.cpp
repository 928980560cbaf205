#include "cases/program/fracture/body/mesh/shape_recipe.h"

#include "cases/program/fracture/body/mesh/mesh_part_keys.h"
#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/config/units.h"
#include "cases/program/input/fields/amount.h"
#include "mesh/surfaces/particle_shape.h"
#include "mesh/surfaces/sphere_refinement.h"
#include "mesh/surfaces/surface_file.h"
#include "mesh/surfaces/surface_remeshing.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

Tensor read_rotation(const ConfigTable& table) {
  const double angle = table.quantity("angle", 0.0);
  const auto axis = table.find("axis");
  const Vector direction = axis ? read_direction(*axis).normalized() : Vector::UnitZ().eval();
  return Eigen::AngleAxisd(angle, direction).toRotationMatrix();
}

// Of the coordinates in the file [m].
double read_scale(const ConfigTable& table, const TriangleSurface& surface) {
  if (table.has("diameter") == table.has("length_unit"))
    throw table.error(
        "give either length_unit, the unit of the coordinates in the surface's file, as in \"mm\", or diameter, that "
        "of the sphere of the same volume");
  if (table.has("length_unit")) {
    const ConfigValue unit = table.at("length_unit");
    return unit.in_context([&] { return unit_in_si(unit.string(), dimension::length); }) * table.number("scale", 1.0);
  }
  if (table.has("scale"))
    throw table.at("scale").error("it cannot be combined with diameter, which says how large the particle is");
  const double diameter = table.quantity("diameter");
  return diameter / std::cbrt(6.0 / std::numbers::pi * enclosed_volume(surface));
}

TriangleSurface read_surface(const ConfigValue& value, const std::filesystem::path& file) {
  return value.in_context([&] {
    std::size_t n_merged = 0;
    TriangleSurface surface = read_surface_file(file, &n_merged);
    if (n_merged > 0) value.remark(fmt::format("{} of its points coincide with others and are merged", n_merged));
    check_surfaces({{file.string(), surface}});
    return surface;
  });
}

}  // namespace

ShapeRecipe read_shape(const ConfigTable& table, const std::filesystem::path& case_directory) {
  table.with_keys(particle_keys(), "file");
  ShapeRecipe recipe{.file = read_data_file(table.at("surface"), case_directory)};
  recipe.surface = read_surface(table.at("surface"), recipe.file);
  recipe.scale = read_scale(table, recipe.surface);
  recipe.rotation = read_rotation(table);
  recipe.sharp_angle = table.quantity("sharp_angle", recipe.sharp_angle);
  table.at("surface_size");  // the one size that there is
  return recipe;
}

PackedShape read_packed_shape(const ConfigTable& table, const std::filesystem::path& case_directory) {
  const std::filesystem::path file = read_data_file(table.at("surface"), case_directory);
  PackedShape shape{.given = {file.string(), read_surface(table.at("surface"), file)}};
  shape.sharp = table.quantity("sharp_angle", shape.sharp);
  return shape;
}

TriangleSurface make_shape(const ShapeRecipe& recipe, double size) {
  const TriangleSurface placed = about_centroid(recipe.surface, recipe.scale, recipe.rotation);
  return remeshed_body({recipe.file.string(), placed}, size, recipe.sharp_angle);
}

}  // namespace pfdm
