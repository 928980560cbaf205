#pragma once
// What laws of a record and laws that are given have in common when they are exported: the penalty stiffness and the
// tables (exported_law.h).

#include "postproc/exports/law/exported_law.h"

#include <span>
#include <vector>

namespace pfdm {

inline constexpr double least_drop = 1e-3;  ///< part of the separation within which a cut law falls to zero

/// Of the straight beginning of the states [m/Pa]; zero for a rigid rise.
double own_compliance(std::span<const TractionPoint> states, double strength);

/// K of a law whose strength and energy are known, by the rule or as chosen. Throws InputError if it is too soft.
Figure stiffness_of(const ExportedLaw& law, double compliance, const ExportChoice& choice);

/// Stiffness in shear of a law whose strengths, stiffness and mix of the modes are known: b^2 K of one energy, else K.
Figure shear_stiffness_of(const ExportedLaw& law);

/// The states with the penalty stiffness in series, and to zero traction at their end: at once where the law is known
/// to its end, else along a line of the energy that is missing.
std::vector<TractionPoint> whole_curve(std::span<const TractionPoint> states, bool is_complete, const ExportedLaw& law,
                                       double compliance);

/// T-delta and D-delta of the whole curve, and how far they are from it.
void add_tables(ExportedLaw& law, const std::vector<TractionPoint>& whole);

}  // namespace pfdm
