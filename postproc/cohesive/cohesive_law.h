#pragma once
// Traction against separation from the record of a run's columns: averaged over places, with the figures that one asks
// for, and how far the surface has debonded. Places that were never damaged have no law: their separation is zero but
// for the error of discretisation.

#include "postproc/cohesive/column_record.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// Damage above which a column counts as debonded.
constexpr double debonded_damage = 0.95;

/// Share of the toughness beyond which a face of a cohesive interface counts as debonded: what a crack of AT2 with
/// debonded_damage at its middle has dissipated, d^2, so that both mean the same state.
constexpr double debonded_share = debonded_damage * debonded_damage;

/// Damage up to which a column counts as sound: it adds less to the separation than columns resolve, about 1.5 % of
/// the elastic elongation.
constexpr double sound_damage = 0.01;

/// Whether the place was ever damaged beyond sound_damage.
bool was_damaged(const ColumnRecord& record, std::size_t place);
/// How many places of the record never were.
std::size_t n_never_damaged(const ColumnRecord& record);

/// States of one place, or means of several, one for each load step.
struct CohesiveLaw {
  double from = 0.0, to = 0.0;  ///< polar angles of the places [rad]
  std::vector<std::size_t> places;
  double area = 0.0;                 ///< that the places stand for [m^2]
  std::vector<ColumnSample> states;  ///< on a plane the bulk is taken off the separation
};

/// Of one place.
CohesiveLaw law_at_place(const ColumnRecord& record, std::size_t place);
/// Means weighted by area over the places with polar angles [from, to) [rad], pi itself included, that were damaged;
/// without places and states if there are none.
CohesiveLaw law_between(const ColumnRecord& record, double from, double to);
/// Of an interface: in bins of 15 degrees. Of a plane: of all its places. Laws without places are left out.
std::vector<CohesiveLaw> averaged_laws(const ColumnRecord& record);

/// NaN where the law has none.
struct CohesiveFigures {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double strength = none;             ///< largest normal traction [Pa]
  double critical_separation = none;  ///< where it acts [m]
  double final_separation = none;     ///< largest normal separation of the record [m]
  double initial_stiffness = none;    ///< secant at half the strength [Pa/m]; none for a rigid rise
  double normal_energy = none;  ///< int T_n d delta_n over the record, mean of the places' [J/m^2]; none with a jump
  double tangential_energy = none;   ///< int T_t . d delta_t likewise
  double energy_at_least = 0.0;      ///< of both, with nothing but the later traction across jumps [J/m^2]
  double surface_energy = 0.0;       ///< line integral over the column at the end [J/m^2]
  double mixity_at_strength = none;  ///< atan(|T_t| / T_n) at the strength [rad]
  double largest_tangential = 0.0;   ///< |T_t| [Pa]
  double final_traction = 0.0;       ///< normal [Pa]
  double bulk_separation = 0.0;      ///< at the strength, of the bulk: taken off on a plane [m]
  bool unloaded = false;             ///< at the end less open than at the strength
  /// The step across which the traction falls by more than half the strength while the separation's magnitude grows.
  std::optional<std::size_t> jump;
  /// The law is known down to a tenth of its strength.
  bool is_traced() const { return !jump && !unloaded && final_traction < 0.1 * strength; }
};

/// Of a law of the record.
CohesiveFigures figures_of(const ColumnRecord& record, const CohesiveLaw& law);

/// How far a surface has debonded at a load step.
struct Debonding {
  double area = 0.0;         ///< of the columns beyond debonded_damage, of the faces beyond debonded_share [m^2]
  double angle_plus = 0.0;   ///< polar angle of the cap of that area about the pole along the axis [rad]; on planes 0
  double angle_minus = 0.0;  ///< likewise about the other pole
};

/// Polar angle of a cap of the area `cap` on a sphere of the area `whole` [rad].
double cap_angle(double cap, double whole);

std::vector<Debonding> debonding_of(const ColumnRecord& record);

}  // namespace pfdm
