#pragma once
// Thin layers that are held on both faces, by prescribed displacements or by much stiffer material, and whose cells
// have no pressure unknowns: how much too soft coarse ones are when they are pulled or pressed across.
//
// A layer of thickness H loses its lateral constraint within a length l = H ((lambda + 2 mu)/(12 mu))^(1/2) of its
// edges. In a strip of width W the part g = 1 - tanh(w)/w, w = W/(2 l), of it is constrained, in bodies of finite width
// in both directions the product of both parts (Reynolds' equation of the lateral displacement: Gent, Lindley, Proc.
// Inst. Mech. Eng. 173 (1959) 111, for compressible layers).

#include "mesh/mesh.h"
#include "solver/momentum/body/unknowns.h"

#include <array>
#include <vector>

namespace pfdm {

/// A layer at one of its held faces.
struct ConfinedLayer {
  Index cell = 0;
  double area = 0.0;       ///< of the face [m^2]
  double thickness = 0.0;  ///< [m]
  double layers = 0.0;     ///< of cells, of boxes that prisms or tetrahedra fill
  bool of_tetrahedra = false;
  /// In up to two directions between free edges: the width, and the length of the cells at the edges [m].
  struct Span {
    double width = 0.0, cells = 0.0;
  };
  std::array<Span, 2> spans{};
  int n_spans = 0;

  /// The stiffness across less 1, negative, 0 without spans: c g' (M - E')/(E' + (M - E') g) H/l, c = cells/H
  /// + 1.5/(layers^2 + 1) with `refined` times as many layers and cells, g' = (tanh(w)/w - 1/cosh^2 w)/2, M = lambda +
  /// 2 mu, E' = E/(1 - nu^2) of strips and E of bodies with two spans, of which the formula takes 0.85 and the sum of
  /// both; of tetrahedra 0.75 of it. Measured (near_incompressibility.md, test `ConfinedLayers`).
  double error(const IsotropicElasticity& of, double refined = 1.0) const;
};

/// At held faces, up to about 2,000 of them: layers between two that face each other, or between one and a plane of
/// symmetry, of one material without pressure unknowns, at least twice as wide as thick. Without spans where there is
/// none. Nothing in plane stress and in boxes that follow a mean strain.
std::vector<ConfinedLayer> confined_layers(const Mesh& mesh, const Unknowns& unknowns);

}  // namespace pfdm
