#pragma once
// Layers of cells across a body that bends, whose materials may differ in stiffness.
//
// With E' = E/(1 - nu^2) and t of each layer the stack has the bending stiffness D = sum of E' t^3/12 + E' t d^2, d
// being the distance of a layer's middle from the neutral axis. The first part is what a layer has about its own
// middle: gradients that do not see bending within layers leave it out.

#include "mesh/fields.h"

#include <vector>

namespace pfdm {

/// One layer of cells.
struct StackLayer {
  Index cell = -1, zone = -1;  ///< layers of one zone side by side are one material
  double thickness = 0.0;      ///< [m]
  double modulus = 0.0;        ///< E/(1 - nu^2) [Pa]
  double count = 1.0;          ///< as how many layers it counts: a prism as part of the box that it fills with another
};

/// How a stack of layers bends, by shares of its bending stiffness D.
struct LayerStack {
  /// (12 D/sum of E' t)^(1/2), of one material the thickness [m].
  double even_thickness = 0.0;
  // Shares of D that parts of the stack have about their own middles.
  double layers = 0.0;   ///< each layer of cells; of n even layers of one material 1/n^2
  double lone = 0.0;     ///< each material of one layer of cells; zero where the body is of one material
  double beside = 0.0;   ///< each material of two layers of cells at a surface of the body, likewise
  double between = 0.0;  ///< each material of two layers of cells between others
  // Shares of D of these materials in all, with what they have about the neutral axis:
  double of_lone = 0.0;   ///< materials of one layer of cells
  double of_pairs = 0.0;  ///< materials of two layers of cells
  int n_materials = 0;
  /// Of the materials of one layer, or else of two, that with the largest share.
  Index thinnest = -1;              ///< a cell of it, -1 if there is none
  double thinnest_thickness = 0.0;  ///< [m]

  /// Even layers of one material with the same share, layers^(-1/2).
  double even_layers() const;
};

/// Of layers from one surface to the opposite one, or from a surface to a plane of symmetry, beyond which they go on as
/// their mirror image.
LayerStack layer_stack(std::vector<StackLayer> layers, bool is_mirrored);

}  // namespace pfdm
