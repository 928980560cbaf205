#include "mesh/packing/sphere_packing.h"

#include "physics/error.h"
#include "physics/portable_math.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace pfdm {
namespace {

constexpr double dilute = 0.15;          // volume fraction, with the gaps, at which the spheres are placed
constexpr double fastest_growth = 1e-3;  // of the radii in a sweep
constexpr double slowest_growth = 2e-6;
constexpr double jammed = 2e-3;      // step of the moves over the smallest radius
constexpr double loosened = 0.94;    // factor on the radii after that
constexpr int most_attempts = 4;     // each from a new arrangement
constexpr double most_sweeps = 3e5;  // of each
constexpr double most_tests = 4e9;   // of two spheres in each: some ten seconds
constexpr int sweeps_at_end = 200;   // that forget how the spheres came there

// Spheres with half a gap around them, of `scale` times their radii.
class GrowingSpheres {
 public:
  GrowingSpheres(const SpherePacking& packing, RandomNumbers& random)
      : packing_(packing), random_(random), radii_(packing.radii), centres_(packing.radii.size()) {
    for (double& r : radii_) r += 0.5 * packing.gap;
    smallest_ = *std::ranges::min_element(radii_);
    step_ = 0.5 * smallest_;
  }

  // Largest first. False if one finds no place.
  bool place_at(double scale) {
    scale_ = scale;
    std::vector<std::size_t> order(radii_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return radii_[a] > radii_[b]; });
    std::vector<std::size_t> there;
    for (const std::size_t i : order) {
      int trials = 0;
      do {
        if (++trials > 10000) return false;
        centres_[i] = anywhere(i);
      } while (std::ranges::any_of(there, [&](std::size_t j) { return overlaps(i, j, centres_[i]); }));
      there.push_back(i);
    }
    return true;
  }

  // Moves as many spheres as there are, one after the other.
  void sweep() {
    std::size_t moved = 0;
    for (std::size_t k = 0; k < radii_.size(); ++k) {
      const auto i = std::min(static_cast<std::size_t>(random_.uniform() * double(radii_.size())), radii_.size() - 1);
      Vector x = centres_[i];
      for (int a = 0; a < 3; ++a) x[a] += step_ * (2.0 * random_.uniform() - 1.0);
      if (!has_room(i, x)) continue;
      centres_[i] = x;
      ++moved;
    }
    const double share = double(moved) / double(radii_.size());
    if (share < 0.3) step_ *= 0.95;
    if (share > 0.5) step_ = std::min(1.05 * step_, 2.0 * smallest_);
  }

  // By at most `growth`; up to scale 1.
  void grow(double growth) { scale_ = std::min({1.0, largest_scale(), scale_ + growth}); }
  void loosen() {
    scale_ *= loosened;
    step_ = 0.1 * smallest_;
  }

  double scale() const { return scale_; }
  bool is_jammed() const { return step_ < jammed * smallest_; }
  const std::vector<Vector>& centres() const { return centres_; }

 private:
  // From the sides the sphere itself keeps the wall's gap at any scale.
  double reach(std::size_t i, double scale) const {
    return scale * (radii_[i] - 0.5 * packing_.gap + packing_.wall_gap);
  }

  Vector anywhere(std::size_t i) {
    Vector x;
    for (int a = 0; a < 3; ++a) {
      const double r = reach(i, scale_);
      x[a] = packing_.lower[a] + r + random_.uniform() * (packing_.upper[a] - packing_.lower[a] - 2.0 * r);
    }
    return x;
  }

  bool overlaps(std::size_t i, std::size_t j, const Vector& x) const {
    const double apart = scale_ * (radii_[i] + radii_[j]);
    return (x - centres_[j]).squaredNorm() < apart * apart;
  }

  bool has_room(std::size_t i, const Vector& x) const {
    const double r = reach(i, scale_);
    if ((x - packing_.lower).minCoeff() < r || (packing_.upper - x).minCoeff() < r) return false;
    for (std::size_t j = 0; j < radii_.size(); ++j)
      if (j != i && overlaps(i, j, x)) return false;
    return true;
  }

  double largest_scale() const {
    double largest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < radii_.size(); ++i) {
      const Vector& x = centres_[i];
      const double wall = std::min((x - packing_.lower).minCoeff(), (packing_.upper - x).minCoeff());
      largest = std::min(largest, wall / reach(i, 1.0));
      for (std::size_t j = 0; j < i; ++j)
        largest = std::min(largest, (x - centres_[j]).norm() / (radii_[i] + radii_[j]));
    }
    return largest;
  }

  const SpherePacking& packing_;
  RandomNumbers& random_;
  std::vector<double> radii_;
  double smallest_ = 0.0;
  std::vector<Vector> centres_;
  double scale_ = 0.0;
  double step_ = 0.0;  // [m]
};

double volume_of(const std::vector<double>& radii, double more) {
  double volume = 0.0;
  for (const double r : radii) volume += 4.0 / 3.0 * std::numbers::pi * portable::pow(r + more, 3);
  return volume;
}

void check_room(const SpherePacking& packing) {
  const double largest = *std::ranges::max_element(packing.radii) + packing.wall_gap;
  const double side = (packing.upper - packing.lower).minCoeff();
  if (2.0 * largest >= side)
    throw InputError(
        fmt::format("a sphere of diameter {} with {} on each side has no room in a box whose shortest side is {}",
                    quantity_text(2.0 * (largest - packing.wall_gap), "m"), quantity_text(packing.wall_gap, "m"),
                    quantity_text(side, "m")));
  const double with_gaps = volume_of(packing.radii, 0.5 * packing.gap) / (packing.upper - packing.lower).prod();
  if (with_gaps > 0.7)
    throw InputError(
        fmt::format("the volume fraction of the spheres is {:.3f}, and {:.3f} with half the gap around "
                    "each; no more than about 0.55 can be packed at random",
                    volume_fraction(packing), with_gaps));
}

// Returns the largest scale that was reached.
double grow_fully(GrowingSpheres& spheres, const SpherePacking& packing) {
  const double with_gaps = volume_of(packing.radii, 0.5 * packing.gap) / (packing.upper - packing.lower).prod();
  double scale = std::min(1.0, portable::cbrt(dilute / with_gaps));
  while (!spheres.place_at(scale)) scale *= 0.9;
  const auto n = static_cast<double>(packing.radii.size());
  const auto sweeps = static_cast<int>(std::min(most_sweeps, most_tests / (n * n)));
  double growth = fastest_growth, best = spheres.scale();
  for (int done = 0; spheres.scale() < 1.0 && done < sweeps; ++done) {
    spheres.sweep();
    spheres.grow(growth);
    best = std::max(best, spheres.scale());
    if (!spheres.is_jammed() || spheres.scale() == 1.0) continue;
    spheres.loosen();
    growth = std::max(0.5 * growth, slowest_growth);
  }
  return best;
}

}  // namespace

double volume_fraction(const SpherePacking& packing) {
  return volume_of(packing.radii, 0.0) / (packing.upper - packing.lower).prod();
}

std::vector<Vector> pack_spheres(const SpherePacking& packing, RandomNumbers& random) {
  if (packing.radii.empty()) return {};
  check_room(packing);
  double best = 0.0;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    GrowingSpheres spheres(packing, random);
    best = std::max(best, grow_fully(spheres, packing));
    if (spheres.scale() < 1.0) continue;
    for (int i = 0; i < sweeps_at_end; ++i) spheres.sweep();
    return spheres.centres();
  }
  throw InputError(fmt::format(
      "{} spheres with gaps of {} found no room: at their volume fraction of {:.4f} (around the corners of their "
      "surfaces, with layers) they would have to be {:.2f} % smaller; take a lower fraction or gap, finer surfaces, a "
      "wider distribution of diameters, or another seed",
      packing.radii.size(), quantity_text(packing.gap, "m"), volume_fraction(packing), 100.0 * (1.0 - best)));
}

}  // namespace pfdm
