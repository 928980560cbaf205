#pragma once
// Derivatives of the states of a run by parameters of its model, direct differentiation: at an accepted state, with
// the damage held that is on a bound, R(u, d; p) = 0 gives
//
//   [A_uu A_ud; A_du A_dd] (u', d') = -(dR_u/dp, dR_d/dp)
//
// (Kleiber, Antunez, Hien, Kowalczyk, Parameter Sensitivity in Nonlinear Mechanics, 1997, ch. 4). The right side is the
// difference of R between two models at the one state, so that every law enters by its own evaluation; held damage and
// the histories of cohesive faces bring their derivative from the step before. The matrix may be inexact: R of the
// other model at the state moved by u', d' tells what is left, and is solved for again.
//
// A jump begins where the matrix is singular. With its null vector l and the load t the jump is at
// l.(R_p + R_t t') = 0; l is found by inverse iteration from the derivative by the load, and the matrix is symmetric
// but for what the discrete gradients are not.

#include "solver/fracture/derivatives/unbalanced.h"

#include <memory>
#include <string>
#include <vector>

namespace pfdm {

class CoupledSystem;

class RunDerivatives {
 public:
  /// Why a run has no such derivatives, as the end of a sentence "... has"; empty if it has.
  static std::string refusal(const Mesh& mesh, const FractureModel& model, const LoadingSettings& loading);

  /// Keeps a reference to the mesh.
  RunDerivatives(const Mesh& mesh, const FractureModel& model, const StaggeredSettings& settings);
  ~RunDerivatives();
  /// One more parameter, before the first step: the model with its value greater by the relative `step`, small. Throws
  /// InputError if that model has other unknowns.
  void add(const FractureModel& shifted, double step);

  /// After an accepted step from `start` to `state`. `jumped`: a jump lies between them. What it leaves as it was, held
  /// damage and separations that were reached before, then has the derivative along the jump's load; jump() is about
  /// it.
  void follow(const FractureState& start, const FractureState& state, bool jumped = false);

  /// Of the last step, by ln p at fixed load.
  struct Derivative {
    std::vector<Vector> reaction;            ///< force on each patch [N]
    std::vector<Vector> patch_displacement;  ///< area mean on each patch [m]
    std::vector<Vector> displacement;        ///< of all unknowns [m]
    CellField<double> damage;                ///< [-]
    double unsolved = 0.0;                   ///< share of the right side that is left
    Index iterations = 0;                    ///< of FGMRES
  };
  const Derivative& by(std::size_t parameter) const;
  const Derivative& by_load() const;  ///< by ln t
  Index iterations() const;           ///< of FGMRES, for all of them in the last step

  /// Of the load t of the last jump that was followed.
  struct Jump {
    double load = 0.0;     ///< d ln t/d ln p
    double changed = 0.0;  ///< difference from what the state before the last one says of it
  };
  const Jump& jump(std::size_t parameter) const;

 private:
  struct Model;
  struct Parameter;
  struct Step;
  struct Linearised;
  std::unique_ptr<Parameter> parameter(const FractureModel& model, double step, bool is_load);
  Step step_of(const FractureState& start, const FractureState& state) const;
  Linearised linearised(const Step& step);
  std::vector<Vector> inherited(const Step& step, const CoupledSystem& system, const Parameter& parameter) const;
  void extrapolate(double share, const CoupledSystem& system, const Parameter& parameter, std::vector<Vector>& x) const;
  void differentiate(const Step& step, Linearised& at, Parameter& parameter);
  void keep(const Step& step, const Linearised& at, const FractureState& moved, const Unbalanced& rest,
            Parameter& parameter) const;
  /// Returns the scale of the equations there.
  std::vector<double> find_jump(const Step& last, std::vector<Vector> Parameter::*right_side);
  void go_to_jump(const FractureState& last, const std::vector<double>& scale, Parameter& parameter) const;

  const Mesh& mesh_;
  StaggeredSettings settings_;
  std::unique_ptr<Model> base_;
  std::unique_ptr<Parameter> load_;
  std::vector<std::unique_ptr<Parameter>> parameters_;
  std::unique_ptr<Step> last_, earlier_;  // that were followed
};

}  // namespace pfdm
