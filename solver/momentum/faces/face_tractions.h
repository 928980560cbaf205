#pragma once
// Interface between the momentum balance and the tractions on its faces: small strain with isotropic moduli
// (isotropic_tractions.h, history_tractions.h) or with a stress by the strain (law_tractions.h), finite strain
// (finite_tractions.h). Every call is one sweep over the faces, or concerns the preconditioner.

#include "solver/momentum/body/cell_mechanics.h"
#include "solver/momentum/faces/face_skeleton.h"
#include "solver/momentum/faces/face_springs.h"

#include <memory>
#include <mutex>
#include <vector>

namespace pfdm {

/// Result of one sweep over the faces for given displacements. The kinds of tractions add to it.
struct Sweep : FaceForces {
  explicit Sweep(const FaceSkeleton& skeleton)
      : FaceForces{.force = std::vector<Vector>(skeleton.n_forces()),
                   .sector_stress = CellField<double>(skeleton.sector_area.size(), 0.0)},
        gradients(skeleton.mesh.n_cells()) {}
  virtual ~Sweep() = default;
  Sweep(const Sweep&) = delete;
  Sweep& operator=(const Sweep&) = delete;

  CellField<Tensor> gradients;  ///< of the displacement, by least squares [-]
};

/// Sweeps that are kept for later ones, as their memory is large. Each belongs to one caller at a time.
class SpareSweeps {
 public:
  struct GiveBack {
    SpareSweeps* to;
    void operator()(Sweep* sweep) const;
  };
  using Lease = std::unique_ptr<Sweep, GiveBack>;

  /// A kept one, or what `make` makes.
  template <class Make>
  Lease take(const Make& make) {
    if (std::unique_ptr<Sweep> kept = pop()) return {kept.release(), GiveBack{this}};
    return {make().release(), GiveBack{this}};
  }

 private:
  std::unique_ptr<Sweep> pop();

  std::mutex mutex_;
  std::vector<std::unique_ptr<Sweep>> kept_;
};

class FaceTractions {
 public:
  explicit FaceTractions(const FaceSkeleton& skeleton) : skeleton_(skeleton) {}
  virtual ~FaceTractions() = default;
  FaceTractions(const FaceTractions&) = delete;
  FaceTractions& operator=(const FaceTractions&) = delete;

  SpareSweeps::Lease sweep() const {
    return spare_.take([this] { return new_sweep(); });
  }

  /// Forces on the faces by the displacements u, without what they are at u = 0.
  virtual void find_linear(const std::vector<Vector>& u, Sweep& sweep) const = 0;
  /// += what they are at u = 0, by initial stresses or by a linearisation. Returns whether there are any.
  virtual bool add_constant(Sweep& sweep) const = 0;
  void find(const std::vector<Vector>& u, Sweep& sweep) const {
    find_linear(u, sweep);
    add_constant(sweep);
  }
  /// Displacement [m] at which both sides of each face agree, after find_linear() of u; on split faces the owner's, on
  /// patches without unknowns zero.
  FaceField<Vector> face_displacements(const std::vector<Vector>& u, const Sweep& sweep) const;
  /// forces += what springs, which act by separations, change by as the faces turn [N].
  virtual void turn_springs(const Sweep&, const std::vector<FaceSpring>&, std::vector<Vector>&) const {}

  /// Rows of the pressures after find_linear() of u, V q / (lambda - lambda_s) - sum u_f.S [m^3], or what they are at
  /// finite strain.
  virtual void balance_pressures(const std::vector<Vector>&, Sweep&, std::vector<Vector>&) const {}
  /// load -= the constant part of these rows [m^3].
  virtual void take_away_constant_volumes(std::vector<Vector>&) const {}
  /// Forces of pressures of the cells, positive in tension [Pa].
  virtual void find_pressure_forces(const CellField<double>&, Sweep&) const {}
  /// Approximate diagonal of the Schur complement, per pressure [m^3/Pa].
  std::vector<double> pressure_compliance() const;

  /// Entries of the compact matrix: area times c of a link, area times a of a side [N/m]; modulus of the hoop strain
  /// [Pa].
  virtual Tensor compact_link(std::size_t link) const = 0;
  virtual Tensor compact_side(std::size_t side) const = 0;
  virtual double hoop_modulus(Index cell) const = 0;

  virtual double shear_stiffness(Index cell) const = 0;         ///< [Pa]
  virtual Tensor softness_of_side(std::size_t side) const = 0;  ///< a^-1 [m/Pa]
  /// Some cells have faces or gradients of third order.
  virtual bool has_third_order() const { return false; }
  /// Linearised about displacements, which the residual of others depends on.
  virtual bool is_linearised() const { return false; }

  /// Strains, stresses and energies of the cells; `part`: of the stiffness of each cell, whose energy is wanted.
  virtual CellMechanics mechanics(const std::vector<Vector>& u, bool with_gradient,
                                  const CellField<IsotropicElasticity>& part) const = 0;

 protected:
  virtual std::unique_ptr<Sweep> new_sweep() const = 0;
  virtual Vector link_displacement(std::size_t link, const std::vector<Vector>& u, const Sweep& sweep) const = 0;
  /// Derivative of a row of a pressure by that pressure [1/Pa], and modulus lambda + 2 mu of the cell without it [Pa].
  struct PressureRow {
    double slope = 0.0, modulus = 1.0;
  };
  virtual PressureRow pressure_row(std::size_t) const { return {}; }

  const FaceSkeleton& skeleton_;

 private:
  mutable SpareSweeps spare_;
};

}  // namespace pfdm
