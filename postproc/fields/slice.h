#pragma once
// Measures of damage in a plane through the body.

#include "mesh/mesh.h"

namespace pfdm {

/// The part of a plane within a cell.
struct Section {
  double area = 0.0;               ///< [m^2]; 0 where the plane misses the cell
  Vector centre = Vector::Zero();  ///< [m]
};

/// Of the plane through `point` [m] with the given unit normal. Exact for the surface of triangles that faces
/// are (mesh/geometry.h). Where the plane follows faces, each of the two cells has half of their common face, and the
/// one cell at the boundary all of it.
Section section_of_cell(const Mesh& mesh, Index cell, const Vector& point, const Vector& normal);

/// Area [m^2] of the plane through `point` [m] with the given `normal` (any length) inside cells with
/// damage > threshold: the sum of their sections, so that a slice in a symmetry plane is whole. Throws InputError if
/// the normal is zero.
double damaged_area(const Mesh& mesh, const CellField<double>& damage, const Vector& point, const Vector& normal,
                    double threshold = 0.5);

}  // namespace pfdm
