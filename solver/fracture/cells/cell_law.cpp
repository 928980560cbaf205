#include "solver/fracture/cells/cell_law.h"

#include <stdexcept>
#include <utility>

namespace pfdm {
namespace {

// Splits with isotropic secant moduli.
class SecantLaw final : public CellLaw {
 public:
  SecantLaw(const IsotropicElasticity& elasticity, const EnergySplit& split) : elasticity_(elasticity), split_(split) {}
  bool has_secant() const override { return true; }
  IsotropicElasticity secant(double g, double closure) const override { return split_.secant(elasticity_, g, closure); }
  double closure(const Tensor& strain) const override { return split_.closure(strain); }
  bool depends_on_strain() const override {
    constexpr double g = 0.5;
    return secant(g, 0.0) != secant(g, 1.0);
  }
  MandelMatrix tangent(const Tensor&, double g, double closure) const override {
    return stiffness_matrix(secant(g, closure));
  }
  Tensor degradable_stress(const Tensor&) const override { return Tensor::Zero(); }
  IsotropicElasticity degradable_part(double closure) const override {
    return degradable_part_of(split_, elasticity_, closure);
  }
  double driving_energy(const Tensor& strain) const override { return split_.energy(elasticity_, strain).psi_plus; }

 private:
  IsotropicElasticity elasticity_;
  EnergySplit split_;
};

// Splits in principal strains.
class PrincipalLaw final : public CellLaw {
 public:
  PrincipalLaw(const IsotropicElasticity& elasticity, const EnergySplit& split)
      : elasticity_(elasticity), split_(split) {}
  MandelMatrix tangent(const Tensor& strain, double g, double) const override {
    return degraded_tangent(split_, elasticity_, g, strain);
  }
  Tensor degradable_stress(const Tensor& strain) const override {
    return pfdm::degradable_stress(split_, elasticity_, strain);
  }
  double driving_energy(const Tensor& strain) const override { return split_.energy(elasticity_, strain).psi_plus; }

 private:
  IsotropicElasticity elasticity_;
  EnergySplit split_;
};

// Elasticity that depends on the direction.
class DirectedLaw final : public CellLaw {
 public:
  DirectedLaw(const MandelMatrix& stiffness, const EnergySplit& split)
      : elasticity_(anisotropic_elasticity(stiffness)), split_(split) {}
  MandelMatrix tangent(const Tensor& strain, double g, double) const override {
    return degraded_tangent(split_, elasticity_, g, strain);
  }
  Tensor degradable_stress(const Tensor& strain) const override {
    return pfdm::degradable_stress(split_, elasticity_, strain);
  }
  double driving_energy(const Tensor& strain) const override {
    const Mandel eps = to_mandel(strain);
    return 0.5 * eps.dot(elasticity_.stiffness * eps);
  }

 private:
  AnisotropicElasticity elasticity_;
  EnergySplit split_;
};

}  // namespace

IsotropicElasticity CellLaw::secant(double, double) const {
  throw std::logic_error("secant moduli of a law without them");
}

double CellLaw::closure(const Tensor&) const { throw std::logic_error("closure of a law without secant moduli"); }

IsotropicElasticity degradable_part_of(const EnergySplit& split, const IsotropicElasticity& elasticity,
                                       double closure) {
  const IsotropicElasticity whole = split.secant(elasticity, 1.0, closure),
                            kept = split.secant(elasticity, 0.0, closure);
  return {.lambda = whole.lambda - kept.lambda, .mu = whole.mu - kept.mu};
}

std::unique_ptr<const CellLaw> make_cell_law(const FractureModel& model, const RegionModel& region) {
  const EnergySplit& split = model.split_of(region);
  if (region.stiffness) return std::make_unique<DirectedLaw>(*region.stiffness, split);
  if (split.has_secant()) return std::make_unique<SecantLaw>(region.elasticity, split);
  return std::make_unique<PrincipalLaw>(region.elasticity, split);
}

}  // namespace pfdm
