#include "physics/degradation.h"

#include "physics/registry.h"

namespace pfdm {
namespace {

constexpr Degradation quadratic{
    .name = "quadratic",
    .description = "g = (1 - d)^2",
    .g = [](double d) { return (1.0 - d) * (1.0 - d); },
    .g_prime = [](double d) { return -2.0 * (1.0 - d); },
    .g_second = [](double) { return 2.0; },
};

constexpr Degradation table[] = {quadratic};

}  // namespace

std::span<const Degradation> degradations() { return table; }

const Degradation& degradation(std::string_view name) {
  return find_by_name(degradations(), name, "degradation function");
}

}  // namespace pfdm
