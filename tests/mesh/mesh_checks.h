#pragma once
// What every mesh has to satisfy, and small helpers of the mesh tests.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "mesh/generators/particles_in_box.h"
#include "mesh/mesh.h"

namespace pfdm {

/// A sphere of radius 1 in layers of wedges, in a box of tetrahedra.
inline Mesh wedges_and_tetrahedra() {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-3.0);
  settings.upper = Vector::Constant(3.0);
  settings.particles.resize(1);
  settings.particles[0].radius = 1.0;
  settings.particles[0].subdivision = 3;
  settings.particles[0].n_layers = 3;
  settings.particles[0].layer_thickness = 0.3;
  return make_particles_in_box(settings);
}

inline double total_volume(const Mesh& mesh) {
  return std::accumulate(mesh.cell_volume.begin(), mesh.cell_volume.end(), 0.0);
}

inline double region_volume(const Mesh& mesh, const std::string& region) {
  const Index wanted = mesh.region_index(region);
  double volume = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (mesh.region[c] == wanted) volume += mesh.cell_volume[c];
  return volume;
}

inline Index count_cells(const Mesh& mesh, CellShape shape) {
  return static_cast<Index>(std::count(mesh.shape.begin(), mesh.shape.end(), shape));
}

inline Vector patch_area(const Mesh& mesh, const std::string& name) {
  const Patch& patch = mesh.patch(name);
  Vector area = Vector::Zero();
  for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) area += mesh.face_area[f];
  return area;
}

inline void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.face_points, b.face_points);
  EXPECT_EQ(a.owner, b.owner);
  EXPECT_EQ(a.neighbour, b.neighbour);
  EXPECT_EQ(a.region, b.region);
  EXPECT_EQ(a.cell_points, b.cell_points);
  EXPECT_EQ(a.cell_volume, b.cell_volume);
}

inline Index bandwidth(const Mesh& mesh) {
  Index widest = 0;
  for (Index f = 0; f < mesh.n_interior_faces(); ++f) widest = std::max(widest, mesh.neighbour[f] - mesh.owner[f]);
  return widest;
}

// Every cell closes, has its centre inside, and its faces know it; boundary faces are all in one patch each.
inline void expect_sound(const Mesh& mesh) {
  std::vector<int> cells_of_face(mesh.n_faces(), 0);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    Vector sum = Vector::Zero();
    double size = 0.0;
    double volume = 0.0;  // by the divergence of x/3
    for (const Index f : mesh.faces_of_cell(c)) {
      ++cells_of_face[f];
      ASSERT_TRUE(mesh.owner[f] == c || (mesh.is_interior(f) && mesh.neighbour[f] == c));
      const Vector outward = mesh.owner[f] == c ? mesh.face_area[f] : Vector(-mesh.face_area[f]);
      sum += outward;
      size += outward.norm();
      volume += outward.dot(mesh.face_centre[f] - mesh.cell_centre[c]) / 3.0;
      EXPECT_GT(outward.dot(mesh.face_centre[f] - mesh.cell_centre[c]), 0.0) << "cell " << c;
    }
    EXPECT_LE(sum.norm(), 1e-12 * size) << "cell " << c;
    EXPECT_GT(mesh.cell_volume[c], 0.0);
    EXPECT_NEAR(volume, mesh.cell_volume[c], 1e-10 * mesh.cell_volume[c]) << "cell " << c;
  }
  for (Index f = 0; f < mesh.n_faces(); ++f) {
    EXPECT_EQ(cells_of_face[f], mesh.is_interior(f) ? 2 : 1);
    if (mesh.is_interior(f)) {
      EXPECT_LT(mesh.owner[f], mesh.neighbour[f]);
    }
  }
  Index next = mesh.n_interior_faces();
  for (const Patch& patch : mesh.patches) {
    EXPECT_EQ(patch.first_face, next) << patch.name;
    EXPECT_GT(patch.n_faces, 0) << patch.name;
    next += patch.n_faces;
  }
  EXPECT_EQ(next, mesh.n_faces());
}

// The message of the error that the function must throw.
template <class Error, class Function>
std::string message_of(Function&& function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace pfdm
