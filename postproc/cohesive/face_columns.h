#pragma once
// The faces of a cohesive interface as places of a run's record, beside the columns through bands and planes: each has
// the separation and the traction of its face, and what it has dissipated. So the same tables and figures, debonding
// angles among them, are made of an interface without thickness and of a band.

#include "postproc/cohesive/columns.h"

namespace pfdm {

/// A place for each face. The normals of a curved surface point outwards, as those of columns around a particle,
/// whichever side the interface names first; those of a plane one leave its first side.
ColumnSet face_columns(const Mesh& mesh, const CohesiveSurface& surface, const Vector& axis);

/// One for each face of the interface that has the name of the set: surface_energy is what it dissipated [J/m^2],
/// largest_damage that over its toughness; no bulk.
std::vector<ColumnSample> sample_faces(const Mesh& mesh, const FractureModel& model, const OutputFields& output,
                                       const ColumnSet& set);

}  // namespace pfdm
