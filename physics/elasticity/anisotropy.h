#pragma once
// Linear elasticity that depends on the direction: stiffness matrices by engineering constants, along axes of their
// own.

#include "physics/elasticity/mandel.h"

#include <array>

namespace pfdm {

/// Constants of an orthotropic material in its axes 1, 2, 3: Young's moduli [Pa], Poisson's ratios, shear moduli [Pa].
/// nu12 is the contraction along 2 under a stress along 1.
struct OrthotropicConstants {
  double E1, E2, E3, nu12, nu13, nu23, G12, G13, G23;
};

/// Stiffness [Pa] along its axes. Throws InputError where the energy is not positive for every strain.
MandelMatrix orthotropic_stiffness(const OrthotropicConstants& c);

/// Stiffness of a cubic crystal by its constants [Pa]. Throws as orthotropic_stiffness().
MandelMatrix cubic_stiffness(double C11, double C12, double C44);

/// Stiffness by the 21 constants C_IJ [Pa] of Voigt's notation, rows of the upper triangle, in the order xx, yy, zz,
/// yz, xz, xy: sigma = C (eps_xx ... 2 eps_xy). Throws as orthotropic_stiffness().
MandelMatrix general_stiffness(const std::array<double, 21>& voigt);

/// The right-handed axes, as columns, of which the first two lie along `first` and, as far as it is normal to that,
/// `second`. Throws InputError where these are parallel or zero.
Tensor axes_along(const Vector& first, const Vector& second);

/// The stiffness in the frame in which its axes are the columns of `axes`.
MandelMatrix turned(const MandelMatrix& C, const Tensor& axes);

/// An elasticity that depends on the direction with what energy splits take from it.
struct AnisotropicElasticity {
  MandelMatrix stiffness;   ///< C [Pa]
  MandelMatrix root;        ///< C^(1/2), symmetric and positive [Pa^(1/2)]
  double bulk_modulus = 0;  ///< pressure over the volume that it takes away, 1/(I : C^-1 : I) [Pa]
};
/// Anisotropic elasticity by a stiffness C [Pa] with a positive energy.
AnisotropicElasticity anisotropic_elasticity(const MandelMatrix& C);

/// Strains (Mandel) of the unit vectors times n: columns sym(e_k (x) n), so that their transpose times a stress is its
/// traction on n.
Eigen::Matrix<double, 6, 3> strains_across(const Vector& n);

/// Whether strains within the plane normal to n, and across it, make no shear stress across it.
bool is_symmetric_about(const MandelMatrix& C, const Vector& n);

}  // namespace pfdm
