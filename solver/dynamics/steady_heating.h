#pragma once
// A heated body whose source stays as it is: the surface at the end of every step, for the price of a few steps.

#include "solver/dynamics/heated_body.h"

#include <string>
#include <vector>

namespace pfdm {

/// Of a patch at the ends of n steps of dt [s], from rise zero on: what HeatedBody says, within `precision` of the
/// largest rise. A step is an affine map, rise -> B rise + b, so that all rises lie in the Krylov space of B and b; by
/// Arnoldi's method some thirty vectors stand for hundreds of steps (Saad, Iterative Methods for Sparse Linear Systems,
/// SIAM 2003, section 6.3). source: [W/m^3]. Throws ComputationError if a step's equation is not solved, InputError
/// like Diffusion.
std::vector<SurfaceTemperature> surface_under_steady_source(const Mesh& mesh, const HeatedMaterial& material,
                                                            const std::vector<DiffusionBoundary>& boundary,
                                                            const CellField<double>& source, const std::string& patch,
                                                            double dt, int n, double precision = 1e-7);

}  // namespace pfdm
