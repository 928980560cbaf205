#include "physics/hardening.h"

#include "physics/registry.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr LawParameter saturating_parameters[] = {{"f_inf", "1"}, {"b", "1"}, {"f_0", "1", false, 1.0}};
constexpr LawParameter linear_parameters[] = {{"b", "1", true}, {"f_0", "1", false, 1.0}};
constexpr LawParameter power_parameters[] = {{"zeta_0", "1"}, {"n", "1", true}, {"f_0", "1", false, 1.0}};
constexpr LawParameter logarithmic_parameters[] = {{"c", "1", true}, {"reference_rate", "1/s"}};
constexpr LawParameter rate_power_parameters[] = {{"m", "1", true}, {"reference_rate", "1/s"}};

FactorValue one(std::span<const double>, double) { return {1.0, 0.0}; }

FactorValue saturating(std::span<const double> p, double zeta) {
  const double rest = (p[2] - p[0]) * std::exp(-p[1] * zeta);
  return {p[0] + rest, -p[1] * rest};
}

FactorValue power(double base, double exponent, double scale) {
  const double value = std::pow(base, exponent);
  return {value, exponent * value / (base * scale)};
}

/// Linear between the points, constant before the first and after the last.
FactorValue interpolated(std::span<const double> p, double zeta) {
  const std::size_t n = p.size() / 2;
  const auto x = p.first(n), f = p.last(n);
  const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), zeta) - x.begin());
  if (above == 0) return {f.front(), 0.0};
  if (above == n) return {f.back(), 0.0};
  const double slope = (f[above] - f[above - 1]) / (x[above] - x[above - 1]);
  return {f[above - 1] + slope * (zeta - x[above - 1]), slope};
}

constexpr FactorLaw hardening_table[] = {
    {"constant", "f = 1", {}, false, one},
    {"saturating", "f = f_inf + (f_0 - f_inf) exp(-b zeta)", saturating_parameters, false, saturating},
    {"linear", "f = f_0 + b zeta", linear_parameters, false,
     [](std::span<const double> p, double zeta) {
       return FactorValue{p[1] + p[0] * zeta, p[0]};
     }},
    {"power", "f = f_0 (1 + zeta/zeta_0)^n", power_parameters, false,
     [](std::span<const double> p, double zeta) {
       const FactorValue v = power(1.0 + zeta / p[0], p[1], p[0]);
       return FactorValue{p[2] * v.value, p[2] * v.slope};
     }},
    {"table", "f linear between points (zeta, f), constant outside", {}, true, interpolated},
};

constexpr FactorLaw rate_table[] = {
    {"none", "the rate has no influence", {}, false, one},
    {"logarithmic", "R = 1 + c ln(1 + zeta_dot/reference_rate)", logarithmic_parameters, false,
     [](std::span<const double> p, double rate) {
       return FactorValue{1.0 + p[0] * std::log1p(rate / p[1]), p[0] / (p[1] + rate)};
     }},
    {"power", "R = (1 + zeta_dot/reference_rate)^m", rate_power_parameters, false,
     [](std::span<const double> p, double rate) { return power(1.0 + rate / p[1], p[0], p[1]); }},
};

void check_table(const std::vector<double>& p) {
  const std::size_t n = p.size() / 2;
  if (p.size() % 2 != 0 || n < 2)
    throw InputError("a hardening table needs two points or more, and an f for each zeta");
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0 && !(p[i] > p[i - 1]))
      throw InputError(
          fmt::format("zeta must increase from point to point in a hardening table; {} follows {}", p[i], p[i - 1]));
    if (!(p[n + i] > 0.0)) throw InputError(fmt::format("f must be positive in a hardening table; found {}", p[n + i]));
  }
}

}  // namespace

std::span<const FactorLaw> hardening_laws() { return hardening_table; }
std::span<const FactorLaw> rate_factors() { return rate_table; }
const FactorLaw& hardening_law(std::string_view name) { return find_by_name(hardening_laws(), name, "hardening law"); }
const FactorLaw& rate_factor(std::string_view name) { return find_by_name(rate_factors(), name, "rate factor"); }

Factor make_factor(const FactorLaw& law, std::vector<double> p) {
  for (const double value : p)
    if (!std::isfinite(value)) throw InputError(fmt::format("{}: a parameter is {}", law.name, value));
  if (law.tabulated) {
    check_table(p);
    return {&law, std::move(p)};
  }
  if (p.size() != law.parameters.size())
    throw InputError(fmt::format("{}: expected {} parameters, found {}", law.name, law.parameters.size(), p.size()));
  for (std::size_t i = 0; i < p.size(); ++i) {
    const LawParameter& due = law.parameters[i];
    if (p[i] < 0.0 || (p[i] == 0.0 && !due.may_be_zero))
      throw InputError(fmt::format("{}: {} = {} must be {}", law.name, due.name, p[i],
                                   due.may_be_zero ? "zero or positive" : "positive"));
  }
  return {&law, std::move(p)};
}

bool Hardening::depends_on_rate() const { return with_rate.law->value != one; }

HardeningValue Hardening::operator()(double zeta, double rate) const {
  const FactorValue F = with_path(zeta);
  const FactorValue R = with_rate(rate);
  return {F.value * R.value, F.slope * R.value, F.value * R.slope};
}

}  // namespace pfdm
