#pragma once
// Where a crack begins to grow, by the record alone.

#include "postproc/reduction/test_record.h"

#include <optional>

namespace pfdm {

/// Of the greatest force: between which the record is straight.
inline constexpr double straight_from = 0.1, straight_to = 0.5;

/// The straight part of a record: from 10 to 50 % of the greatest force, on the way to it.
struct StraightPart {
  double compliance = not_given;    ///< C0 [m/N]
  double origin = not_given;        ///< displacement at zero force [m]; 0 in a ReducedTest
  double origin_error = not_given;  ///< its standard error by the scatter about the line [m]
  double greatest_force = not_given;
  std::size_t row_of_greatest = 0;
  std::size_t end = 0;       ///< the row after its last
  std::size_t n_points = 0;  ///< rows of it

  /// Displacement along it from its origin to the greatest force [m].
  double reach() const { return compliance * greatest_force; }
};
/// Throws InputError where fewer than three rows lie there, or the force does not rise.
StraightPart straight_part(const TestRecord& record);

/// Points of initiation (ASTM D5528, 12.1; E399).
struct InitiationPoint {
  double displacement = not_given, force = not_given;
  std::size_t row = 0;  ///< the last one before it, or it itself
};

/// NL: where the record leaves the line for good, on the way to the greatest force: by more than 2 % of the line's
/// force and more than three times the scatter about the line. Nothing where it does not before the greatest force.
std::optional<InitiationPoint> nonlinearity(const TestRecord& record, const StraightPart& straight);

/// The secant of 5 %/MAX as the standard of a specimen has it.
struct SecantRule {
  double compliance = 1.05;        ///< over C0: ASTM D5528, 12.1.3; 1/0.95 where the slope is 95 %, E399, 9.1.1
  bool or_greater_before = false;  ///< a larger force before the secant is taken instead: P_Q of E399
};

/// 5 %/MAX: where the record crosses the secant last before its greatest force, so that noise does not cross it first;
/// the greatest force where the record is still above the secant.
InitiationPoint five_percent_or_greatest(const TestRecord& record, const StraightPart& straight,
                                         const SecantRule& rule = {});

}  // namespace pfdm
