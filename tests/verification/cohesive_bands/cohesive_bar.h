#pragma once
// A bar with a cohesive crack, and the stress that its phase field produces.

#include "physics/closed_forms/bars.h"
#include "tests/verification/bar.h"

#include <string>

namespace pfdm::verification {

/// A bar with a cohesive crack, half an Irwin length E Gc/ft^2 long whatever ell. The law's foot needs cells of a
/// hundredth of ell where the bar breaks: the last cell still carries 0.13 h/ell of the strength when it should carry
/// none, and the residual stiffness k of a cell as much as 2 k E Gc/(ft^2 h).
inline BarSettings cohesive_bar(const std::string& softening, double irwin_lengths) {
  return {.law = "Wu",
          .softening = softening,
          .irwin_lengths = irwin_lengths,
          .cells_per_length = 5,
          .refinement = 21,
          .length = 0.5 * irwin_lengths,
          .weak_cells = 147,
          .weakness = 3e-3,
          .tolerance = 1e-6,
          .residual_stiffness = 1e-9};
}

/// Stress over strength that a cohesive phase field produces at a separation times strength / Gc.
inline double produced_stress(const SofteningLaw& law, double separation) {
  double low = 1e-12, high = 1.0 - 1e-9;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (pfczm_softening(law, 1.0, 1.0, middle).separation < separation ? low : high) = middle;
  }
  return pfczm_softening(law, 1.0, 1.0, low).stress;
}

}  // namespace pfdm::verification
