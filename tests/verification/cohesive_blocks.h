#pragma once
// Cohesive faces for the tests: laws with their usual shapes, glued faces, two blocks with one face between them.

#include "physics/registry.h"
#include "tests/verification/support.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace pfdm::verification {

inline constexpr double edge = 1e-3;                        // of a block [m]
inline constexpr double strength = 2e6, toughness = 400.0;  // [Pa], [J/m^2]
inline constexpr double stiffness = 5e12;                   // of the straight rise [Pa/m]
inline const IsotropicElasticity block = from_young_poisson(1e9, 0.0);

inline InterfaceLaw law_of(const TractionSeparationLaw& law, std::string_view mode = "camacho_ortiz") {
  InterfaceLaw interface { .law = &law, .mixed_mode = &find_by_name(mixed_modes(), mode, "mixed mode") };
  for (std::size_t i = law.has_rise() ? 1 : 0; i < law.shape.size(); ++i) interface.shape.push_back(law.shape[i].first);
  return interface;
}

inline std::vector<Index> faces_between(const Mesh& mesh, const std::function<bool(const Vector&)>& counts) {
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.n_interior_faces(); ++f)
    if (counts(mesh.face_centre[f])) faces.push_back(f);
  return faces;
}

inline void glue(FractureModel& model, const Mesh& mesh, const InterfaceLaw& law, const InterfaceStrength& at,
                 const Vector& along, const std::function<bool(const Vector&)>& counts) {
  CohesiveSurface surface{.name = "glue", .law = law, .faces = faces_between(mesh, counts)};
  for (const Index f : surface.faces) {
    surface.sign.push_back(mesh.face_area[f].dot(along) > 0.0 ? 1.0 : -1.0);
    surface.at.push_back(at);
  }
  model.interfaces.push_back(std::move(surface));
}

// Two blocks side by side along x, of n cells each, glued at x = edge.
inline Mesh two_blocks(Index n) {
  BoxHexesSettings box;
  box.axes[0] = {{2.0 * edge, 2 * n, 1.0}};
  box.axes[1] = {{edge, n, 1.0}};
  box.axes[2] = {{edge, n, 1.0}};
  return make_box_hexes(box);
}

inline constexpr InterfaceStrength glued{.strength = strength,
                                         .toughness = toughness,
                                         .shear_strength = 3e6,
                                         .shear_toughness = 700.0,
                                         .stiffness = stiffness};

inline FractureModel glued_blocks(const Mesh& mesh, const InterfaceLaw& law) {
  FractureModel model = elastic_model({block}, {});
  glue(model, mesh, law, glued, Vector::UnitX(), [](const Vector& x) { return std::abs(x.x() - edge) < 1e-9; });
  return model;
}

}  // namespace pfdm::verification
