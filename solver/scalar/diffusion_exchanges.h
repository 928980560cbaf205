#pragma once
// Conditions of diffusion on patches as exchanges of two-point fluxes; shared by the files of diffusion.

#include "solver/scalar/diffusion_boundary.h"
#include "solver/scalar/two_point_flux.h"

#include <vector>

namespace pfdm {

/// Of all conditions but given fluxes, a face each. Throws InputError for an unknown patch, or an exchange whose
/// coefficient is not positive.
std::vector<Exchange> exchanges_of(const Mesh& mesh, const std::vector<DiffusionBoundary>& boundary);

}  // namespace pfdm
