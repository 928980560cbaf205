#pragma once
// Relaxation times that depend on the temperature, of thermorheologically simple materials: those of all branches by
// one factor, tau(T) = a_T tau(T_ref) (Ferry, Viscoelastic Properties of Polymers, 1980, ch. 11). A step of the
// duration dt at T is one of dt/a_T at T_ref.

namespace pfdm {

struct TemperatureShift {
  enum class Law {
    wlf,       ///< log10 a_T = -c1 (T - T_ref)/(c2 + T - T_ref) (Williams, Landel, Ferry, JACS 77 (1955) 3701, eq. 11)
    arrhenius  ///< ln a_T = E_a/R (1/T - 1/T_ref)
  };
  Law law = Law::wlf;
  double reference = 0.0;          ///< T_ref [K]
  double c1 = 0.0, c2 = 0.0;       ///< of "wlf": a number, and a difference [K]
  double activation_energy = 0.0;  ///< E_a of "arrhenius" [J/mol]

  /// a_T at a temperature [K]; infinite where the law has no times any more (least_temperature).
  double factor(double temperature) const;
  /// The temperature above which the law holds [K].
  double least_temperature() const { return law == Law::wlf ? reference - c2 : 0.0; }
};

}  // namespace pfdm
