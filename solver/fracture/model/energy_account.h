#pragma once
// The energies of a fracture run. One more is a member, a row of the table, and the place where it is computed: the
// checkpoint, the curve, the summary, the energy balance and the report visit the table.

#include <string_view>

namespace pfdm {

/// Energies at a step; external work and dissipated energies since the start. [J]
struct EnergyAccount {
  double elastic = 0.0;
  double fracture = 0.0;  ///< surface energy
  double external_work = 0.0;
  double viscous_dissipation = 0.0;            ///< by the viscosity of the damage equation
  double plastic_dissipation = 0.0;            ///< by materials with a history
  double interface_energy = 0.0;               ///< stored in cohesive interfaces
  double interface_dissipation = 0.0;          ///< by decohesion and friction of cohesive interfaces
  double strength_dissipation = 0.0;           ///< by the driving force of a strength model; negative in tension
  double eigenstrain_work = 0.0;               ///< supplied by eigenstrains, as by heating a bar that is held
  double interface_viscous_dissipation = 0.0;  ///< by the rate of cohesive interfaces and branches
  double stored() const { return elastic + interface_energy; }
  friend bool operator==(const EnergyAccount&, const EnergyAccount&) = default;
};

struct EnergyEntry {
  enum class Role { stored, surface, supplied, dissipated };
  double EnergyAccount::*value;
  Role role;
  std::string_view column;  ///< of force_displacement.csv, less its unit
  std::string_view figure;  ///< of summary.json, less its unit
  std::string_view label;   ///< in reports
};

/// Table of the energies, in the order of the columns: the first three stand together in force_displacement.csv, the
/// others at its end.
inline constexpr EnergyEntry energy_entries[] = {
    {&EnergyAccount::elastic, EnergyEntry::Role::stored, "elastic_energy", "final_elastic_energy", "elastic energy"},
    {&EnergyAccount::fracture, EnergyEntry::Role::surface, "fracture_energy", "final_fracture_energy",
     "surface energy"},
    {&EnergyAccount::external_work, EnergyEntry::Role::supplied, "external_work", "external_work", "work"},
    {&EnergyAccount::viscous_dissipation, EnergyEntry::Role::dissipated, "viscous_dissipation", "viscous_dissipation",
     "dissipated by viscosity"},
    {&EnergyAccount::plastic_dissipation, EnergyEntry::Role::dissipated, "plastic_dissipation", "plastic_dissipation",
     "dissipated plastically"},
    {&EnergyAccount::interface_energy, EnergyEntry::Role::stored, "interface_energy", "final_interface_energy",
     "stored in interfaces"},
    {&EnergyAccount::interface_dissipation, EnergyEntry::Role::dissipated, "interface_dissipation",
     "interface_dissipation", "dissipated by interfaces"},
    {&EnergyAccount::strength_dissipation, EnergyEntry::Role::dissipated, "strength_dissipation",
     "strength_dissipation", "dissipated by the strength's driving force"},
    {&EnergyAccount::eigenstrain_work, EnergyEntry::Role::supplied, "eigenstrain_work", "eigenstrain_work",
     "work of eigenstrains"},
    {&EnergyAccount::interface_viscous_dissipation, EnergyEntry::Role::dissipated, "interface_viscous_dissipation",
     "interface_viscous_dissipation", "dissipated by the rate of interfaces"},
};

/// The work that is neither stored nor dissipated, nor in the surface energy gained since `start`, where there may be
/// cracks already.
inline double left_over(const EnergyAccount& start, const EnergyAccount& now) {
  double sum = 0.0;
  for (const EnergyEntry& entry : energy_entries) {
    if (entry.role == EnergyEntry::Role::supplied)
      sum += now.*entry.value;
    else if (entry.role == EnergyEntry::Role::surface)
      sum -= now.*entry.value - start.*entry.value;
    else
      sum -= now.*entry.value;
  }
  return sum;
}

/// The work of forces and of eigenstrains.
inline double supplied(const EnergyAccount& account) {
  double sum = 0.0;
  for (const EnergyEntry& entry : energy_entries)
    if (entry.role == EnergyEntry::Role::supplied) sum += account.*entry.value;
  return sum;
}

/// All dissipation besides the surface energy.
inline double dissipated(const EnergyAccount& account) {
  double sum = 0.0;
  for (const EnergyEntry& entry : energy_entries)
    if (entry.role == EnergyEntry::Role::dissipated) sum += account.*entry.value;
  return sum;
}

}  // namespace pfdm
