#pragma once
// Reads a particle of [[mesh.particles]] whose surface is in a file.

#include "cases/program/input/config/config.h"
#include "mesh/generators/packed_spheres.h"
#include "physics/tensor.h"

#include <filesystem>
#include <numbers>

namespace pfdm {

struct ShapeRecipe {
  std::filesystem::path file;
  TriangleSurface surface{};  ///< as the file has it, checked
  double scale = 1.0;         ///< of its coordinates [m]
  Tensor rotation = Tensor::Identity();
  double sharp_angle = 0.25 * std::numbers::pi;  ///< from which on edges are kept [radian]
};

ShapeRecipe read_shape(const ConfigTable& table, const std::filesystem::path& case_directory);

/// A shape of [[mesh.shapes]]: `surface` and `sharp_angle`.
PackedShape read_packed_shape(const ConfigTable& table, const std::filesystem::path& case_directory);

/// The surface about its centroid, with triangles of the edge length `size` [m].
TriangleSurface make_shape(const ShapeRecipe& recipe, double size);

}  // namespace pfdm
