#pragma once
// Columns: straight lines of cells across a surface where the material may part, and what they tell of its cohesive
// law. The separation is what the strain of a column has beyond the elastic strain that the undamaged material would
// have under the same traction and the same strains along the surface (which need not vanish, nor be free):
//
//   delta_n = int (eps_nn - (T_n - lambda (eps_11 + eps_22)) / (lambda + 2 mu)) ds,
//   delta_t = int (2 eps_nt - T_t / mu) ds,
//
// with T the traction on the faces of each cell; n the normal, 1 and 2 the tangents. In a sound column it is zero.

#include "mesh/search/line_walk.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct Column {
  Vector point = Vector::Zero();        ///< on the surface [m]
  Vector normal = Vector::Zero();       ///< unit length
  std::array<Vector, 2> tangents{};     ///< unit length; the first in the direction of growing polar angle
  double area = 0.0;                    ///< of the surface that it stands for [m^2]
  double length = 0.0;                  ///< [m]
  double reference = 0.0;               ///< where along it the traction is taken, at every state [m]
  std::vector<LineSegment> segments{};  ///< along the normal
};

enum class SurfaceKind {
  interface,  ///< between a band of cells and a particle; the columns run through the band
  plane       ///< a cut; the columns run through it. What strain they have in excess at both ends is the bulk's
};

std::string_view name_of(SurfaceKind kind);

struct ColumnSet {
  std::string name;
  SurfaceKind kind = SurfaceKind::interface;
  std::vector<Column> columns;
  bool is_cohesive = false;  ///< faces of a cohesive interface (face_columns.h): their law is given
};

/// Tangents of a surface, unit length: the first towards growing polar angle, the second across; at a pole any.
std::array<Vector, 2> surface_tangents(const Vector& normal, const Vector& axis);

/// Angle between a column's normal and the axis, a unit vector [rad]: on a sphere the polar angle.
double polar_angle(const Vector& normal, const Vector& axis);

/// A column through the region `band` from every face that it shares with a region other than `outer`, as a particle.
/// Its traction is that at its middle, where the crack of a band between tougher neighbours runs.
/// One set for each connected surface: called as the band, or band_1, band_2 ... in the order of their faces. Throws
/// InputError if the mesh has no such regions or no such face. `axis`: a unit vector from which tangents and polar
/// angles are counted.
std::vector<ColumnSet> interface_columns(const Mesh& mesh, const std::string& band, const std::string& outer,
                                         const Vector& axis);

/// A column through every section of the plane with a cell, half_width [m] to either side, or to the boundary. Its
/// traction is that on the plane. Throws InputError if the normal is zero or the plane misses the mesh.
ColumnSet plane_columns(const Mesh& mesh, const std::string& name, const Vector& point, const Vector& normal,
                        double half_width, const Vector& axis);

/// What a column tells at a converged state. Components: normal, first and second tangent.
struct ColumnSample {
  Vector traction = Vector::Zero();    ///< at its reference [Pa]
  Vector separation = Vector::Zero();  ///< of the whole column [m]
  Vector bulk = Vector::Zero();        ///< its length times the mean of the excess strains at both ends [m]
  double surface_energy = 0.0;         ///< line integral of the discrete surface energy density [J/m^2]
  double largest_damage = 0.0;         ///< [-]
};

/// One for each column. `model` has the regions of the mesh.
std::vector<ColumnSample> sample_columns(const Mesh& mesh, const FractureModel& model, const OutputFields& output,
                                         const ColumnSet& set);

}  // namespace pfdm
