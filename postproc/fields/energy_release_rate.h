#pragma once
// The energy release rate of a crack from the fields around its tip: the J-integral (Rice, J. Appl. Mech. 35 (1968)
// 379) in its domain form, called G-theta (Destuynder, Djaoua, Math. Methods Appl. Sci. 3 (1981) 70; Li, Shih,
// Needleman, Eng. Fract. Mech. 21 (1985) 405),
//
//   G = (1/B) int sigma : (grad u grad theta) - (1/2) sigma : grad u  div theta  dV,   theta = q(x) e,
//
// e the direction in which the crack grows, q = 1 within an inner distance of the tip, falling linearly to 0 at an
// outer one, B the extent of the body along the crack front. Only the elastic part of the Eshelby tensor takes part:
// what is measured is the energy that flows into the tip region from the far field, if the ring between the distances
// lies in sound material but for the crack's wake, which carries nothing. At finite strain the first Piola-Kirchhoff
// stress and the energy per reference volume take their places, distances are those of the reference mesh, and G is per
// reference area.
//
// About an axis the front is a circle, or the crack grows along the axis: theta = q e with e turning about it, whose
// gradient has the part (q/r) e_t e_t of a radial e as well, and B is the width of the sector at the tip. Places are
// those of the half-plane y = 0, x > 0, x the radius.
//
// The ratio of the stress intensities of both modes by the interaction integral (Yau, Wang, Corten, J. Appl. Mech. 47
// (1980) 335; of a crack between two materials Matos et al., Int. J. Fract. 40 (1989) 235): the mixed part of G of the
// body's field and of the near field with K1 = 1, and with K2 = 1. Their size is that of G, K1^2 + K2^2 = H G: the
// near field of a discrete crack is that of a tip some tenths of a cell ahead, so that the integrals about the given
// tip also collect the next terms of the body's field, to the first power of the cells' size. G does not.

#include "physics/interfaces/interface_crack.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"

#include "mesh/mesh.h"

#include <span>
#include <string>
#include <string_view>

namespace pfdm {

/// How the distance from the tip is measured, in the plane across the front.
struct RegionShape {
  std::string_view name;
  std::string_view description;
  /// Of a place at `along` ahead of the tip and `across` beside it [m].
  double (*distance)(double along, double across);
};
std::span<const RegionShape> region_shapes();

/// The region around a crack tip.
struct TipRegion {
  std::string name;
  Vector point = Vector::Zero();       ///< the tip, or where it is at first [m]
  Vector direction = Vector::UnitX();  ///< of growth, unit length
  Vector front = Vector::UnitZ();      ///< along the crack front, unit length, across the direction
  const RegionShape* shape = nullptr;
  double inner = 0.0, outer = 0.0;  ///< distances [m]
  bool follows = false;             ///< the tip is the foremost place with d >= tip_damage, from `point` on
  double tip_damage = 0.9;
  double corridor =
      std::numeric_limits<double>::infinity();  ///< beside the line from `point` [m]; damage beyond is no tip
  bool is_about_axis = false;                   ///< of a sector about the axis z: front is y or -y, direction across it
  double reference_length = 0.0;                ///< of the stress intensities [m]; 0: they are not asked for
};

/// Throws InputError if the ring, where the crack begins, has no part in the mesh.
void require_ring(const Mesh& mesh, const TipRegion& region);

/// The foremost place along the region's direction where the damage passes the threshold, between cell centres; the
/// region's point where no damage lies ahead of it.
Vector crack_tip(const Mesh& mesh, const CellField<double>& damage, const TipRegion& region);

struct EnergyRelease {
  Vector tip = Vector::Zero();  ///< [m]
  double G = 0.0;               ///< [J/m^2]; NaN where the ring leaves the body across the direction of growth
  /// Share of the integrand's magnitude that comes from cells with d > 0.1: the value is the far field's if it is
  /// small.
  double damaged_share = 0.0;
};

EnergyRelease energy_release_rate(const Mesh& mesh, const OutputFields& output, const TipRegion& region);

/// At the region's reference length; see physics/interfaces/interface_crack.h. A crack in a plane of symmetry, with
/// half of the body beside it, has that of the whole body. All NaN where G is, and where there are none.
struct StressIntensity {
  double K1 = 0.0, K2 = 0.0;  ///< [Pa m^1/2]
  double phase_angle = 0.0;   ///< atan2(K2, K1) [radian]
  std::string_view why_none;  ///< why they are NaN, for messages; empty where G is, and where they are not
};

StressIntensity stress_intensity(const Mesh& mesh, const FractureModel& model, const OutputFields& output,
                                 const TipRegion& region);

}  // namespace pfdm
