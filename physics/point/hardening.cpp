#include "physics/point/hardening.h"

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

/// Place of an argument among rising points: between `below` and the next one, at `part` of the way. Arguments outside
/// are at the ends, where nothing changes.
struct Place {
  std::size_t below = 0;
  double part = 0.0;
  double width = 0.0;  // of the interval; 0 outside
};

Place place_among(std::span<const double> x, double at) {
  const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  if (above == 0) return {};
  if (above == x.size()) return {.below = x.size() - 2, .part = 1.0};
  const double width = x[above] - x[above - 1];
  return {.below = above - 1, .part = (at - x[above - 1]) / width, .width = width};
}

/// As place_among, by the logarithm: rates are decades apart.
Place place_among_rates(std::span<const double> rates, double at) {
  Place place = place_among(rates, at);
  if (place.width == 0.0) return place;
  const double first = rates[place.below];
  place.width = std::log(rates[place.below + 1] / first);
  place.part = std::log(at / first) / place.width;
  return place;
}

RateTable unpacked(std::span<const double> p) {
  const auto n = static_cast<std::size_t>(p[0]), m = (p.size() - 1 - n) / (n + 1);
  return {.zeta = p.subspan(1, n), .rate = p.subspan(1 + n, m), .f = p.subspan(1 + n + m)};
}

/// Bilinear in zeta and ln(rate), constant outside the grid.
HardeningValue interpolated_with_rate(std::span<const double> p, double zeta, double rate) {
  const RateTable table = unpacked(p);
  const Place x = place_among(table.zeta, zeta), y = place_among_rates(table.rate, rate);
  const auto f = [&](std::size_t i, std::size_t j) { return table.f[table.at(y.below + i, x.below + j)]; };
  const double slow = f(0, 0) + x.part * (f(0, 1) - f(0, 0)), fast = f(1, 0) + x.part * (f(1, 1) - f(1, 0));
  HardeningValue value{.f = slow + y.part * (fast - slow)};
  if (x.width > 0.0) value.f_zeta = ((1.0 - y.part) * (f(0, 1) - f(0, 0)) + y.part * (f(1, 1) - f(1, 0))) / x.width;
  if (y.width > 0.0) value.f_rate = (fast - slow) / (y.width * rate);
  return value;
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
    {"table_with_rate",
     "f linear in zeta and in ln(zeta_dot) between the points of a grid, constant outside",
     {},
     true,
     [](std::span<const double> p, double zeta) {
       const HardeningValue v = interpolated_with_rate(p, zeta, 0.0);
       return FactorValue{v.f, v.f_zeta};
     },
     interpolated_with_rate},
};

constexpr FactorLaw rate_factor_table[] = {
    {"none", "the rate has no influence", {}, false, one},
    {"logarithmic", "R = 1 + c ln(1 + zeta_dot/reference_rate)", logarithmic_parameters, false,
     [](std::span<const double> p, double rate) {
       return FactorValue{1.0 + p[0] * std::log1p(rate / p[1]), p[0] / (p[1] + rate)};
     }},
    {"power", "R = (1 + zeta_dot/reference_rate)^m", rate_power_parameters, false,
     [](std::span<const double> p, double rate) { return power(1.0 + rate / p[1], p[0], p[1]); }},
};

void check_rising(std::span<const double> x, std::string_view what) {
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1]))
      throw InputError(fmt::format("{} must increase from point to point in a hardening table; {} follows {}", what,
                                   x[i], x[i - 1]));
}

void check_positive(std::span<const double> values, std::string_view what) {
  for (const double value : values)
    if (!(value > 0.0))
      throw InputError(fmt::format("{} must be positive in a hardening table; found {}", what, value));
}

void check_table(const std::vector<double>& p) {
  const std::size_t n = p.size() / 2;
  if (p.size() % 2 != 0 || n < 2)
    throw InputError("a hardening table needs two points or more, and an f for each zeta");
  check_rising(std::span(p).first(n), "zeta");
  check_positive(std::span(p).last(n), "f");
}

}  // namespace

std::span<const FactorLaw> hardening_laws() { return hardening_table; }
std::span<const FactorLaw> rate_factors() { return rate_factor_table; }
const FactorLaw& hardening_law(std::string_view name) { return find_by_name(hardening_laws(), name, "hardening law"); }
const FactorLaw& rate_factor(std::string_view name) { return find_by_name(rate_factors(), name, "rate factor"); }

Factor make_factor(const FactorLaw& law, std::vector<double> p) {
  for (const double value : p)
    if (!std::isfinite(value)) throw InputError(fmt::format("{}: a parameter is {}", law.name, value));
  if (law.tabulated) {
    if (law.of_path_and_rate != nullptr)
      rate_table(p);
    else
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

RateTable rate_table(std::span<const double> p) {
  const double n = p.empty() ? 0.0 : p[0];
  const RateTable table = n >= 2.0 && n + 1.0 <= static_cast<double>(p.size()) ? unpacked(p) : RateTable{};
  if (table.rate.size() < 2 || table.f.size() != table.zeta.size() * table.rate.size())
    throw InputError("a hardening table of path and rate needs two zeta and two rates or more, and an f for each pair");
  check_rising(table.zeta, "zeta");
  check_rising(table.rate, "the rate");
  check_positive(table.rate, "the rate");
  check_positive(table.f, "f");
  return table;
}

std::vector<double> rate_table_parameters(std::vector<double> zeta, const std::vector<double>& rate,
                                          const std::vector<double>& f) {
  std::vector<double> p = std::move(zeta);
  p.insert(p.begin(), static_cast<double>(p.size()));
  p.insert(p.end(), rate.begin(), rate.end());
  p.insert(p.end(), f.begin(), f.end());
  return p;
}

bool Hardening::depends_on_rate() const {
  return with_path.law->of_path_and_rate != nullptr || with_rate.law->value != one;
}

HardeningValue Hardening::operator()(double zeta, double rate) const {
  HardeningValue F;
  if (with_path.law->of_path_and_rate != nullptr) {
    F = with_path.law->of_path_and_rate(with_path.p, zeta, rate);
  } else {
    const FactorValue of_path = with_path(zeta);
    F = {.f = of_path.value, .f_zeta = of_path.slope};
  }
  const FactorValue R = with_rate(rate);
  return {F.f * R.value, F.f_zeta * R.value, F.f_rate * R.value + F.f * R.slope};
}

}  // namespace pfdm
