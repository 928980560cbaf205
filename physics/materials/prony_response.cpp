#include "physics/materials/prony_response.h"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <functional>

namespace pfdm {
namespace {

constexpr double same_time = 1e-12;  // relative: branches that are one

/// constant + sign sum weight_i/(pole_i - x), poles rising, weights and constant positive: the transform of a series of
/// exponentials at the rate x = -s.
struct PoleSum {
  double constant = 0.0, sign = 1.0;
  std::vector<double> weights{}, poles{};

  /// At origin + d, where origin is one of the poles or zero: no difference of near numbers, and times `d` at a pole.
  double scaled_at(double origin, double d) const {
    double sum = constant, at_origin = 0.0;
    for (std::size_t i = 0; i < poles.size(); ++i) {
      if (poles[i] == origin)
        at_origin = -sign * weights[i];
      else
        sum += sign * weights[i] / ((poles[i] - origin) - d);
    }
    return at_origin == 0.0 ? sum : at_origin + d * sum;
  }
  double at(double x) const { return scaled_at(0.0, x); }
};

/// A zero as the place nearest to it that is known, and how far it is from there.
struct Zero {
  double origin = 0.0, distance = 0.0;
  double value() const { return origin + distance; }
};

/// The end nearer to zero where rounding leaves no change of sign.
double bracketed(const std::function<double(double)>& f, double from, double to) {
  const double at_from = f(from), at_to = f(to);
  if (!(from < to) || !(at_from * at_to < 0.0)) return std::abs(at_from) < std::abs(at_to) ? from : to;
  std::uintmax_t most = 400;
  const auto [a, b] = boost::math::tools::toms748_solve(f, from, to, at_from, at_to,
                                                        boost::math::tools::eps_tolerance<double>(53), most);
  return 0.5 * (a + b);
}

/// The one zero between two neighbours, of which the lower one may be zero without a pole, by the nearer of them.
Zero zero_between(const PoleSum& sum, double lower, double upper) {
  const double half = 0.5 * (upper - lower);
  const double middle = lower > 0.0 ? sum.scaled_at(lower, half) / half : sum.at(half);
  const bool rises = sum.sign > 0.0;
  const bool is_above = rises ? middle < 0.0 : middle > 0.0;
  const double origin = is_above ? upper : lower;
  const auto f = [&](double d) { return sum.scaled_at(origin, d); };
  return {origin, is_above ? bracketed(f, -half, 0.0) : bracketed(f, 0.0, half)};
}

std::vector<Zero> zeros(const PoleSum& sum) {
  std::vector<Zero> found;
  const std::size_t n = sum.poles.size();
  if (sum.sign < 0.0 && n > 0) found.push_back(zero_between(sum, 0.0, sum.poles[0]));
  for (std::size_t i = 1; i < n; ++i) found.push_back(zero_between(sum, sum.poles[i - 1], sum.poles[i]));
  if (sum.sign > 0.0 && n > 0) {
    double all = 0.0;
    for (const double weight : sum.weights) all += weight;
    const double last = sum.poles.back(), reach = 1.0000001 * all / sum.constant;
    found.push_back({last, bracketed([&](double d) { return sum.scaled_at(last, d); }, 0.0, reach)});
  }
  return found;
}

/// 1 over (x sum weight_i/(pole_i - x)^2): strength of the reciprocal's term at a zero.
double strength_at(const PoleSum& sum, const Zero& zero) {
  double slope = 0.0;
  for (std::size_t i = 0; i < sum.poles.size(); ++i) {
    const double gap = (sum.poles[i] - zero.origin) - zero.distance;
    slope += sum.weights[i] / (gap * gap);
  }
  return 1.0 / (zero.value() * slope);
}

/// Strengths and rates of terms by rising rate; terms of one time are one. Members: of a strength, of a time.
template <class Term>
PoleSum pole_sum(double constant, double sign, std::vector<Term> series, double Term::*strength) {
  std::ranges::sort(series, std::greater{}, &Term::time);
  PoleSum sum{.constant = constant, .sign = sign};
  for (const Term& term : series) {
    assert(term.*strength > 0.0 && term.time > 0.0);
    const double rate = 1.0 / term.time;
    if (!sum.poles.empty() && rate <= sum.poles.back() * (1.0 + same_time))
      sum.weights.back() += term.*strength * sum.poles.back();
    else
      sum.weights.push_back(term.*strength * rate), sum.poles.push_back(rate);
  }
  return sum;
}

RelaxationModulus sorted(double relaxed, std::vector<PronyBranch> branches) {
  std::ranges::sort(branches, {}, &PronyBranch::time);
  return {.relaxed = relaxed, .branches = std::move(branches)};
}

/// What each branch of relaxation (retardation) holds at the times, of an input that is linear in between: the integral
/// of exp(-(t - t')/time) of the input's rate. Calls add(i, value) for every time i. As decay_over(), but by functions
/// whose last digit depends on the processor: they are faster, and fits take them millions of times.
template <class Add>
void memory_of(double time, std::span<const double> times, std::span<const double> input, const Add& add) {
  double q = input.empty() ? 0.0 : input[0], step = -1.0, left = 1.0, phi = 1.0;
  if (!input.empty()) add(0, q);
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double dt = times[i] - times[i - 1];
    if (dt != step) {
      const double gone = -std::expm1(-dt / time);
      left = 1.0 - gone, phi = gone * time / dt, step = dt;
    }
    q = left * q + phi * (input[i] - input[i - 1]);
    add(i, q);
  }
}

}  // namespace

double RelaxationModulus::instantaneous() const {
  double sum = relaxed;
  for (const PronyBranch& branch : branches) sum += branch.modulus;
  return sum;
}

std::string_view name_of(Deformation deformation) { return deformation == Deformation::tension ? "tension" : "shear"; }

RelaxationModulus shear_modulus(const PronyLaw& law) { return sorted(law.relaxed.mu, law.shear); }

RelaxationModulus bulk_modulus(const PronyLaw& law) { return sorted(law.relaxed.bulk_modulus(), law.bulk); }

RelaxationModulus young_modulus(const PronyLaw& law) {
  const CreepCompliance shear = creep_compliance(shear_modulus(law)), bulk = creep_compliance(bulk_modulus(law));
  CreepCompliance axial{.instantaneous = shear.instantaneous / 3.0 + bulk.instantaneous / 9.0};
  for (const Retardation& r : shear.retardations) axial.retardations.push_back({r.compliance / 3.0, r.time});
  for (const Retardation& r : bulk.retardations) axial.retardations.push_back({r.compliance / 9.0, r.time});
  return relaxation_modulus(axial);
}

RelaxationModulus modulus_in(const PronyLaw& law, Deformation deformation) {
  return deformation == Deformation::tension ? young_modulus(law) : shear_modulus(law);
}

// M(-x) = M_inf + sum M_i - sum M_i r_i/(r_i - x).
CreepCompliance creep_compliance(const RelaxationModulus& modulus) {
  const double at_once = modulus.instantaneous();
  const PoleSum sum = pole_sum(at_once, -1.0, modulus.branches, &PronyBranch::modulus);
  CreepCompliance result{.instantaneous = 1.0 / at_once};
  for (const Zero& zero : zeros(sum)) result.retardations.push_back({strength_at(sum, zero), 1.0 / zero.value()});
  std::ranges::reverse(result.retardations);
  return result;
}

// J(-x) = J_0 + sum J_k rho_k/(rho_k - x).
RelaxationModulus relaxation_modulus(const CreepCompliance& compliance) {
  double at_last = compliance.instantaneous;
  for (const Retardation& r : compliance.retardations) at_last += r.compliance;
  const PoleSum sum = pole_sum(compliance.instantaneous, 1.0, compliance.retardations, &Retardation::compliance);
  RelaxationModulus result{.relaxed = 1.0 / at_last};
  for (const Zero& zero : zeros(sum)) result.branches.push_back({strength_at(sum, zero), 1.0 / zero.value()});
  std::ranges::reverse(result.branches);
  return result;
}

std::complex<double> complex_modulus(const RelaxationModulus& modulus, double angular_frequency) {
  double storage = modulus.relaxed, loss = 0.0;
  for (const PronyBranch& branch : modulus.branches) {
    const double x = angular_frequency * branch.time, part = branch.modulus * x / (1.0 + x * x);
    storage += part * x;
    loss += part;
  }
  return {storage, loss};
}

std::vector<double> stress_response(const RelaxationModulus& modulus, std::span<const double> times,
                                    std::span<const double> strains) {
  std::vector<double> stresses;
  for (const double strain : strains) stresses.push_back(modulus.relaxed * strain);
  for (const PronyBranch& branch : modulus.branches)
    memory_of(branch.time, times, strains, [&](std::size_t i, double q) { stresses[i] += branch.modulus * q; });
  return stresses;
}

std::vector<double> strain_response(const CreepCompliance& compliance, std::span<const double> times,
                                    std::span<const double> stresses) {
  std::vector<double> strains;
  for (const double stress : stresses) strains.push_back(compliance.instantaneous * stress);
  for (const Retardation& r : compliance.retardations)
    memory_of(r.time, times, stresses,
              [&](std::size_t i, double q) { strains[i] += r.compliance * (stresses[i] - q); });
  return strains;
}

}  // namespace pfdm
