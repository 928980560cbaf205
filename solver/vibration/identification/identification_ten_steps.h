#pragma once
// The report's iteration (A4.3), with all that it did on the way.

#include "solver/vibration/identification/identification_regression.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace pfdm {

/// A term of the Prony series, and the energy of its impulse response within ten_step_duration (A15, A16).
struct PronyTerm {
  HereditaryTerm term;
  double energy = 0.0;  ///< SI; [N^2 s/m^2] where z' [m/s] drives v [N]
  bool kept = false;    ///< among those of the most energy
};

struct TenStep {
  double damping = 0.0;
  std::vector<double> stiffness;
  double misfit = 0.0;  ///< of the equation of motion, relative
};

struct TenSteps {
  Regression regression;
  std::vector<TenStep> iterations;
  bool settled = false;           ///< by the report's rule, before the largest number of iterations
  std::vector<PronyTerm> series;  ///< of the last iteration, the most energy first (A19, A20)
  Eigen::VectorXd frequency;      ///< of the excited band [Hz]
  Eigen::VectorXcd response;      ///< of v on f, from the record, H1
};

constexpr double ten_step_duration = 0.02;  ///< of the impulse responses whose energies are compared [s]

/// The report's iteration for kernels of higher order (A4.3): Prony series of `prony_order` terms, cut to
/// `kernel_order` by energy. Takes the first record alone. For comparison: it stops near where it starts.
TenSteps ten_steps(std::span<const VibrationRecord> records, const ModelStructure& structure, int kernel_order,
                   const IdentificationSettings& settings, int prony_order = 40, int maximum_iterations = 100);

/// g(t) = sum beta exp(-alpha t), of a pair 2 Re[beta exp(-alpha t)], at t = 0, 1/rate ...
Eigen::VectorXd impulse_response(std::span<const HereditaryTerm> terms, Eigen::Index n, double rate);

/// Transform of the impulse response, at these frequencies [Hz].
Eigen::VectorXcd frequency_response(std::span<const HereditaryTerm> terms, const Eigen::VectorXd& frequency);

}  // namespace pfdm
