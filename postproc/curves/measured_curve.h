#pragma once
// A measured force-displacement curve as the machine recorded it, made ready for a comparison: unloading loops, noise
// of the displacement, a toe, and what the set-up adds to the curve of the specimen.

#include "postproc/curves/comparison.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {

/// What a test adds to the specimen's curve: the machine records u + offset + compliance F and F + force_offset.
struct SetUp {
  double offset = 0.0;        ///< [m]
  double force_offset = 0.0;  ///< [N]
  double compliance = 0.0;    ///< of machine, grips and fixtures, in series with the specimen [m/N]
  friend bool operator==(const SetUp&, const SetUp&) = default;
};

/// The straight part of a curve, whose extension to zero force is the origin of its displacements.
struct Toe {
  double from = 0.0, to = 0.0;
  bool of_force = true;  ///< from and to are forces [N], else displacements [m]
};

/// What is done to the rows of a record, in this order.
struct Preparation {
  /// Rows from where the displacement falls by more than `jitter` until it is back there are left out.
  bool envelope = false;
  /// How far displacements may move to the nearest ones that do not fall [m].
  double jitter = 0.0;
  /// Rows before the straight part are left out.
  std::optional<Toe> toe{};
};

struct MeasuredCurve {
  SampledCurve as_recorded{};  ///< the rows of the file; x may fall
  SampledCurve curve{};        ///< what preparation leaves of it, still with what the set-up adds
  SetUp set_up{};
  double displacement_factor = 1.0, force_factor = 1.0;  ///< of the file's columns; `as_recorded` has them
  double origin = 0.0;                                   ///< that the toe gives, taken from displacements [m]
  std::vector<std::string> done{};                       ///< to its rows, a sentence each

  /// The curve of the specimen: without what the set-up adds. Noise of the force that the compliance carries into the
  /// displacement is taken out as jitter.
  SampledCurve of_specimen() const;
  /// All that of_specimen() differs by from what was recorded, a sentence each.
  std::vector<std::string> treatment() const;
};

/// Throws InputError that names the key to be set, for displacements that fall further than they may, and for a
/// straight part that is none.
MeasuredCurve prepared(SampledCurve recorded, const Preparation& preparation, const SetUp& set_up);

/// A specimen's computed curve as the machine would have recorded it. With a set-up that adds something it begins as
/// much earlier as its first displacements are long, in their direction: an offset may be too large on trial.
SampledCurve as_recorded(const SampledCurve& computed, const SetUp& set_up);

/// The nearest values (least squares) that do not fall: pool adjacent violators (Ayer et al., Ann. Math. Stat. 26
/// (1955) 641).
std::vector<double> nearest_not_falling(const std::vector<double>& values);

/// Least squares of force over displacement.
struct StraightLine {
  double slope = 0.0;
  double zero = 0.0;        ///< displacement where it meets the given force
  double zero_error = 0.0;  ///< its standard error, by the scatter about the line; 0 of two points
  std::size_t n_points = 0;
};
/// Nothing with fewer than three points, without a rise, or with all at one displacement.
std::optional<StraightLine> straight_line(const std::vector<double>& x, const std::vector<double>& y, double zero_y);

/// A straight part of a measured curve that misses the origin of the computed one.
struct MissedOrigin {
  double measured = 0.0, error = 0.0;  ///< displacement at zero force, its standard error [m]
  double computed = 0.0;               ///< likewise [m]
};
/// Over the measured points between two displacements. Nothing where the difference is not significant (0.1 %, by
/// Student's t) or below 2 % of the range.
std::optional<MissedOrigin> missed_origin(const SampledCurve& measured, const SampledCurve& computed, double from,
                                          double to);

/// A sentence, with what may be done.
std::string missed_origin_text(const MissedOrigin& missed, const std::string& specimen);

}  // namespace pfdm
