#pragma once
// Crack geometric functions alpha(d) of the surface energy (Gc/c0) (alpha(d)/ell + ell |grad d|^2),
// c0 = 4 int_0^1 sqrt(alpha) dd (Wu, J. Mech. Phys. Solids 103 (2017) 72, eq. 2.8).
//
// The report's own variable is c = 1 - d and its length l0 = ell/2: with AT2 the functional above is
// Gc/(4 l0) ((1-c)^2 + 4 l0^2 |grad c|^2) (Borden et al., CMAME 217 (2012) 77, eq. 9).

#include <span>
#include <string_view>

namespace pfdm {

struct CrackGeometry {
  std::string_view name;
  std::string_view description;
  double c0;                        ///< [-]
  double (*alpha)(double d);        ///< alpha(0) = 0, alpha(1) = 1
  double (*alpha_prime)(double d);  ///< d alpha / d d
  double (*alpha_second)(double d);
  double support;  ///< half-width of a broken bar's profile over ell; infinite for AT2
};

std::span<const CrackGeometry> crack_geometries();
/// Throws InputError naming those there are.
const CrackGeometry& crack_geometry(std::string_view name);

/// The part of a crack's surface energy that lies farther than `distance` from its middle, over ell; of a broken bar.
double energy_beyond(const CrackGeometry& crack, double distance);

}  // namespace pfdm
