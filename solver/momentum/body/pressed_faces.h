#pragma once
// Pressures on patches (BoundaryCondition::pressure) as loads of the momentum balance: -p S at small strain. At finite
// strain they follow the body: S is the area vector of the face's polygon whose points have moved, each by the mean of
// u_f + G_c (x - x_f) over the faces around it, which is exact where the displacement is linear. Faces of broken cells
// count little. As the polygons stay joined, the pressure on a closed surface has no resultant, whatever the mesh. (cof
// F of the cells is wrong by O(h) on a curved surface, and so was its resultant.) The derivative is not symmetric on
// the rim of a patch.

#include "solver/momentum/body/face_mean.h"
#include "solver/momentum/body/unknowns.h"

#include <vector>

namespace pfdm {

class PressedFaces {
 public:
  PressedFaces(const Mesh& mesh, const Unknowns& unknowns);

  /// load += the forces at the load parameter t [N], once linearised on the areas of then.
  void add_forces(double t, std::vector<Vector>& load) const;

  /// Finite strain: linearises the forces about t and the displacements u with these gradients of the cells, whose
  /// stiffness factors are g.
  void linearise(double t, const std::vector<Vector>& u, const CellField<Tensor>& gradients,
                 const CellField<double>& g);
  /// out += what the forces lose by displacements u with these gradients of the cells [N].
  void add_turn(const std::vector<Vector>& u, const CellField<Tensor>& gradients, std::vector<Vector>& out) const;
  /// load += the same of the displacements about which they are linearised [N].
  void add_initial_turn(std::vector<Vector>& load) const;

 private:
  // A face at a point, from whose centre the point is at d.
  struct Corner {
    Index cell, node;
    Vector d;  // [m]
    double weight = 0.0;
  };
  struct Point {
    Index point;
    Tensor free = Tensor::Identity();  // projector on the planes of symmetry that it lies in
    std::vector<Corner> corners{};
    Vector place = Vector::Zero();  // where the forces are linearised [m]
  };
  struct Face {
    std::size_t condition;  // number among those of the unknowns
    Index face, node;
    std::vector<std::size_t> points{};     // in points_, in the order of the face's
    double pressure = 0.0;                 // at which it is linearised [Pa]
    Vector area = Vector::Zero();          // at which it is linearised [m^2]
    Vector initial_turn = Vector::Zero();  // [N]
  };
  void add_face(std::size_t condition, Index face, std::vector<Index>& number_of_point);
  void hold_points(const std::vector<Index>& number_of_point);
  void weigh(Point& point, const CellField<double>& g) const;
  static Vector move(const Point& point, const std::vector<Vector>& u, const CellField<Tensor>& gradients);
  std::vector<Vector> moves(const std::vector<Vector>& u, const CellField<Tensor>& gradients) const;
  Vector turn(const Face& at, const std::vector<Vector>& moves) const;
  Vector free_part(const Face& at, const Vector& force) const {
    return unknowns_->free_directions[at.node - unknowns_->n_cells] * force;
  }
  double pressure_on(const Face& at, double t) const {
    const BoundaryCondition& on = unknowns_->conditions[at.condition].condition;
    return mean_over_face(*mesh_, at.face, [&](const Vector& x) { return on.pressure(x, t); });
  }

  const Mesh* mesh_;
  const Unknowns* unknowns_;
  std::vector<Point> points_;
  std::vector<Face> faces_;
  bool follows_ = false;  // they have been linearised
};

}  // namespace pfdm
