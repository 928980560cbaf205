#pragma once
// Share of the load that the residual stiffness k of broken cells carries. At a prescribed load the elastic energy E of
// the body changes by dE/dk = int (1 - g) psi_plus dV, as all else is stationary. So R = k dE/dk is the part of E that
// is there only because k is not zero, and R/E that part of the force.

#include <string>

namespace pfdm {

/// Energies of an equilibrium [J].
struct ResidualShare {
  double elastic = 0.0;        ///< E
  double residual = 0.0;       ///< R
  double traction_work = 0.0;  ///< prescribed tractions times displacements; together with the work of
                               ///< prescribed displacements it is 2 E
};

/// Whether the residual stiffness has nearly all of the energy.
bool holds_all(double residual, double elastic);
/// Whether dead loads are carried by the residual stiffness alone: the body has separated, and its displacements are
/// proportional to 1/k.
bool has_collapsed(const ResidualShare& share);

/// Watches for a residual stiffness that distorts the forces.
class ResidualStiffness {
 public:
  /// `is_proportional`: loads rise in proportion to their parameter; else energies are compared as they are, as of
  /// cycles of load.
  explicit ResidualStiffness(double k, bool is_proportional = true) : k_(k), is_proportional_(is_proportional) {}

  /// The warning after a step at this load parameter; empty if there is none, and once it has been given.
  /// `energy_before` [J]: energy that the body had or was given before it broke, as a step may pass the peak and a
  /// restart comes after it. It is the larger of the elastic energy that the step began with and of the work so far.
  std::string remark(const ResidualShare& share, double energy_before, double load);

 private:
  double k_;
  bool is_proportional_;
  double largest_ = 0.0;  // of E so far; at loads that rise in proportion of E over the load, half the force
  bool said_ = false;
};

}  // namespace pfdm
