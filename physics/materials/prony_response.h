#pragma once
// Closed response of linear viscoelastic material to one strain or stress: relaxation moduli and creep compliances as
// series of exponentials, and the way from one to the other.
//
//   M(t) = M_inf + sum M_i exp(-t/tau_i),   J(t) = J_0 + sum J_k (1 - exp(-t/lambda_k)),
//
// whose Carson transforms are each other's reciprocals: the retardation rates 1/lambda_k are the zeros of M, one
// between every two relaxation rates 1/tau_i (Gross, Mathematical Structure of the Theories of Viscoelasticity, 1953;
// Park, Schapery, Int. J. Solids Struct. 36 (1999) 1653). In uniaxial stress the compliances add,
//
//   D = J_shear/3 + J_bulk/9,   E = 1/D,
//
// so that tension too is a series of exponentials, and exact for strains (stresses) that are linear in the steps.

#include "physics/materials/prony.h"

#include <complex>
#include <span>
#include <string_view>
#include <vector>

namespace pfdm {

/// Relaxed modulus [Pa], and branches by rising time.
struct RelaxationModulus {
  double relaxed = 0.0;
  std::vector<PronyBranch> branches{};

  double instantaneous() const;  ///< with all branches [Pa]
};

struct Retardation {
  double compliance = 0.0;  ///< [1/Pa]
  double time = 0.0;        ///< retardation time lambda [s]
};

/// Instantaneous compliance [1/Pa], and what comes later, by rising time.
struct CreepCompliance {
  double instantaneous = 0.0;
  std::vector<Retardation> retardations{};
};

RelaxationModulus shear_modulus(const PronyLaw& law);
RelaxationModulus bulk_modulus(const PronyLaw& law);
RelaxationModulus young_modulus(const PronyLaw& law);

/// Of a test: uniaxial stress with its strain, or shear stress with the engineering shear strain.
enum class Deformation { tension, shear };
/// "tension", "shear".
std::string_view name_of(Deformation deformation);
RelaxationModulus modulus_in(const PronyLaw& law, Deformation deformation);

/// Each the inverse of the other. Moduli, compliances and times must be positive; branches of one time become one.
CreepCompliance creep_compliance(const RelaxationModulus& modulus);
RelaxationModulus relaxation_modulus(const CreepCompliance& compliance);

/// Storage and loss modulus [Pa] as real and imaginary part, at an angular frequency [rad/s].
std::complex<double> complex_modulus(const RelaxationModulus& modulus, double angular_frequency);

/// Stresses [Pa] at the times [s], which rise, of strains that are linear in between. What the first strain is, it is
/// at once: a step, unless it is zero.
std::vector<double> stress_response(const RelaxationModulus& modulus, std::span<const double> times,
                                    std::span<const double> strains);
/// Strains of stresses [Pa], likewise.
std::vector<double> strain_response(const CreepCompliance& compliance, std::span<const double> times,
                                    std::span<const double> stresses);

}  // namespace pfdm
