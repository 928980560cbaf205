#pragma once
// Small meshes, random fields and boundary conditions for the tests of the solver.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mesh/generators/box_hexes.h"
#include "mesh/generators/particles_in_box.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/parallel.h"

namespace pfdm {

/// A box of nx x ny x nz cells with edges of the given lengths; its lower corner is the origin.
inline Mesh box(Index nx, Index ny, Index nz, const Vector& size = Vector::Ones(), double ratio = 1.0,
                std::vector<SubRegion> regions = {}) {
  BoxHexesSettings settings;
  settings.axes = {{{{size[0], nx, ratio}}, {{size[1], ny, ratio}}, {{size[2], nz, ratio}}}};
  settings.regions = std::move(regions);
  return make_box_hexes(settings);
}

/// A sphere of radius 1 in a cube of half-width 3: tetrahedra, and prisms in the layers.
inline Mesh tetrahedra_and_prisms(Index subdivision = 3, Index n_layers = 4) {
  ParticlesInBoxSettings settings;
  settings.lower = Vector::Constant(-3.0);
  settings.upper = Vector::Constant(3.0);
  settings.grading = 0.6;
  Particle sphere;
  sphere.radius = 1.0;
  sphere.subdivision = subdivision;
  sphere.n_layers = n_layers;
  sphere.layer_thickness = 0.4;
  settings.particles = {sphere};
  return make_particles_in_box(settings);
}

class RandomNumbers {
 public:
  double between(double low, double high) { return low + (high - low) * uniform_(engine_); }
  Vector vector() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
  Tensor tensor() {
    Tensor a;
    a << vector(), vector(), vector();
    return a;
  }
  CellField<double> field(Index n, double low, double high) {
    CellField<double> result(n);
    for (double& value : result) value = between(low, high);
    return result;
  }

 private:
  std::mt19937 engine_{20240611};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

inline BoundaryCondition clamped(const std::string& patch) {
  return {.patch = patch, .displacement_prescribed = {true, true, true}, .value = {}};
}

inline BoundaryCondition held_along(const std::string& patch, std::size_t axis) {
  BoundaryCondition condition{.patch = patch, .value = {}};
  condition.displacement_prescribed[axis] = true;
  return condition;
}

inline BoundaryCondition of_kind(const std::string& patch, BoundaryCondition::Kind kind) {
  return {.patch = patch, .kind = kind, .value = {}};
}

/// Leaves one thread behind, whatever a test asked for.
class WithThreads : public ::testing::Test {
 protected:
  void TearDown() override { set_threads(1); }
};

}  // namespace pfdm
