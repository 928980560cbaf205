#pragma once
// Mechanical state of the cells for given displacements.

#include "mesh/fields.h"
#include "physics/elasticity/mandel.h"

#include <vector>

namespace pfdm {

/// Difference of the strain of a cell at one of its faces from that of the cell, as the tractions of bodies with a
/// history have it: (u_f - u_c - G d)/h, borne by (sym(gap n^T) : C) n, and what else the strain on the face has. At
/// finite strain turned back with the cell.
struct FaceGap {
  Vector strain = Vector::Zero();  ///< as shear moduli bear it [-]
  double along = 0.0;              ///< along the normal, as bulk moduli bear it [-]
  double volume = 0.0;             ///< A h [m^3]: half of it times traction and gap is an energy; 0: there is no force
  double by_shear = 0.0;           ///< stiffness along the normal over the shear modulus, and
  double by_bulk = 0.0;            ///< over the bulk modulus besides
};

/// Stress that a relaxing material has on a face where the strain there does not differ from the cell's. It is shear
/// moduli times the remainder of earlier gaps (CellMechanics::gaps), and bulk moduli times that along the normal.
struct GapStress {
  Vector shear = Vector::Zero();  ///< [Pa]
  double bulk = 0.0;              ///< [Pa]
};

/// Volume change of a relaxing cell with a pressure: by its gradient and by the flux through its faces [-]; zero in
/// other cells.
struct VolumeChanges {
  double by_gradient = 0.0, by_flux = 0.0;
};

/// Strain, stress and energy of the cells for a given displacement.
struct CellMechanics {
  CellField<Tensor> strain;  ///< from the two-sided face displacements (Green-Gauss) [-]
  /// Part of the strain that makes no stress; at finite strain F* - 1 of the free deformation [-]; empty: none.
  CellField<Mandel> eigenstrain{};
  /// Moment of the tractions where there are eigenstrains at small strain: sum A t (x) (x_f - x_c), with the stress
  /// across a plane mesh [J]; else empty.
  CellField<Mandel> traction_moment{};
  CellField<Tensor> gradient;  ///< of the displacement, du_i/dx_j, likewise [-]; empty if not wanted
  CellField<Tensor> stress;    ///< traction moment (1/V) sum A t (x) (x_f - x_c) [Pa]
  /// Elastic energy 1/2 sum A t.(u_f - u_c) over a cell's faces [J]; sums to half the external work. Of eigenstrains
  /// less half the work of the traction moment on them. At finite strain, where `stress` is the first Piola-Kirchhoff
  /// stress: half the work of what tractions and face displacements differ by from those of the mean gradient, 1/2 sum
  /// A t.(u_f - u_c - gradient d).
  CellField<double> energy;
  /// Energy at finite strain beside `energy`: half the work of the moment of a cell's tractions about its centre, at
  /// its rotation beyond that of the whole body [J]; zero where it is not counted; empty: nowhere.
  CellField<double> moment_work{};
  /// Energy of a part of the stiffness, its share in `energy` per volume [J/m^3],
  ///
  ///   (1/2V) sum A (u_f - u_c).(part : eps_f) n,  eps_f = sym(G + (u_f - u_c - G d) n^T / h),
  ///
  /// eps_f being the strain from which a face's traction is computed; it varies between the faces of a cell. Never of
  /// the other sign than the energy of `strain`. Empty if none is given, zero where the part has no moduli.
  CellField<double> part_energy{};
  /// Strain by least squares, as used in the tractions of the faces, with the volume change that belongs to the
  /// pressure in cells that have one [-]; empty unless some material is linearised.
  CellField<Tensor> reconstructed_strain{};
  /// Displacement gradients at which the laws of finite strain were taken, of the cells and then of the sides that have
  /// their own [-]; empty without relaxing materials.
  std::vector<Tensor> gradients_of_laws{};
  CellField<VolumeChanges> volume_changes{};  ///< empty without relaxing materials
  std::vector<FaceGap> gaps{};                ///< as Mesh::cell_faces; empty without relaxing materials
  /// Volume change J - 1 at finite strain, in nearly incompressible bodies [-]: in cells with a pressure by the volume
  /// of the moved cell, in others by the mean gradient. Else empty.
  CellField<double> volume_change{};
  /// Stress less the share of the pressures, where `volume_change` is given [Pa]. `energy` is then without their work.
  CellField<Tensor> moderate_stress{};
  FaceField<Vector> face_displacement{};  ///< [m]; zero on the front and back of plane and axisymmetric meshes

  Tensor elastic_strain(Index cell) const {
    return eigenstrain.size() > 0 ? (strain[cell] - to_tensor(eigenstrain[cell])).eval() : strain[cell];
  }
};

}  // namespace pfdm
