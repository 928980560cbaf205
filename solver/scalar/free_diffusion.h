#pragma once
// Diffusion without sources, c du/dt - div(k grad u) = 0, that is cooled to zero: steps of one length by backward
// Euler, whose matrix is factored once.

#include "solver/scalar/diffusion_boundary.h"
#include "solver/scalar/two_point_flux.h"

#include <Eigen/SparseCholesky>

#include <vector>

namespace pfdm {

class FreeDiffusion {
 public:
  /// k [W/(m K)] and c [J/(m^3 K)] of the cells, as of heat, both positive. Values and surroundings of the boundary
  /// count as zero, given fluxes too. dt: [s]. `precision`: change of u, over its size, from which on a step has
  /// converged. Throws InputError like exchanges_of(), ComputationError if the matrix cannot be factored.
  FreeDiffusion(const Mesh& mesh, const CellField<double>& conductivity, const CellField<double>& capacity,
                std::vector<DiffusionBoundary> boundary, double dt, double precision);

  /// Changes u to its value a step later. Returns whether that converged.
  bool step(CellField<double>& u);

 private:
  Eigen::SparseMatrix<double> two_point_part() const;  // lower triangle of the matrix of a step

  TwoPointFlux flux_;
  CellField<double> stored_;  // of each cell, c times the volume over dt
  double precision_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace pfdm
