#pragma once
// Normals in which the laws of cohesive faces see separations: those of the mesh at small strain, at finite strain ones
// that follow the body (cohesive_faces.h).

#include "physics/interfaces/interface_law.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/momentum/solution/momentum_solver.h"

#include <memory>

namespace pfdm {

/// A face between the cells P and N, with its unit normal n at rest, from P to N.
struct FaceSides {
  Index P = 0, N = 0;
  Vector n = Vector::Zero();
};

/// Normals at small strain.
class FaceNormals {
 public:
  FaceNormals() = default;
  virtual ~FaceNormals() = default;
  FaceNormals(const FaceNormals&) = delete;
  FaceNormals& operator=(const FaceNormals&) = delete;

  /// The unit normal at the displacements about which the balance is linearised.
  virtual Vector at(const FaceSides& face, const MomentumOperator&) const { return face.n; }
  /// Adds to the spring of a face how its traction turns with the normal, in the tangent.
  virtual void turn(const FaceSides&, const MomentumOperator&, const Vector&, const InterfaceResponse&,
                    FaceSpring&) const {}
};

std::unique_ptr<FaceNormals> make_face_normals(const FractureModel& model);

}  // namespace pfdm
