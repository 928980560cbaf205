#pragma once
// Where surfaces around particles have come off, in words: their poles lie along the load and against it.

#include "cases/program/fracture/outcome/curve_units.h"

#include <filesystem>
#include <optional>
#include <string>

namespace pfdm {

/// "lower pole", "upper pole" where `axis` points up, along z, and else "pole along the load", "pole against the load".
std::string name_of_pole(bool along, const Vector& axis);

/// The pole near which places with polar angles from and to [rad] begin; none where they reach neither.
std::optional<std::string> pole_of(double polar_from, double polar_to, const Vector& axis);

/// "\"interface\" debonds at its upper pole between 449.6 and 452 um, where the force goes from 22.22 to 21.7 N, and
/// the debonding angle from 26 to 84 degrees; at the end 99.6 % of it has debonded", of the surface of this name, by
/// debonding.csv and cohesive.json in `results`. The pole is the one that debonds later; its greatest step is named
/// where that is 15 degrees or more. "debonds at both poles in one step, between 449.6 and 452 um, where the force goes
/// from 22.22 to 21.7 N" where neither is later. Empty without these files, and for a surface without an area.
std::string rest_of_debonding(const std::string& surface, const Vector& axis, const CurveUnits& units,
                              const std::filesystem::path& results);

}  // namespace pfdm
