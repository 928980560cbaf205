#include "solver/fracture/rate_resolution.h"

#include "physics/quantity_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double fine = 0.1, coarse = 0.25;  // of the law, in a step
constexpr double held = 0.9;                 // of the toughness: what has dissipated more pulls no more

double length_of(const InterfaceStrength& at) { return 2.0 * at.toughness / at.strength; }

double separation(const InterfaceHistory& history) {
  return std::hypot(std::max(0.0, history.opening), history.shear.norm());
}

// The farthest that two places of the boundary move apart in a step, by a direction of the axes [m].
double farthest_apart(const Mesh& mesh, const FractureModel& model, double from, double to) {
  Vector least = Vector::Zero(), most = Vector::Zero();  // what is held does not move
  for (const BoundaryCondition& condition : model.boundary) {
    if (!condition.value) continue;
    const Patch& patch = mesh.patch(condition.patch);
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Vector& x = mesh.face_centre[f];
      const Vector moved = condition.value(x, to) - condition.value(x, from);
      for (int i = 0; i < 3; ++i)
        if (condition.displacement_prescribed[static_cast<std::size_t>(i)]) {
          least[i] = std::min(least[i], moved[i]);
          most[i] = std::max(most[i], moved[i]);
        }
    }
  }
  return (most - least).maxCoeff();
}

}  // namespace

std::vector<std::string> rate_remarks(const Mesh& mesh, const FractureModel& model, const LoadingSettings& loading) {
  std::vector<std::string> lines;
  if (std::ranges::none_of(model.interfaces, [](const CohesiveSurface& s) { return s.law.rate.any(); })) return lines;
  constexpr int samples = 20;
  const double step = std::min(loading.maximum_increment, loading.end);
  double moved = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double t = (loading.end - step) * i / (samples - 1);
    moved = std::max(moved, farthest_apart(mesh, model, t, t + step));
  }
  for (const CohesiveSurface& surface : model.interfaces) {
    if (!surface.law.rate.any()) continue;
    const double length = length_of(*std::ranges::min_element(surface.at, {}, length_of));
    if (!(moved > coarse * length)) continue;
    lines.push_back(fmt::format(
        "interface \"{}\" depends on the rate, which is a mean over a step: in one of {} the boundary moves by up to "
        "{}, and the law is passed within {}. Where faces open as fast as the boundary moves, a maximum_increment of "
        "{:.2g} resolves the rate; behind levers they open more slowly, and the run tells",
        surface.name, quantity_text(step * loading.duration, "s", 3), quantity_text(moved, "m", 3),
        quantity_text(length, "m", 3), step * fine * length / moved));
  }
  return lines;
}

std::string RateResolution::remark(const FractureModel& model, std::span<const InterfaceHistory> from,
                                   std::span<const InterfaceHistory> to, double load) {
  double worst = std::max(coarse, 2.0 * said_);
  std::string line;
  std::size_t k = 0;
  for (const CohesiveSurface& surface : model.interfaces)
    for (const InterfaceStrength& at : surface.at) {
      const InterfaceHistory &before = from[k], &after = to[k];
      ++k;
      if (!surface.law.rate.any() || before.dissipated > held * at.toughness) continue;
      const double part = (separation(after) - separation(before)) / length_of(at);
      if (!(part > worst)) continue;
      worst = said_ = part;
      line = fmt::format(
          "load {:.6g}: a face of interface \"{}\" opens in this step by {:.2g} times the length within which its law "
          "is passed: its rate is a mean over that; a smaller loading.maximum_increment resolves it",
          load, surface.name, part);
    }
  return line;
}

}  // namespace pfdm
