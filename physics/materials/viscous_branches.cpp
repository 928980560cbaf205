#include "physics/materials/viscous_branches.h"

#include "physics/prony_decay.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

Tensor viscous_strain(std::span<const double> history, std::size_t branch) {
  return to_tensor(Eigen::Map<const Mandel>(history.data() + 6 * branch));
}

// (det A)^power - 1, exact to rounding near A = 1, by det A - 1.
double power_less_one(double change, double power) { return std::expm1(power * std::log1p(change)); }

// tr A - 3 by B = A - 1 where det A = 1: nothing cancels at small B.
double trace_beyond_three(const Tensor& B) { return 0.5 * ((B * B).trace() - B.trace() * B.trace()) - B.determinant(); }

// J^(-2/3) by J - 1.
OfVolume isochoric_factor(double change) {
  return extended(change, [](double at) -> OfVolume {
    const double J = 1.0 + at, value = std::pow(J, -2.0 / 3.0);
    return {value, -2.0 / 3.0 * value / J, 10.0 / 9.0 * value / (J * J)};
  });
}

// J^(2/3), which the energy is proportional to, by J - 1.
OfVolume size_factor(double change) {
  return extended(change, [](double at) -> OfVolume {
    const double J = 1.0 + at, value = std::pow(J, 2.0 / 3.0);
    return {value, 2.0 / 3.0 * value / J, -2.0 / 9.0 * value / (J * J)};
  });
}

// X -> -M^-1 X M^-1 + (M^-1:X)/3 M^-1: change of M^-1 (det M)^(1/3) by X, over (det M)^(1/3).
MandelMatrix inverse_change(const Tensor& inverse) {
  MandelMatrix by;
  const Mandel m = to_mandel(inverse);
  for (int k = 0; k < n_components; ++k) {
    const Tensor X = to_tensor(Mandel::Unit(k));
    by.col(k) = to_mandel(symmetric_part(-inverse * X * inverse)) + m[k] / 3.0 * m;
  }
  return by;
}

}  // namespace

// C' = s C + part 1, where `part` is 0 but in cells that are almost flat or turned inside out: C' is then still
// positive definite, and a differentiable function of F.
struct ViscousBranches::Shape {
  double change;    // J - 1
  OfVolume factor;  // s by J
  double part = 0.0, part_slope = 0.0;
  Tensor strain;  // C' - 1
  Tensor C;

  explicit Shape(const Tensor& H) : change(volume_change(H)), factor(isochoric_factor(change)) {
    const Tensor twice_E = 2.0 * green_strain(H);
    C = Tensor::Identity() + twice_E;
    if (is_regular()) {
      strain = factor.value * twice_E + power_less_one(change, -2.0 / 3.0) * Tensor::Identity();
      return;
    }
    const double below = least_volume - 1.0 - change;
    part = below * below, part_slope = -2.0 * below;
    strain = factor.value * C + (part - 1.0) * Tensor::Identity();
  }
  bool is_regular() const { return 1.0 + change >= least_volume; }
  /// dC'/dJ at constant C.
  Tensor by_volume() const { return factor.slope * C + part_slope * Tensor::Identity(); }
};

struct ViscousBranches::Flow {
  Tensor strain;        // C_v - 1
  Tensor inverse;       // C_v^-1
  Tensor inverse_of_M;  // M^-1
  double share = 0.0;   // dM/dC'
  double root = 1.0;    // (det M)^(1/3)
};

ViscousBranches::ViscousBranches(const std::vector<PronyBranch>& shear, VolumetricForm form, double bulk_ratio,
                                 const std::vector<PronyBranch>& bulk)
    : branches_(shear),
      form_(form),
      bulk_ratio_(bulk_ratio),
      volume_(bulk, form),
      springs_(6 * shear.size()),
      volumes_(springs_ + (bulk_ratio > 0.0 ? shear.size() : 0)),
      heat_(volumes_ + bulk.size()) {}

double ViscousBranches::modulus_over(double duration) const {
  double sum = 0.0;
  for (const PronyBranch& branch : branches_) sum += decay_over(duration / branch.time).phi * branch.modulus;
  return sum;
}

// Sums of small differences from 1 keep the digits of small strains.
ViscousBranches::Flow ViscousBranches::flow(std::size_t i, const Shape& now, const Shape& before,
                                            const PointBefore& at) const {
  const Tensor viscous = viscous_strain(at.history, i), inverse_n = (Tensor::Identity() + viscous).inverse();
  const double r = 1.0 + contract(before.strain - viscous, inverse_n) / 3.0;
  const PronyDecay by = decay_over(r * at.duration / branches_[i].time);
  const double one = (1.0 - by.left) * (1.0 / r - 1.0);
  const Tensor M_strain = by.left * viscous + ((by.phi - by.left) * before.strain + (1.0 - by.phi) * now.strain) / r +
                          one * Tensor::Identity();
  Flow flow;
  flow.share = (1.0 - by.phi) / r;
  flow.inverse_of_M = (Tensor::Identity() + M_strain).inverse();
  const double change = volume_change(M_strain), root = power_less_one(change, 1.0 / 3.0);
  flow.root = 1.0 + root;
  flow.strain = (M_strain - root * Tensor::Identity()) / flow.root;
  flow.inverse = flow.root * flow.inverse_of_M;
  return flow;
}

// Energy and stress alone, of a regular shape: P = mu_i (F (C_v^-1 - 1) + J^(-1/3) cof F (C' - 1)).
PotentialAt ViscousBranches::force(std::size_t i, const Tensor& F, const Shape& now, const Flow& flow) const {
  const double mu = branches_[i].modulus;
  const Tensor B = (now.strain - flow.strain) * flow.inverse;
  return {.energy = 0.5 * mu * trace_beyond_three(B) / now.factor.value,
          .stress = mu * (F * (-flow.inverse * flow.strain) +
                          std::cbrt(1.0 / (1.0 + now.change)) * cofactor(F) * now.strain)};
}

PotentialAt ViscousBranches::shear(std::size_t i, const Tensor& F, const Shape& now, const Flow& flow) const {
  const double mu = branches_[i].modulus;
  const MandelMatrix by_M = mu * flow.root * inverse_change(flow.inverse_of_M);
  OfVolume size = size_factor(now.change);
  size = {-1.5 * mu * size.value, -1.5 * mu * size.slope, -1.5 * mu * size.curvature};
  const double energy = 0.5 * mu * contract(now.C, flow.inverse);
  PotentialAt result = by_gradient(energy, F, mu * to_mandel(flow.inverse), 2.0 * flow.share * now.factor.value * by_M);
  result += by_volume(F, size);
  const Tensor S_by_volume = to_tensor(by_M * (flow.share * to_mandel(now.by_volume())));
  result.tangent += to_components(F * S_by_volume) * to_components(cofactor(F)).transpose();
  if (!now.is_regular()) return result;
  const PotentialAt exact = force(i, F, now, flow);
  result.energy = exact.energy;
  result.stress = exact.stress;
  return result;
}

double ViscousBranches::spring(std::size_t i, const Shape& now, const Shape& before, const PointBefore& at) const {
  const auto volume_strain = [this](double change) { return extended_volume_energy(form_, change).slope; };
  const PronyDecay by = decay_over(at.duration / branches_[i].time);
  return by.after(at.history[springs_ + i], volume_strain(now.change) - volume_strain(before.change));
}

VolumeBranches::Step ViscousBranches::volume_step(const Shape& now, const Shape& before, const PointBefore& at) const {
  return {before.change, now.change, at.duration, at.history.subspan(volumes_, volume_.size())};
}

PotentialAt ViscousBranches::over(const Tensor& H, const PointBefore& before) const {
  PotentialAt sum;
  if (!any()) return sum;
  const Shape now(H), earlier(before.from);
  const Tensor F = Tensor::Identity() + H;
  OfVolume of_springs;
  const OfVolume volume = extended_volume_energy(form_, now.change);
  for (std::size_t i = 0; i < branches_.size(); ++i) {
    sum += shear(i, F, now, flow(i, now, earlier, before));
    if (bulk_ratio_ == 0.0) continue;
    const double modulus = bulk_ratio_ * branches_[i].modulus;
    of_springs.slope += modulus * spring(i, now, earlier, before);
    of_springs.curvature += modulus * decay_over(before.duration / branches_[i].time).phi * volume.curvature;
  }
  if (bulk_ratio_ > 0.0) sum += by_volume(F, of_springs);
  if (volume_.size() > 0) sum += by_volume(F, volume_.over(volume_step(now, earlier, before)));
  return sum;
}

// The spring loses its energy at twice the rate at which B does: so one that is held makes all that it stored, heat.
double ViscousBranches::dissipated(std::size_t i, const Shape& now, const Shape& before, const PointBefore& at,
                                   const Flow& flow) const {
  const Tensor viscous = viscous_strain(at.history, i);
  const Tensor B_n = (before.strain - viscous) * (Tensor::Identity() + viscous).inverse(),
               B = (now.strain - flow.strain) * flow.inverse;
  const auto square = [](const Tensor& a, const Tensor& b) { return (deviator(a) * deviator(b)).trace(); };
  const double start = square(B_n, B_n), end = square(B, B), most = std::sqrt(std::max(start * end, 0.0));
  const double stored = trace_beyond_three(B_n), rate = stored > 0.0 ? 0.5 * start / stored : 1.0;
  const double x = at.duration / branches_[i].time, ratio = std::sqrt(before.factor.value / now.factor.value);
  const PronySquare by = square_over(rate * x);
  return 0.5 * branches_[i].modulus * x / before.factor.value *
         (by.start * start + by.cross * ratio * std::clamp(square(B_n, B), -most, most) + by.end * ratio * ratio * end);
}

void ViscousBranches::advance(const Tensor& H, const PointBefore& before, std::span<double> history) const {
  if (!any()) return;
  const Shape now(H), earlier(before.from);
  double heat = before.history[heat_];
  const bool is_regular = now.is_regular() && earlier.is_regular();
  for (std::size_t i = 0; i < branches_.size(); ++i) {
    const Flow flow_i = flow(i, now, earlier, before);
    if (is_regular) heat += dissipated(i, now, earlier, before, flow_i);
    if (bulk_ratio_ > 0.0) history[springs_ + i] = spring(i, now, earlier, before);
    Eigen::Map<Mandel>(history.data() + 6 * i) = to_mandel(flow_i.strain);
  }
  if (volume_.size() > 0) {
    const double of_volume =
        volume_.advance(volume_step(now, earlier, before), history.subspan(volumes_, volume_.size()));
    if (is_regular) heat += of_volume;
  }
  history[heat_] = heat;
}

}  // namespace pfdm
