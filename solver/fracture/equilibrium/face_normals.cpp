#include "solver/fracture/equilibrium/face_normals.h"

#include "physics/elasticity/gradient_stress.h"
#include "solver/momentum/finite_strain/finite_tractions.h"

#include <utility>

namespace pfdm {
namespace {

// w x v = across(n, v) dn, where n turns by dn = w x n.
Tensor across(const Vector& n, const Vector& v) { return n.dot(v) * Tensor::Identity() - n * v.transpose(); }

// Derivative of c/|c| by c.
Tensor by_length(const Vector& c) {
  const Vector n = c.normalized();
  return (Tensor::Identity() - n * n.transpose()) / c.norm();
}

/// At finite strain: the mean of the unit normals of both sides.
class TurningNormals final : public FaceNormals {
 public:
  Vector at(const FaceSides& face, const MomentumOperator& balance) const override {
    const auto [c_P, c_N] = turned(face, balance);
    return (c_P.normalized() + c_N.normalized()).normalized();
  }

  // The law is isotropic: if its normal alone turns by w, its traction changes by w x T - K (w x delta).
  void turn(const FaceSides& face, const MomentumOperator& balance, const Vector& separation,
            const InterfaceResponse& at, FaceSpring& spring) const override {
    const auto [c_P, c_N] = turned(face, balance);
    const Vector sum = c_P.normalized() + c_N.normalized(), n = sum.normalized();
    const Tensor by_sum = (across(n, at.traction) - at.tangent * across(n, separation)) * by_length(sum);
    spring.turn_P = by_sum * by_length(c_P);
    spring.turn_N = by_sum * by_length(c_N);
    const auto change = [&](Index cell) {
      const Tensor& F = balance.finite()->states().deformation()[cell];
      return (cofactor_change(F, F - Tensor::Identity()) * face.n).eval();
    };
    spring.offset -= spring.turn_P * change(face.P) + spring.turn_N * change(face.N);
  }

 private:
  // cof F n of either side.
  static std::pair<Vector, Vector> turned(const FaceSides& face, const MomentumOperator& balance) {
    const CellField<Tensor>& cofactors = balance.finite()->states().cofactors();
    return {cofactors[face.P] * face.n, cofactors[face.N] * face.n};
  }
};

}  // namespace

std::unique_ptr<FaceNormals> make_face_normals(const FractureModel& model) {
  if (model.is_finite_strain()) return std::make_unique<TurningNormals>();
  return std::make_unique<FaceNormals>();
}

}  // namespace pfdm
