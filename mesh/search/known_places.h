#pragma once
// A field that is known at the points or in the cells of some mesh, at any other place.

#include <array>
#include <vector>

#include "mesh/cell_faces.h"
#include "mesh/mesh.h"
#include "mesh/search/box_tree.h"

namespace pfdm {

/// A value at a place, sum_i weight_i value(known_i). The weights add up to 1.
struct Interpolation {
  std::vector<Index> known;    ///< points, or cells, each once or more often
  std::vector<double> weight;  ///< [-]
  double outside = 0.0;        ///< how far the place is from the mesh [unit of its points]
};

/// Points and cells of any shape, searched by place. A cell is cut into the tetrahedra between the mean of its points
/// and the fans of its faces about the means of theirs; neither need the mesh's faces match. Linear fields come out as
/// they are. It may be asked from several threads at once.
class KnownPlaces {
 public:
  /// Throws InputError if a cell has the wrong number of points for its shape, or a polyhedron does not close.
  explicit KnownPlaces(const CellSoup& soup);

  /// Of values at points: linear in the tetrahedron around x, in its corners that are means likewise means. Outside
  /// the mesh it is the value of the nearest place of its surface.
  Interpolation from_points(const Vector& x) const;
  /// Of values in cells, at their centroids: the cell's around x, and a gradient by least squares over the cells that
  /// share a point with it, weighted by 1/distance^2; none along directions in which the mesh has one layer. Outside
  /// likewise.
  Interpolation from_cells(const Vector& x) const;
  /// Of values at points: that of the point nearest to x, of those that cells have.
  Interpolation from_one_point(const Vector& x) const;
  /// The cell's value around x, or nearest to it.
  Interpolation from_one_cell(const Vector& x) const;

  const Box& around() const { return around_; }
  Index n_points() const { return count_of(points_); }
  Index n_cells() const { return count_of(middle_); }

 private:
  struct Found;  // the place in a cell that is nearest to x
  Found find(const Vector& x) const;
  void look_in(Index cell, const Vector& x, Found& best) const;
  Vector middle_of_face(Index face) const;
  std::vector<Index> points_of_cell(Index cell) const;
  std::vector<Index> neighbours(Index cell) const;
  std::vector<Box> boxes() const;
  void measure_cells();
  void list_cells_of_points();

  std::vector<Vector> points_;
  HalfFaces faces_;
  std::vector<Index> first_face_;          // of each cell, and one more
  std::vector<Vector> middle_, centroid_;  // of each cell
  std::vector<Index> first_of_point_, cells_of_point_;
  Box around_;
  BoxTree tree_;
  std::vector<Index> point_of_box_;  // of point_tree_
  BoxTree point_tree_;
};

/// Where a field is known, and along which coordinates it varies.
struct KnownField {
  KnownPlaces places;
  bool at_points = true;                         ///< or in the places' cells
  std::vector<Index> entry;                      ///< of each of these the number of its value
  std::array<bool, 3> varies{true, true, true};  ///< along x, y, z
  Vector fixed = Vector::Zero();                 ///< the coordinates of the places along which it does not

  /// With the numbers of values in place of those of points or cells. `nearest`: one value alone.
  Interpolation at(Vector x, bool nearest) const;
};

/// The diagonal of the box around points; 0 of none.
double size_of(const std::vector<Vector>& points);
/// 0, 1 ... n - 1.
std::vector<Index> counted_from_zero(std::size_t n);

}  // namespace pfdm
