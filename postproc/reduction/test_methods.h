#pragma once
// Methods of data reduction by specimen: the energy release rate of a point of the record.

#include "postproc/reduction/initiation.h"
#include "postproc/reduction/test_record.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// What a method says of one point.
struct Reduced {
  double toughness = not_given;       ///< G [J/m^2]
  double crack_length = not_given;    ///< as it was read, or the equivalent one [m]
  double mode_two_share = not_given;  ///< GII/G, of mixed modes
};

/// What a method makes of the record before it reduces points, as Delta; SI.
struct ReductionConstant {
  std::string name, unit;
  double value = not_given;
};

struct CalibratedMethod {
  std::function<Reduced(double force, double displacement, double crack_length)> at{};
  std::vector<ReductionConstant> constants{};
  std::string missing{};  ///< why there is no `at`: what has to be given
  std::string remark{};   ///< what is doubtful, a sentence; or empty
};

/// What methods are calibrated with. Displacements count from the origin of the straight part.
struct CalibrationData {
  const TestRecord& record;
  const TestDimensions& specimen;
  StraightPart straight;
  InitiationPoint five_percent;
  std::vector<std::size_t> grown;  ///< rows with a crack length, from initiation to failure
};

struct ReductionMethod {
  std::string_view name;
  std::string_view source;   ///< standard or paper with its equation
  bool needs_crack_lengths;  ///< of points beyond initiation
  CalibratedMethod (*calibrate)(const CalibrationData& data);
};

std::span<const ReductionMethod> double_cantilever_beam_methods();
std::span<const ReductionMethod> end_notched_flexure_methods();
std::span<const ReductionMethod> mixed_mode_bending_methods();
std::span<const ReductionMethod> compact_tension_methods();

/// A kind of specimen.
struct ReducedSpecimen {
  std::string_view name, description;
  std::span<const ReductionMethod> (*methods)();
  SecantRule secant{};
};
std::span<const ReducedSpecimen> reduced_specimens();

/// "", or which of the dimensions are missing: "needs shear_modulus, ...".
std::string missing_dimensions(std::initializer_list<std::pair<std::string_view, double>> needed);

}  // namespace pfdm
