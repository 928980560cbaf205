#pragma once
// Materials of small strain whose elastic strain is eps - eps_inelastic: a law says how its inelastic strain and the
// energy that it locks up evolve; stresses by Mandel vectors.

#include "physics/elasticity/mandel.h"
#include "physics/materials/material.h"

namespace pfdm {

/// C as the tangent by displacement gradients, and back: the part with minor symmetries.
GradientTangent by_gradient(const MandelMatrix& C);
MandelMatrix by_strain(const GradientTangent& A);

class SmallStrainMaterial : public Material {
 public:
  using Material::Material;

  MaterialResponse update(const MaterialStep& step, std::span<double> history) const final;
  Tensor stress(const Tensor& H, std::span<const double> history) const final;
  /// The energy that is locked up drives damage too, and no split keeps it: shear makes it. A split that is not
  /// variational has a driving energy of its own.
  MaterialEnergy energy(const Tensor& H, std::span<const double> history, const EnergySplit& split) const override;
  double left_by_flow(const MaterialStep& step, std::span<const double> history) const final;

 protected:
  struct Step {
    Mandel from, to;                  ///< total strain [-]
    double duration;                  ///< [s]
    std::span<const double> history;  ///< at the start
  };
  struct Response {
    Mandel stress;         ///< [Pa]
    MandelMatrix tangent;  ///< consistent with the step [Pa]
    bool solved = true;
  };
  virtual Response update_strain(const Step& step, std::span<double> history) const = 0;

  struct Inelastic {
    Mandel strain;            ///< [-]
    double locked = 0.0;      ///< [J/m^3]
    double dissipated = 0.0;  ///< [J/m^3]
  };
  virtual Inelastic inelastic(std::span<const double> history) const = 0;
  /// Norm of the deviatoric stress, less back stresses, at which a law that flows does so [Pa]; `rate` of its flow
  /// [1/s].
  virtual double flow_stress(std::span<const double> /*history*/, double /*rate*/) const { return 0.0; }
};

}  // namespace pfdm
