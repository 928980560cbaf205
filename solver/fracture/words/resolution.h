#pragma once
// Whether the mesh and the lengths that were given can do what is asked of them.

#include "mesh/band.h"
#include "mesh/mesh.h"
#include "solver/fracture/model/fracture_model.h"

#include <span>
#include <string>
#include <vector>

namespace pfdm {

struct ResolutionWords {
  /// Warnings on regions and bands in which a crack would not dissipate its toughness, or its front would not be
  /// resolved. A region is named if all its cells are too thick for ell (more than ell/2 across their thinnest
  /// direction). A band is named if it is too narrow for its crack's profile, or if its cells are too wide along it (in
  /// the mean, and few are finer). They are compared with ell or, if longer, the process zone of a law with softening.
  std::vector<std::string> warnings;
  /// Remarks on regions some of whose cells are too thick, as cracks may stay out of them, and on regions in a mesh one
  /// cell thick whose cells are all longer than ell in its plane.
  std::vector<std::string> remarks;
};

/// `corrects_toughness`: whether the toughness of the bands allows for what of a crack's profile lies beyond them; one
/// is then too narrow where most of its surface energy does.
ResolutionWords resolution_words(const Mesh& mesh, const FractureModel& model, std::span<const Band> bands,
                                 bool corrects_toughness);

/// Remark on regions of hexahedra in which cracks may choose a direction: the effect of the rows of cells on their
/// direction and surface energy, and the remedy (measurements: tests/verification/log_crack_directions.md); empty:
/// none.
std::string direction_remark(const Mesh& mesh, const FractureModel& model);

}  // namespace pfdm
