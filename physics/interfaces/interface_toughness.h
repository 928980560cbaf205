#pragma once
// The toughness that a crack in a thin band feels when the band's neighbours are tougher or cannot be damaged. The
// phase field's profile is wider than the band, so more than the band's own Gc is dissipated. For a crack at mid-band,
// fully developed and without elastic energy within the profile, each half minimises
//
//   (G/c0) int (alpha(d)/ell + ell d'^2) dx,  d = 1 at the crack, G ell d' continuous at the band's edge,
//
// with the first integral ell^2 d'^2 = alpha(d) + C in the band and C = 0 beyond it. For AT2 and equal sides this is
// G_app = G_i (G_b + G_i t)/(G_i + G_b t), t = tanh(b/ell) (the published form: Yoshioka et al., CMAME 384 (2021)
// 113951); an undamageable side is the limit G_b -> infinity.

#include "physics/damage/crack_geometry.h"

namespace pfdm {

/// Material beyond a band on one side.
struct BandNeighbour {
  double Gc = 0.0;  ///< [J/m^2]; infinite where nothing can be damaged
};

/// The dissipation of a crack at the middle of a band of toughness Gc [J/m^2] and the given width [m]; all with the
/// same ell [m].
double apparent_toughness(const CrackGeometry& crack, double Gc, double width, double ell, BandNeighbour one,
                          BandNeighbour other);

/// The Gc of the band [J/m^2] with which a crack in it dissipates `wanted`.
double band_toughness(const CrackGeometry& crack, double wanted, double width, double ell, BandNeighbour one,
                      BandNeighbour other);

}  // namespace pfdm
