#include "solver/fracture/model/relaxing_volume.h"

#include "physics/materials/prony.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfdm {

PoissonRange poisson_range(const Material& material) {
  PoissonRange range{material.elasticity(), material.elasticity()};
  const PronyLaw* law = material.relaxing();
  if (law == nullptr) return range;
  const auto consider = [&](const IsotropicElasticity& at) {
    if (at.poisson_ratio() < range.least.poisson_ratio()) range.least = at;
    if (at.poisson_ratio() > range.greatest.poisson_ratio()) range.greatest = at;
  };
  const IsotropicElasticity relaxed = material.relaxed_elasticity();
  consider(relaxed);
  consider(instantaneous_elasticity(*law));
  if (law->shear.empty() || law->bulk.empty()) return range;  // nu rises or falls all the time
  const auto left = [](const std::vector<PronyBranch>& branches, double time) {
    double sum = 0.0;
    for (const PronyBranch& branch : branches) sum += branch.modulus * std::exp(-time / branch.time);
    return sum;
  };
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const auto* branches : {&law->shear, &law->bulk})
    for (const PronyBranch& branch : *branches)
      least = std::min(least, branch.time), most = std::max(most, branch.time);
  constexpr double step = 1.3;
  for (double time = 0.1 * least; time < 30.0 * most; time *= step) {
    const double mu = relaxed.mu + left(law->shear, time), K = relaxed.bulk_modulus() + left(law->bulk, time);
    consider({.lambda = K - 2.0 * mu / 3.0, .mu = mu});
  }
  return range;
}

bool relaxes_with_pressure(const Material& material) {
  constexpr double most_without = 0.4 + 1e-6;
  return material.relaxing() != nullptr && poisson_range(material).greatest.poisson_ratio() > most_without;
}

}  // namespace pfdm
