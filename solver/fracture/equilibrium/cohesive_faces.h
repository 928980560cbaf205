#pragma once
// Cohesive interfaces without thickness: interior faces of the mesh whose sides are independent (unknowns.h), joined by
// a law of their separation (physics/interfaces/interface_law.h). Equilibrium: cohesive_newton.h.
//
// An interface that is rigid at first has the stiffness of the cells beside it, C^-1 = (h_P/M_P + h_N/M_N)^-1, times
// 1000: it gives by a thousandth of what they do, and stiffens in compression likewise.
//
// Finite strain: separation and traction are those of a pair of points that were one, the traction per reference area.
// The law sees them in a frame that follows the body. Its normal n is the mean of the unit normals of both sides, cof F
// N / |cof F N| with F of the cells beside the face (two arcs of one circle that have slid along each other then touch,
// to the second order). Opened interfaces pull along their separation, and have no moment. The pressure of closed ones
// does have one once they have slid, p |slip| per area, which nothing balances. Contact is between points that were
// one, and right as long as they stay neighbours. Separations and n are those about which the balance is linearised.
//
// Where the law falls more steeply than C^-1 the two cells tear a face at a jump, whatever the load does elsewhere. The
// solution of one face is unique, and the process zone resolved, only with smaller cells (warnings).

#include "solver/fracture/equilibrium/face_normals.h"
#include "solver/fracture/model/fracture_model.h"
#include "solver/fracture/model/state.h"
#include "solver/momentum/solution/momentum_solver.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

class CohesiveFaces {
 public:
  /// Throws InputError for a face of two surfaces, one that is not interior, and a rise that takes all of the
  /// toughness.
  CohesiveFaces(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns);

  bool any() const { return !faces_.empty(); }
  bool has_rate_laws() const;
  /// Whether no face has dissipated anything yet, and none can rub.
  bool are_sound(const std::vector<InterfaceHistory>& histories) const;
  /// Forces of each face without a separation [N]: those of the branches while it is whole, and what laws of one's own
  /// remember, as of a plastic separation. Empty without either.
  std::vector<Vector> held_forces(const std::vector<InterfaceHistory>& histories) const;
  /// Begins a load step, which takes `duration` [s].
  void start_step(double duration) { duration_ = duration; }
  std::vector<InterfaceHistory> virgin_histories() const { return std::vector<InterfaceHistory>(faces_.size()); }

  enum class Way { tangent, convex };
  /// Gives the momentum balance the laws about the displacements u, after `before`; `after` as settle() has left it.
  void linearise(const std::vector<Vector>& u, const std::vector<InterfaceHistory>& before,
                 const std::vector<InterfaceHistory>& after, Way way, MomentumSolver& momentum) const;
  /// Moves the sides of each face to where its law and the cells beside it balance, everything else held. Of faces
  /// whose traction depends on the rate of opening the overstress goes into `after`.
  void settle(const std::vector<InterfaceHistory>& before, const MomentumOperator& balance, std::vector<Vector>& u,
              std::vector<InterfaceHistory>& after) const;
  /// Takes the histories from `before` to the displacements u, with the overstresses that `after` has. Returns the
  /// stored energy [J].
  double advance(const MomentumOperator& balance, const std::vector<Vector>& u,
                 const std::vector<InterfaceHistory>& before, std::vector<InterfaceHistory>& after) const;
  /// Energy dissipated by decohesion and friction from one state to the other [J].
  double dissipated(const std::vector<InterfaceHistory>& from, const std::vector<InterfaceHistory>& to) const;
  /// Energy dissipated by the rate of opening and by branches from one state to the other [J].
  double viscous_dissipation(const std::vector<InterfaceHistory>& from, const std::vector<InterfaceHistory>& to) const;
  /// Heat that each face makes from one state to the other [J]; of decohesion only this share of the energy.
  std::vector<double> heat(const std::vector<InterfaceHistory>& from, const std::vector<InterfaceHistory>& to,
                           double debonding_share) const;
  /// Whether each face has debonded and its sides do not touch.
  std::vector<char> parted(const MomentumOperator& balance, const std::vector<Vector>& u,
                           const std::vector<InterfaceHistory>& histories) const;
  /// Debonded area of each surface [m^2], where nine tenths of the toughness or more are dissipated: that of the mode
  /// in which the face is loaded.
  std::vector<double> debonded_areas(const MomentumOperator& balance, const std::vector<Vector>& u,
                                     const std::vector<InterfaceHistory>& histories) const;
  /// Energy dissipated from one state to that of the displacements u [J].
  double dissipated_at(const MomentumOperator& balance, const std::vector<Vector>& u,
                       const std::vector<InterfaceHistory>& from) const;
  /// Growth of the dissipated energy as the displacements u change by `change`, to first order and without friction
  /// [J].
  double dissipation_growth(const MomentumOperator& balance, const std::vector<Vector>& u,
                            const std::vector<InterfaceHistory>& from, const std::vector<Vector>& change) const;
  std::vector<OutputInterface> output(const MomentumOperator& balance, const FractureState& state) const;
  /// A line for each surface with cells too large for its law.
  std::vector<std::string> warnings() const;

 private:
  struct Face {
    std::size_t surface;
    FaceSides sides;  // owner and neighbour
    double area;
    InterfaceStrength at;
  };
  void add(std::size_t number, const CohesiveSurface& surface, std::size_t k);
  double bond(Index face) const;
  Vector normal(const Face& face, const MomentumOperator& balance) const { return normals_->at(face.sides, balance); }
  InterfaceResponse respond(Index k, const Vector& n, const Vector& separation, const InterfaceHistory& before,
                            const InterfaceHistory& after) const;
  bool has_rate(const Face& face) const { return duration_ > 0.0 && law(face).rate.any(); }
  bool has_debonded(std::size_t k, const Vector& n, const Vector& separation, const InterfaceHistory& history) const;
  const InterfaceLaw& law(const Face& face) const { return model_.interfaces[face.surface].law; }

  const Mesh& mesh_;
  const FractureModel& model_;
  std::unique_ptr<FaceNormals> normals_;
  std::vector<Face> faces_;
  std::vector<double> bond_;  // C^-1 of each [Pa/m]
  double duration_ = 0.0;     // of the step [s]
};

}  // namespace pfdm
