// Formulas of bending errors, as measured with cantilevers (bending.md).

#include "solver/momentum/bending/bending_layers.h"

#include <algorithm>
#include <cmath>

namespace pfdm {

double plate_modulus(const IsotropicElasticity& of) {
  const double nu = of.poisson_ratio();
  return of.young_modulus() / (1.0 - nu * nu);
}

DirectedStrip::DirectedStrip(const MandelMatrix& C, const Vector& along, const Vector& across) {
  Eigen::Matrix<double, 6, 3> strains;
  strains << to_mandel(along * along.transpose()), to_mandel(across * across.transpose()),
      to_mandel(symmetric_part(along * across.transpose()));
  const Tensor within = strains.transpose() * C * strains;
  modulus = 1.0 / within.inverse()(0, 0);
  shear_held = within(2, 2);
  shear_stiffness = shear_held - within(0, 2) * within(0, 2) / within(0, 0);
  shear_by_strain = within.bottomRightCorner<2, 2>().inverse().row(1).dot(within.col(0).tail<2>());
}

double poisson_share(double nu) {
  const double at_most = std::clamp(nu, 0.0, 0.45);
  return at_most * at_most / ((1.0 - at_most) * (1.0 - 2.0 * at_most));
}

double BendingLayers::excess_of_stack(double nu) const {
  return 1.5 * (1.0 - nu) * length * length / (stack.even_thickness * stack.even_thickness);
}

double BendingLayers::excess_of_one_ring(double nu) const {
  const double x = excess_of_stack(nu);
  return x / (1.0 + 0.13 * x * std::sqrt(x));
}

double BendingLayers::lack_of_one_ring(double nu) const {
  const double even = stack.even_layers();
  const double poisson = even > 1.5 ? 0.6 * poisson_share(nu) * (2.0 - 3.0 / even) : 0.0;
  const double left_out = std::max(1.0, 3.0 - 2.0 / even) - poisson;
  return left_out * (stack.layers - stack.lone) + stack.lone;
}

double BendingLayers::error_of_one_ring(double nu, bool is_about_axis) const {
  const double excess = excess_of_one_ring(nu), lack = lack_of_one_ring(nu);
  if (!is_about_axis) return excess - lack;
  return excess > lack ? excess : -lack;
}

double BendingLayers::excess_of_lines(double nu) const {
  const double at_most = std::min(nu, 0.45);
  const double by_length = std::pow(std::max(0.0, length / thickness - 1.0), 1.3);
  if (shear > 0.0) return 0.11 * by_length * std::sqrt(shear);
  return 0.05 * by_length * std::sqrt((1.0 - at_most) / (1.0 - 2.0 * at_most));
}

double BendingLayers::excess_of_uneven() const {
  const double d = std::max(0.0, stack.layers - 1.0 / (n * n));
  const bool is_even_in_stiffness = stack.n_materials == 1 && shear == 0.0 && turn.range == 0.0;
  return is_even_in_stiffness && n > 2.5 ? d / (1.0 + 6.0 * d) : 0.0;
}

double BendingLayers::error_of_turn() const {
  return std::max(turn.error(), turn.error_of_long(length / thickness, shear));
}

double BendingLayers::error_of_lines(double nu) const {
  const double excess = std::max(excess_of_lines(nu), excess_of_uneven()), lack = lack_of_lines();
  if (const double by_turn = error_of_turn(); by_turn > excess + lack) return by_turn;
  return excess > lack ? excess + lack : -excess - lack;
}

double BendingLayers::excess_of_cubics() const {
  const double c = stack.n_materials > 1 ? 0.005 + 0.014 * stack.of_pairs : (n < 2.5 ? 0.019 : 0.0);
  return c * std::pow(length / thickness, 3) * thickness / stack.even_thickness;
}

double BendingLayers::lack_of_cubics() const {
  return 0.9 * stack.lone * (1.0 + 0.12 * length * length / (thickness * thickness));
}

double BendingLayers::error_of_cubics(bool are_long) const {
  const double excess = are_long ? excess_of_cubics() : 0.0, lack = lack_of_cubics();
  return excess > lack ? excess : -lack;
}

}  // namespace pfdm
