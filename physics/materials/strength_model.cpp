#include "physics/materials/strength_model.h"

#include "physics/materials/biot_stress.h"
#include "physics/quantity_text.h"
#include "physics/registry.h"

#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

constexpr double sqrt3 = std::numbers::sqrt3;

double sqrt_J2(const Tensor& sigma) {
  const Tensor s = deviator(sigma);
  return std::sqrt(0.5 * contract(s, s));
}

// Drucker, Prager: sqrt(J2) + ts/(sqrt3 (3 hs - ts)) I1 = sqrt3 ts hs/(3 hs - ts). delta and coefficients: Larsen,
// Dolbow, Lopez-Pamies 2024; that of a mesh is for linear finite elements, in which a crack breaks a row of size h.
constexpr StrengthLaw drucker_prager{
    .name = "strength",
    .description =
        "AT1 and a Drucker-Prager strength surface, by strength and hydrostatic_strength (Kumar 2020, Larsen 2024)",
    .crack = "AT1",
    .surface =
        [](const StrengthData& d, double trace, double shear) {
          return ((3.0 * d.hydrostatic - d.tensile) * shear + d.tensile / sqrt3 * trace) /
                 (sqrt3 * d.tensile * d.hydrostatic);
        },
    .delta =
        [](const StrengthData& d, double h) {
          const double bracket =
              (d.tensile + (1.0 + 2.0 * sqrt3) * d.hydrostatic) / ((8.0 + 3.0 * sqrt3) * d.hydrostatic);
          const double sharp = bracket * largest_length(d) / d.ell;
          if (h == 0.0) return sharp + 3.0 / 8.0;
          const double widening = 1.0 + 3.0 * h / (8.0 * d.ell);
          return sharp / (widening * widening) + 0.4 / widening;
        },
    .coefficients =
        [](const StrengthData& d, double delta) {
          const double ts = d.tensile, hs = d.hydrostatic, surface = delta * d.Gc / (8.0 * d.ell);
          const auto [W_ts, W_hs] = energies_at_strengths(d);
          return StrengthCoefficients{.by_shear = sqrt3 * (3.0 * hs - ts) / (hs * ts) * surface +
                                                  2.0 * W_hs / (sqrt3 * hs) - 2.0 * sqrt3 * W_ts / ts,
                                      .by_trace = surface / hs - 2.0 * W_hs / (3.0 * hs)};
        },
};

constexpr StrengthLaw all_strength_laws[] = {drucker_prager};

void require_surface(const StrengthData& data) {
  if (data.tensile > 0.0 && 3.0 * data.hydrostatic > data.tensile) return;
  throw InputError(
      fmt::format("the strength in hydrostatic tension is {}, that in uniaxial tension {}; expected more than a third "
                  "of the latter",
                  quantity_text(data.hydrostatic, "Pa"), quantity_text(data.tensile, "Pa")));
}

}  // namespace

double hydrostatic_strength(double tensile, double compressive) {
  if (!(tensile > 0.0 && compressive > tensile))
    throw InputError(fmt::format("the compressive strength is {}; expected more than the tensile one, {}",
                                 quantity_text(compressive, "Pa"), quantity_text(tensile, "Pa")));
  return 2.0 / 3.0 * tensile * compressive / (compressive - tensile);
}

StrengthEnergies energies_at_strengths(const StrengthData& data) {
  const double ts = data.tensile, hs = data.hydrostatic;
  if (const auto* finite = dynamic_cast<const HyperelasticMaterial*>(data.material.get()))
    return {energy_at_biot_stress(*finite, ts * Vector::UnitX()), energy_at_biot_stress(*finite, hs * Vector::Ones())};
  return {0.5 * ts * ts / data.elasticity.young_modulus(), 0.5 * hs * hs / data.elasticity.bulk_modulus()};
}

double largest_length(const StrengthData& data) { return 3.0 * data.Gc / (16.0 * energies_at_strengths(data).tensile); }

StrengthModel::StrengthModel(const StrengthLaw& law, const StrengthData& data, double delta)
    : law_(&law), data_(data), delta_(delta), coefficients_((require_surface(data), law.coefficients(data, delta))) {}

double StrengthModel::force(const Tensor& sigma) const {
  return coefficients_.by_shear * sqrt_J2(sigma) + coefficients_.by_trace * sigma.trace();
}

double StrengthModel::surface(const Tensor& sigma) const { return law_->surface(data_, sigma.trace(), sqrt_J2(sigma)); }

std::span<const StrengthLaw> strength_laws() { return all_strength_laws; }

const StrengthLaw& strength_law(std::string_view name) { return find_by_name(strength_laws(), name, "strength model"); }

}  // namespace pfdm
