#pragma once
// How the axes of materials turn from layer to layer of a body that bends, and what that costs.

#include "mesh/fields.h"

#include <span>

namespace pfdm {

/// A layer: the material that it is of, its thickness [m], and R: minus the shear angle without shear stress that a
/// strain along the layers makes, over that strain [-].
struct TurnedLayer {
  Index zone = -1;
  double thickness = 0.0, R = 0.0;
};

/// Zero where axes do not turn.
struct AxesTurn {
  double step = 0.0;       ///< largest difference of R of two layers side by side; of three layers or fewer of any two
  double range = 0.0;      ///< largest difference of R of any two, of a material or on both sides of the end of one
  double most = 0.0;       ///< largest R without regard to sign
  double plies = 0.0;      ///< largest difference of R between materials side by side, one of them of two layers
  double uneven = 0.0;     ///< sum of the cubes of the layers' shares of the thickness, less that of even layers
  bool is_of_few = false;  ///< three layers or fewer
  /// Why the error is not known: a material among others is of one layer and has an R; axes turn and go on in another
  /// material; axes turn and there are eigenstrains, with which gradients know the axes of each cell alone.
  enum class Unknown { no, lone_plies, goes_on, eigenstrains } unknown = Unknown::no;

  /// Error of the bending stiffness (bending.md). 0.08 (step/max(1, most))^2, of three layers or fewer 0.15, either
  /// way; of plies 0.13 plies/(2 most), too much; of uneven layers uneven (0.6 + 8 range); 3 where it is not known.
  double error() const;
  double error_of_plies() const;
  double error_of_uneven() const;
  /// Likewise of cells of this length over the thickness of the body, `shear` as of BendingLayers: length/thickness
  /// max(1, shear/2.5)^(1/2) - 0.65, less where the range is below a quarter.
  double error_of_long(double length, double shear) const;
  /// The length over the thickness at which that is no more than an error.
  static double length_for(double error, double shear);
};

/// Of layers from one surface to the opposite one.
AxesTurn axes_turn(std::span<const TurnedLayer> layers, bool has_eigenstrain);

}  // namespace pfdm
