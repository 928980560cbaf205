#pragma once
// Slow-down of the intrinsic time of the endochronic law: dz = dzeta / f(zeta, zeta_dot), f = F(zeta) R(zeta_dot), or
// F(zeta, zeta_dot) from a table (AFRL-RW-EG-TR-2016-088, A5.2.2). Stresses saturate in proportion to f: f > 1 hardens,
// f < 1 softens. (f, alpha_r) and (l f, l alpha_r) are the same material, so f(0) = 1 is what the laws take unless told
// otherwise.

#include "physics/law_parameters.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct FactorValue {
  double value = 1.0;
  double slope = 0.0;  ///< with respect to zeta [-] or zeta_dot [s]
};

struct HardeningValue {
  double f = 1.0;
  double f_zeta = 0.0;  ///< df/dzeta [-]
  double f_rate = 0.0;  ///< df/dzeta_dot [s]
};

/// F(zeta) or R(zeta_dot), a row of a table. `p`: the parameters in their order; of a tabulated factor first the
/// arguments, then as many values; of one of path and rate what RateTable reads.
struct FactorLaw {
  std::string_view name;
  std::string_view description;
  std::span<const LawParameter> parameters;
  bool tabulated = false;
  FactorValue (*value)(std::span<const double> p, double argument);  ///< at rest where it depends on the rate too
  HardeningValue (*of_path_and_rate)(std::span<const double> p, double zeta, double rate) = nullptr;
};

/// f over a grid, as the parameters of a factor: how many zeta, the zeta, the rates [1/s], f at all zeta for the first
/// rate, then for the next ones.
struct RateTable {
  std::span<const double> zeta, rate, f;
  std::size_t at(std::size_t rate_row, std::size_t zeta_column) const { return rate_row * zeta.size() + zeta_column; }
};
/// Throws InputError if the numbers are not those of a table.
RateTable rate_table(std::span<const double> p);
/// Numbers of a table from its columns, the inverse of rate_table().
std::vector<double> rate_table_parameters(std::vector<double> zeta, const std::vector<double>& rate,
                                          const std::vector<double>& f);

std::span<const FactorLaw> hardening_laws();
std::span<const FactorLaw> rate_factors();
/// Throw InputError naming those there are.
const FactorLaw& hardening_law(std::string_view name);
const FactorLaw& rate_factor(std::string_view name);

/// A law with its parameters.
struct Factor {
  const FactorLaw* law = nullptr;
  std::vector<double> p;
  FactorValue operator()(double argument) const { return law->value(p, argument); }
};

/// Throws InputError if the parameters are not as many, or not such, as the law needs to be positive for all arguments.
Factor make_factor(const FactorLaw& law, std::vector<double> p);

struct Hardening {
  Factor with_path = {&hardening_law("constant"), {}};
  Factor with_rate = {&rate_factor("none"), {}};
  bool depends_on_rate() const;
  HardeningValue operator()(double zeta, double rate) const;
};

}  // namespace pfdm
