#pragma once
// The faces of the momentum balance and what it stores of them; see momentum.h.

#include "mesh/mesh.h"
#include "physics/elasticity/mandel.h"
#include "solver/momentum/finite_law.h"

namespace pfdm {

/// The law of a split face about a separation delta = u_N - u_P of its sides.
struct FaceSpring {
  Tensor stiffness;  ///< K of the traction on the owner's side, K delta + offset [Pa/m]
  Vector offset;     ///< [Pa]
  Tensor secant;     ///< for the preconditioner: symmetric, positive semi-definite [Pa/m]
  /// At finite strain: what the traction changes by with cof F N of the owner and of the neighbour [Pa]. The offset is
  /// then that of a traction K delta + offset + turn_P (dc_P/dF : H_P) N + turn_N (dc_N/dF : H_N) N.
  Tensor turn_P = Tensor::Zero(), turn_N = Tensor::Zero();
};

namespace momentum_faces {

// An interior face within one elastic zone.
struct Link {
  Index face, P, N;
  double area;
  Vector n;                               // from P to N
  Vector d_P, d_N;                        // from the cell centres to the face centre
  double weight_n = 0.0, weight_t = 0.0;  // of sigma_P in the traction; those of sigma_N complete them to 1
  double c_n = 0.0, c_t = 0.0;            // [Pa/m]
  double jump_n = 0.0, jump_t = 0.0;      // c_n and c_t as the jump has them beside polyhedra [Pa/m]
};
// One side of a face that carries a node.
struct Side {
  Index face, cell, node;
  double area;
  Vector n;                     // outwards from the cell
  Vector d;                     // from the cell centre to the face centre
  double a_n = 0.0, a_t = 0.0;  // [Pa/m]
};
struct SplitFace {
  Index node, beyond;  // on the owner's and on the neighbour's side
  double area;
  Index P, N;  // owner and neighbour
  Vector n;    // from P to N
};
// Weight and c of a link whose cells are not isotropic.
struct LinkTensors {
  Tensor weight;    // of sigma_P n in the traction
  Tensor c;         // [Pa/m]
  Tensor softness;  // (a + b)^-1 [m/Pa]
};
// The law of one side of a face at its strain.
struct SideLaw {
  Eigen::Matrix<double, 3, 6> rows;  // n.C: traction on n by the strain [Pa]
  Tensor acoustic;                   // n.C.n [Pa]
  Vector initial = Vector::Zero();   // traction without strain [Pa]
};
// What the traction on one side of a face changes by with its c = cof F N: turn dc, through a; and the constant
// part of the linearised traction.
struct FaceTurn {
  Tensor turn;            // [Pa]
  Vector swell;           // by J [Pa]
  Vector initial;         // [Pa]
  double pressure = 0.0;  // on it, which acts on the moved area [Pa]
};
// m of a h = mu 1 + m c c^T, and dm/dJ.
struct Push {
  double stiffness = 0.0, slope = 0.0;  // [Pa]
  Push operator/(double h) const { return {stiffness / h, slope / h}; }
};
// Of a link where the jump has a stiffness other than that of the tractions: what that adds, likewise.
struct JumpTurn {
  Tensor P, N;              // [Pa]
  Vector swell_P, swell_N;  // [Pa]
  Vector initial;           // [Pa]
};
// Equation of a pressure, J(q) = volume of the moved cell over the undeformed one, linearised.
struct VolumeRow {
  double slope;    // dJ/dq [1/Pa]
  double initial;  // its constant part
};
// A bonded side: the law at the gradient on the surface, linearised, and what displacements change.
struct BondedLaw {
  FiniteLaw law;
  Tensor F, cofactor;  // at which it is linearised
  Push push;
  Tensor stress, cofactor_change;  // A : H [Pa], and that of cof F by H,
  double volume_rate = 0.0;        // of J
};

}  // namespace momentum_faces
}  // namespace pfdm
