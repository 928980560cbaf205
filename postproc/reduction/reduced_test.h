#pragma once
// Data reduction of a fracture test by all methods of its specimen: G by point, at initiation and in propagation.

#include "postproc/reduction/test_methods.h"

#include <optional>

namespace pfdm {

struct ReducedPoint {
  std::size_t row = 0;  ///< of the record
  Reduced found{};
};

/// Mean over the points behind the greatest force.
struct Propagation {
  double toughness = not_given;  ///< [J/m^2]
  double deviation = not_given;  ///< standard deviation of the points [J/m^2]
  double rise = not_given;       ///< slope of G over the crack length [J/m^3]
  std::size_t n_points = 0;
};

struct ReducedByMethod {
  std::string_view name, source;
  std::string missing{};  ///< why it says nothing; else empty
  std::vector<ReductionConstant> constants{};
  std::optional<Reduced> nonlinearity{}, visual{};
  Reduced five_percent{};
  std::vector<ReducedPoint> points{};
  Propagation propagation{};
};

struct ReducedTest {
  std::string name;      ///< of the record
  std::string specimen;  ///< "double_cantilever_beam"
  TestRecord record{};   ///< its displacements count from the origin of the straight part
  double origin = 0.0;   ///< what was taken from them for that [m]
  StraightPart straight{};
  /// visual: the first row whose crack is longer than at first; where lengths have gaps, the first that was read.
  std::optional<InitiationPoint> nonlinearity{}, visual{};
  InitiationPoint five_percent{};
  std::vector<ReducedByMethod> methods{};
  std::vector<std::string> remarks{};  ///< what is doubtful, a sentence each
};

/// Throws InputError for a record from which no initial compliance can be taken.
ReducedTest reduced_test(const ReducedSpecimen& specimen, TestRecord record, const TestDimensions& dimensions,
                         std::string name);

/// The propagation value of the first method that has one, with at least three points; else G at the 5 %/MAX point of
/// the first method that says something. NaN where none does.
double best_toughness(const ReducedTest& test);
/// A constant of the first method that has it, as "E_flexural"; NaN where none has.
double constant_of(const ReducedTest& test, std::string_view name);

}  // namespace pfdm
