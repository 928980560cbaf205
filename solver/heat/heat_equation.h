#pragma once
// Transient conduction of heat that is made in cells and on interfaces,
//
//   rho c dT/dt = div(k grad T) + q,   [k dT/dn] = q_f on interfaces,
//
// by the two-stage, second-order, L-stable scheme of Alexander (SIAM J. Numer. Anal. 14 (1977) 1006), gamma = 1 -
// 2^-1/2:
//
//   T_1 = T_n + gamma dt f(T_1),  T_(n+1) = T_n + (1 - gamma) dt f(T_1) + gamma dt f(T_(n+1)),
//
// which are two steps of backward Euler, the second from T_n + (1 - gamma)/gamma (T_1 - T_n). Steps that are long
// against the time of diffusion from cell to cell can overshoot by a few per cent of what a sudden change leaves.
//
// An interface face has a conductance h beside those of its cells, a = k/distance: its transmittance is
// U = (1/a_P + 1/h + 1/a_N)^-1. What it makes arises in equal parts on both sides and flows as the three resistances
// let it: (1/a_N + 1/(2h)) U of it into the owner, the rest into the neighbour.

#include "mesh/mesh.h"
#include "solver/heat/heat_state.h"
#include "solver/scalar/diffusion.h"

#include <memory>
#include <vector>

namespace pfdm {

struct HeatBody {
  CellField<double> conductivity;             ///< [W/(m K)]
  CellField<double> capacity;                 ///< rho c [J/(m^3 K)]
  std::vector<DiffusionBoundary> boundary{};  ///< of rises; patches that are not named are insulated
  std::vector<Index> interfaces{};            ///< interior faces with a transmittance of their own, none twice
  Vector plane_normal = Vector::Zero();       ///< of one-cell-thick meshes
};

class HeatEquation {
 public:
  /// Interfaces conduct perfectly at first. Throws InputError like Diffusion.
  HeatEquation(const Mesh& mesh, HeatBody body);
  HeatEquation(const HeatEquation&) = delete;
  HeatEquation& operator=(const HeatEquation&) = delete;
  ~HeatEquation();

  /// Of interface face number k at a conductance, zero to infinity [W/(m^2 K)].
  double transmittance(std::size_t k, double conductance) const;
  /// Of each interface face from now on [W/(m^2 K)].
  void set_transmittance(const std::vector<double>& transmittance);
  /// heat += the cells' parts of what each interface face makes [J].
  void add_interfaces(const std::vector<double>& made, CellField<double>& heat) const;

  /// Takes the rises [K] a time dt [s] on, in which each cell is given `heat` [J] evenly. Throws ComputationError if
  /// the equation is not solved.
  void step(double dt, const CellField<double>& heat, CellField<double>& rise, HeatBalance& account);
  /// `n` equal steps under a source of each cell [W]; rows of the beginning and of each step, accounts from here on.
  std::vector<HeatRow> under_steady_source(const CellField<double>& power, double time, Index n,
                                           CellField<double>& rise);
  HeatFigures figures(const CellField<double>& rise) const;

 private:
  double resistance_beside(std::size_t k) const;  // of both cells [m^2 K/W]
  double give(Index face, Index cell) const;      // 1/a [m^2 K/W]
  double outflow(const CellField<double>& rise) const;
  double stored(const CellField<double>& rise) const;
  void build();

  const Mesh& mesh_;
  HeatBody body_;
  std::vector<double> transmittance_;
  CellField<double> source_;  // of the step under way [W/m^3]
  std::unique_ptr<Diffusion> diffusion_;
};

}  // namespace pfdm
