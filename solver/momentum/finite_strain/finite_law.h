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
  /// Volumetric law of cells with a pressure, else null: J by the pressure q, with the fraction of its modulus that is
  /// left.
  const HyperelasticMaterial* pressure = nullptr;
  double pressure_share = 1.0;
  double pressure_modulus = 0.0;  ///< of it, undamaged, that a change of volume meets in the step [Pa]
  double pressure_kept = 0.0;     ///< what a closed crack keeps beyond its share [Pa]
  double pressure_left = 0.0;     ///< of q: minus what it is at J = 1 by earlier changes [Pa]; of viscoelastic cells
  double free_change = 0.0;       ///< of their volume, J* - 1 of the free deformation F*
  double sound_share = 1.0;       ///< mu of the undamaged faces, with F* and branches, over that of the elasticity
  /// What gaps meet of the branches of a viscoelastic cell (finite_memory.h).
  struct Memory {
    double share = 0.0;   ///< of their stress that is left by damage; 0: there are none
    double lambda = 0.0;  ///< over mu, of the shear branches
    double bulk = 0.0;    ///< share of the bulk branches
  } memory{};

  VolumeAt volume(double q) const {
    const VolumeAt elastic =
        pressure->volume(q + pressure_share * pressure_left, pressure_share * pressure_modulus + pressure_kept);
    const double free = 1.0 + free_change;
    return {free_change + free * elastic.change, free * elastic.slope};
  }
};

/// Law of a cell at its displacement gradient H, or at that of one of its sides: number `own` of those that have a
/// gradient of their own (FiniteStates::own), -1: the cell's.
using FiniteLawAt = std::function<FiniteLaw(Index cell, Index own, const Tensor& H)>;

}  // namespace pfdm
