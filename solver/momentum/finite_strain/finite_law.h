#pragma once
// The law of a cell at finite strain, linearised, as the momentum balance takes it.

#include "physics/elasticity/gradient_stress.h"
#include "physics/materials/hyperelastic.h"

#include <functional>

namespace pfdm {

struct FiniteLaw {
  Tensor stress = Tensor::Zero();               ///< P at the gradient H, without that of a pressure [Pa]
  GradientTangent A = GradientTangent::Zero();  ///< dP/dH there [Pa]
  /// Moduli of the faces (finite_tractions.h).
  IsotropicElasticity face;
  double swelling = 1.0;  ///< factor of mu/J^2 in their stiffness: 0 of a law that is linear in F
  /// Volumetric law of cells with a pressure, else null: J by the pressure q, with the fractions of its modulus that
  /// are left where q > 0 and where q < 0.
  const HyperelasticMaterial* pressure = nullptr;
  double open = 1.0, closed = 1.0;
  double free_change = 0.0;  ///< of their volume, J* - 1 of the free deformation F*
  double free_share = 1.0;   ///< mu of the faces with F* over that without

  VolumeAt volume(double q) const {
    const VolumeAt elastic = pressure->volume(q, q > 0.0 ? open : closed);
    const double free = 1.0 + free_change;
    return {free_change + free * elastic.change, free * elastic.slope};
  }
};

/// Law of a cell at its displacement gradient H.
using FiniteLawAt = std::function<FiniteLaw(Index cell, const Tensor& H)>;

}  // namespace pfdm
