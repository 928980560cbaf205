#pragma once
// The faces of nearly incompressible cells as a body of finite strain moves them. Their points move by the mean of what
// the cells, on boundaries and interfaces the faces, around them say, u + H (x - x_c), which is exact where the
// displacement is linear. Two cells that share a face share its points. So
//
// - the pressures of both cells act on one area vector, that of the moved polygon. With cof F N of either cell there
//   are two of them, and bodies that are next to incompressible become unstable under a mean tension of 2 mu;
// - the volume of a cell is that of the polyhedron of its moved points, with a part that makes its faces follow their
//   own displacement, u_f less the mean u_p of the polygon: V = sum of volumes between polygons + (u_f - u_p).S. Its
//   derivative by u_f is the area vector S on which the pressure acts.
//
// On free and split faces of hexahedra and prisms S is cof F N of the cell, on bonded sides and on surfaces of layers
// that bend that of the side's own gradient. The points of a free face that has another one opposite to it move with
// shears that the cell does not resolve, and a pressure on their polygon is unstable. Tetrahedra and polyhedra have no
// such shears. There cof F N, with which the areas of the cell's faces do not add up to zero, is what is unstable.
//
// A uniform pressure does no work in a body that is held, however large it is: only so can such a body swell. Therefore
// both sides of an interface that holds share their points as well. Faces that are held or that glide, which is to be
// held across themselves alone, have their polygon in all cells but those of bonded sides (bonded_sides.h); and points
// of gliding faces do not leave the surface.
//
// Points of faces whose displacement is prescribed, in some directions or in all, move with these faces in those
// directions. Faces of broken cells count little.
//
// Axisymmetric meshes: points move as their image in the middle of the sector, along their own radius.

#include "solver/momentum/faces/bonded_sides.h"

#include <vector>

namespace pfdm {

class MovedFaces {
 public:
  /// A face as seen from one cell; of a link that is P.
  struct Place {
    Index face, cell;
    Index node = -1;       ///< on the face; -1 of a link
    std::size_t side = 0;  ///< number of the side that has it
    Index beyond = -1;     ///< N of a link
  };

  MovedFaces() = default;
  /// Finds the points of those of these places whose cells have a pressure, and of the planes of a sector.
  MovedFaces(const Mesh& mesh, const Unknowns& unknowns, const std::vector<Place>& places, const BondedSides& bonded);

  bool any() const { return !corners_.empty(); }

  /// The displacements from which the points take theirs; linear in them.
  struct Field {
    const std::vector<Vector>& u;
    const CellField<Tensor>& gradients;
    const std::vector<Tensor>& bonded_gradients;
  };
  /// The stiffness factors g weigh the points.
  void weigh(const CellField<double>& g);
  /// Displacement of every point [m].
  void move(const Field& by, std::vector<Vector>& moves) const;
  /// Takes the points of the faces where they are linearised, and their own displacements.
  void place(const std::vector<Vector>& moves);
  void follow(const std::vector<Vector>& u_face);

  /// Area vector of place i, outwards from its cell and over the undeformed area, and its change by moves. Zero for
  /// cells without a pressure.
  const Vector& area(std::size_t i) const { return loops_[i].area; }
  /// Sets an area vector in place of the polygon's; after place().
  void set_area(std::size_t i, const Vector& area) { loops_[i].area = area; }
  Vector area_change(std::size_t i, const std::vector<Vector>& moves) const;
  /// Volume that place i sweeps with these displacements, linearised, and truly where it is linearised [m^3].
  double flux(std::size_t i, const std::vector<Vector>& moves, const Vector& u_face, const Vector& area_change) const;
  double swept(std::size_t i, const std::vector<Vector>& moves, const Vector& u_face) const;
  /// The area of a cell's section, over the undeformed one, of axisymmetric meshes; and its change.
  double section(Index cell) const {
    const Index k = section_of_cell_[cell];
    return k < 0 ? 0.0 : sections_[k].area.norm();
  }
  double section_change(Index cell, const std::vector<Vector>& moves) const;

 private:
  struct Sample {
    Index node, cell;
    Index bonded;  // number among the bonded sides; -1: the gradient is that of the cell
    Vector d;      // from the node [m]
    double weight = 0.0;
  };
  // Samples of a corner whose displacement is prescribed in these directions.
  struct Hold {
    Tensor directions;
    std::size_t begin, end;
    bool glides;  // along their faces, which hold it across themselves
    std::size_t first_rise = 0, end_rise = 0;
    double sum = 0.0;  // of the weights
  };
  // Difference of a displacement that varies along a gliding surface, at a corner, from that at the face of a sample:
  // this part of its difference at another face.
  struct Rise {
    std::size_t sample;
    Index node;
    double part;
  };
  struct Corner {
    Vector point;  // undeformed [m]
    std::size_t begin = 0, end = 0;
    std::size_t first_hold = 0, end_of_holds = 0;
  };
  struct Loop {
    std::size_t begin = 0, end = 0;  // its corners, outwards from the cell
    Index apex = -1;                 // corner that its triangles are about; -1: the mean of its points
    double size = 0.0;               // undeformed area [m^2]
    Vector centre = Vector::Zero();  // of the face [m]
    Vector area = Vector::Zero();    // over the undeformed one
    Vector gap = Vector::Zero();     // u_f - u_p, where it is linearised [m]
  };
  class Builder;
  Vector mean(const Field& by, std::size_t begin, std::size_t end) const;
  Vector held(const Field& by, const Hold& hold) const;
  Vector place_in(const Loop& loop, Index corner) const { return corners_[corner].point + at_[corner] - loop.centre; }
  Vector area_change(const Loop& loop, const std::vector<Vector>& moves) const;
  void each_triangle(const Loop& loop, const std::vector<Vector>& moves, const auto& at, const auto& f) const;

  std::vector<Sample> samples_;
  std::vector<Hold> holds_;
  std::vector<Rise> rises_;
  std::vector<Corner> corners_;
  std::vector<Tensor> turns_;  // of the corners of axisymmetric meshes; else empty
  std::vector<Loop> loops_, sections_;
  std::vector<Index> loop_corners_;
  std::vector<double> shares_;  // of the triangles of the loops in their faces
  std::vector<Index> section_of_cell_;
  std::vector<Vector> at_;  // moves about which the faces are linearised [m]
};

}  // namespace pfdm
