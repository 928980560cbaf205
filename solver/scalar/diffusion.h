#pragma once
// Diffusion of a scalar field u, as of heat: steady, -div(k grad u) = q(u), and transient, c du/dt - div(k grad u) =
// q(u), by backward Euler. u is the temperature [K], say, with k [W/(m K)], c [J/(m^3 K)] and q [W/m^3]; nothing here
// depends on that. Non-linear sources by Newton's method.

#include "mesh/mesh.h"
#include "solver/scalar/bounded_newton.h"
#include "solver/scalar/diffusion_boundary.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pfdm {

/// A source and its derivative.
struct DiffusionSource {
  double value = 0.0;  ///< [W/m^3]
  double slope = 0.0;  ///< d value/du, at most zero for a unique solution [W/(m^3 K)]
};

struct DiffusionProblem {
  CellField<double> conductivity;  ///< k, positive
  CellField<double> capacity{};    ///< c; transient problems only
  std::vector<DiffusionBoundary> boundary;
  std::function<DiffusionSource(Index cell, double u)> source{};  ///< empty: none
  Vector plane_normal = Vector::Zero();                           ///< of one-cell-thick meshes
  FaceField<double> resistance{};  ///< across each interior face [m^2 K/W], infinite: insulated; or empty
  double precision = 1e-9;         ///< change of u, over its size, from which on a solution has converged
};

class Diffusion {
 public:
  /// Throws InputError for an unknown patch, one that is named twice, an exchange whose coefficient is not positive, or
  /// fields that are not positive or not of the mesh.
  Diffusion(const Mesh& mesh, DiffusionProblem problem);
  ~Diffusion();

  /// Changes u, the first guess, to the steady solution. Throws InputError if nothing fixes its level.
  ScalarSolution solve_steady(CellField<double>& u);

  /// Changes u to its value a time dt [s] later.
  ScalarSolution step(double dt, CellField<double>& u);

  /// Through a patch, out of the body [W].
  double outflow(const std::string& patch, const CellField<double>& u) const;

 private:
  struct Parts;
  ScalarSolution solve(double rate, CellField<double>& u);
  std::unique_ptr<Parts> parts_;
};

}  // namespace pfdm
