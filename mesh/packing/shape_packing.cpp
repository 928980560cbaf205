#include "mesh/packing/shape_packing.h"

#include "mesh/packing/convex_distance.h"
#include "physics/error.h"
#include "physics/portable_math.h"
#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pfdm {
namespace {

constexpr double dilute_spheres = 0.12;  // volume fraction of the spheres around the bodies at which they are placed
constexpr double most_of_side = 0.9;     // of the shortest side's width, of those spheres
constexpr double fast_growth = 4e-3, slow_growth = 1e-5;  // of the size, in a sweep
constexpr double jammed_step = 2e-3;                      // step of the moves over the smallest body's size
constexpr double loosening = 0.97;                        // factor on the size after that
constexpr int most_arrangements = 3;                      // each from a new arrangement
constexpr double most_moves = 2e6;                        // of each, over the number of bodies
constexpr int most_jams = 30;                             // in a row that gain less than
constexpr double better = 1.002;                          // of the size
constexpr int last_sweeps = 50;                           // that forget how the bodies came there

double reach_of(const std::vector<Vector>& corners) {
  double reach = 0.0;
  for (const Vector& x : corners) reach = std::max(reach, x.norm());
  return reach;
}

class GrowingBodies {
 public:
  GrowingBodies(const ShapePacking& packing, RandomNumbers& random) : packing_(packing), random_(random) {
    for (const std::vector<Vector>& corners : packing.bodies) {
      reach_.push_back(reach_of(corners));
      hulls_.push_back({.corners = &corners});
    }
    smallest_ = *std::ranges::min_element(reach_);
    step_ = 0.5 * smallest_;
  }

  double dilute_scale() const {
    double volume = 0.0;
    for (const double r : reach_) volume += 4.19 * portable::pow(r + 0.5 * packing_.gap, 3);
    const Vector sides = packing_.upper - packing_.lower;
    const double largest = (0.5 * sides.minCoeff() - packing_.wall_gap) / *std::ranges::max_element(reach_);
    return std::min({1.0, portable::cbrt(dilute_spheres * sides.prod() / volume), most_of_side * largest});
  }

  // Where the spheres around the bodies have room, turned at random.
  void place_at(double scale) {
    SpherePacking spheres{.lower = packing_.lower,
                          .upper = packing_.upper,
                          .radii = {},
                          .gap = packing_.gap,
                          .wall_gap = packing_.wall_gap};
    for (const double r : reach_) spheres.radii.push_back(scale * r);
    const std::vector<Vector> centres = centres_of(spheres);
    for (std::size_t i = 0; i < hulls_.size(); ++i) {
      hulls_[i].centre = centres[i];
      hulls_[i].rotation = random_.rotation();
      hulls_[i].scale = scale;
    }
  }

  // Moves and turns as many bodies as there are, one after the other.
  void sweep() {
    std::size_t moved = 0;
    for (std::size_t k = 0; k < hulls_.size(); ++k) {
      const auto i = std::min(static_cast<std::size_t>(random_.uniform() * double(hulls_.size())), hulls_.size() - 1);
      const PlacedHull before = hulls_[i];
      Vector turn;
      for (int a = 0; a < 3; ++a) {
        hulls_[i].centre[a] += step_ * (2.0 * random_.uniform() - 1.0);
        turn[a] = step_ / reach_[i] * (2.0 * random_.uniform() - 1.0);
      }
      hulls_[i].rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * before.rotation;
      if (has_room(i, 0))
        ++moved;
      else
        hulls_[i] = before;
    }
    const double share = double(moved) / double(hulls_.size());
    if (share < 0.3) step_ *= 0.95;
    if (share > 0.5) step_ = std::min(1.05 * step_, smallest_);
  }

  // All by this factor, up to scale 1; false, and nothing happens, where one has no room.
  bool grow(double growth) {
    const double before = scale();
    set_scale(std::min(1.0, before * (1.0 + growth)));
    for (std::size_t i = 0; i < hulls_.size(); ++i)
      if (!has_room(i, i + 1)) return set_scale(before), false;
    return true;
  }
  void loosen() {
    set_scale(loosening * scale());
    step_ = 0.1 * smallest_;
  }

  double scale() const { return hulls_.front().scale; }
  bool is_jammed() const { return step_ < jammed_step * smallest_; }
  std::vector<ShapePlace> places() const {
    std::vector<ShapePlace> places;
    for (const PlacedHull& hull : hulls_) places.push_back({hull.centre, hull.rotation});
    return places;
  }

 private:
  std::vector<Vector> centres_of(const SpherePacking& spheres) {
    try {
      return pack_spheres(spheres, random_);
    } catch (const InputError&) {  // which speaks of spheres
      throw InputError(
          fmt::format("{} particles with gaps of {}, and {} from the sides, have no room in a box whose shortest side "
                      "is {}: take fewer of them, or smaller gaps",
                      hulls_.size(), quantity_text(packing_.gap, "m"), quantity_text(packing_.wall_gap, "m"),
                      quantity_text((packing_.upper - packing_.lower).minCoeff(), "m")));
    }
  }

  void set_scale(double scale) {
    for (PlacedHull& hull : hulls_) hull.scale = scale;
  }

  bool has_room(std::size_t i, std::size_t first_other) const {
    const PlacedHull& hull = hulls_[i];
    for (int a = 0; a < 3; ++a) {
      const Vector axis = Vector::Unit(a);
      if (hull.farthest(-axis)[a] < packing_.lower[a] + packing_.wall_gap ||
          hull.farthest(axis)[a] > packing_.upper[a] - packing_.wall_gap)
        return false;
    }
    for (std::size_t j = first_other; j < hulls_.size(); ++j) {
      const double near = scale() * (reach_[i] + reach_[j]) + packing_.gap;
      if (j == i || (hull.centre - hulls_[j].centre).squaredNorm() >= near * near) continue;
      if (!are_apart(hull, hulls_[j], packing_.gap)) return false;
    }
    return true;
  }

  const ShapePacking& packing_;
  RandomNumbers& random_;
  std::vector<PlacedHull> hulls_;
  std::vector<double> reach_;  // of the whole bodies, from their centres [m]
  double smallest_ = 0.0;
  double step_ = 0.0;  // [m]
};

// Returns the largest scale that was reached, also where the bodies jam again and again without growing any more.
double grow_bodies(GrowingBodies& bodies, std::size_t n) {
  bodies.place_at(bodies.dilute_scale());
  double growth = fast_growth, best = bodies.scale(), best_before = 0.0;
  int jams = 0;
  for (int done = 0; bodies.scale() < 1.0 && jams < most_jams && done < int(most_moves / double(n)); ++done) {
    bodies.sweep();
    growth = bodies.grow(growth) ? std::min(1.2 * growth, fast_growth) : std::max(0.5 * growth, slow_growth);
    best = std::max(best, bodies.scale());
    if (!bodies.is_jammed() || bodies.scale() == 1.0) continue;
    bodies.loosen();
    jams = best > better * best_before ? 0 : jams + 1;
    if (jams == 0) best_before = best;
  }
  return best;
}

}  // namespace

std::vector<ShapePlace> pack_shapes(const ShapePacking& packing, RandomNumbers& random) {
  if (packing.bodies.empty()) return {};
  double best = 0.0;
  for (int attempt = 0; attempt < most_arrangements; ++attempt) {
    GrowingBodies bodies(packing, random);
    best = std::max(best, grow_bodies(bodies, packing.bodies.size()));
    if (bodies.scale() < 1.0) continue;
    for (int i = 0; i < last_sweeps; ++i) bodies.sweep();
    return bodies.places();
  }
  throw InputError(
      fmt::format("{} particles with gaps of {} found no room: they would have to be {:.2g} % smaller; take a lower "
                  "volume fraction or gap, or another seed",
                  packing.bodies.size(), quantity_text(packing.gap, "m"), 100.0 * (1.0 - best)));
}

}  // namespace pfdm
