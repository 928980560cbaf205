#include "physics/materials/potential.h"

#include <cmath>

namespace pfdm {
namespace {

using GreenSlope = Eigen::Matrix<double, 6, 9>;

// dE/dH = sym(F^T dH).
GreenSlope green_slope(const Tensor& F) {
  GreenSlope slope;
  for (Index k = 0; k < 3; ++k)
    for (Index L = 0; L < 3; ++L)
      slope.col(3 * k + L) = to_mandel(symmetric_part(F.row(k).transpose() * Vector::Unit(L).transpose()));
  return slope;
}

}  // namespace

PotentialAt by_gradient(double energy, const Tensor& F, const Mandel& S, const MandelMatrix& C) {
  const GreenSlope slope = green_slope(F);
  const Tensor stress = to_tensor(S);
  PotentialAt result{.energy = energy, .stress = F * stress, .tangent = slope.transpose() * C * slope};
  for (Index i = 0; i < 3; ++i) result.tangent.block<3, 3>(3 * i, 3 * i) += stress;
  return result;
}

PotentialAt by_volume(const Tensor& F, const OfVolume& f) {
  const Tensor cof = cofactor(F);
  const Components normal = to_components(cof);
  PotentialAt result{.energy = f.value, .stress = f.slope * cof, .tangent = f.curvature * normal * normal.transpose()};
  for (Index k = 0; k < 3; ++k)
    for (Index L = 0; L < 3; ++L)
      result.tangent.col(3 * k + L) +=
          f.slope * to_components(cofactor_change(F, Vector::Unit(k) * Vector::Unit(L).transpose()));
  return result;
}

OfVolume volume_energy(VolumetricForm form, double change) {
  if (form == VolumetricForm::quadratic) return {0.5 * change * change, change, 1.0};
  const double J = 1.0 + change, square = change * (2.0 + change);  // J^2 - 1
  return {0.25 * (square - 2.0 * std::log1p(change)), 0.5 * square / J, 0.5 * (1.0 + 1.0 / (J * J))};
}

OfVolume extended_volume_energy(VolumetricForm form, double change) {
  return extended(change, [form](double at) { return volume_energy(form, at); });
}

}  // namespace pfdm
