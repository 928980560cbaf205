#pragma once
// A fracture test as data reduction takes it: the record of the machine, the specimen's dimensions.

#include <cstddef>
#include <limits>
#include <vector>

namespace pfdm {

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// Rows in the order of the test. Displacements do not fall.
struct TestRecord {
  std::vector<double> displacement;    ///< of the load points against each other [m]
  std::vector<double> force;           ///< [N]
  std::vector<double> crack_length{};  ///< from the load line [m], NaN where it was not read; or none at all

  std::size_t n_rows() const { return force.size(); }
};

/// In SI; NaN where it was not given.
struct TestDimensions {
  double width = not_given;                       ///< b, B
  double thickness = not_given;                   ///< 2 h, of both arms
  double crack_length = not_given;                ///< a0, from the load line or the support
  double half_span = not_given;                   ///< L
  double lever = not_given;                       ///< c of the MMB's lever
  double depth = not_given;                       ///< W of a compact specimen, from the load line to the back
  double young_modulus = not_given;               ///< E along the arms
  double transverse_modulus = not_given;          ///< E33 across them
  double shear_modulus = not_given;               ///< G13
  double poisson_ratio = not_given;               ///< of an isotropic material
  double block_offset = not_given;                ///< t (l1): from the load point to the middle of the arm
  double block_length = not_given;                ///< L' (l2): from the load point to the block's edge
  std::vector<double> calibration_lengths{};      ///< crack lengths at which the compliance was measured [m]
  std::vector<double> calibration_compliances{};  ///< [m/N]

  double arm() const { return 0.5 * thickness; }  ///< h
};

}  // namespace pfdm
