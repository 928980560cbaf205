#pragma once
// Discs with a history between bonded plates, four times as wide as thick, that are pulled: a sector of them.

#include "mesh/generators/cylinder_sector.h"
#include "physics/materials/prony.h"
#include "solver/fracture/fracture_run.h"
#include "tests/verification/support.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace pfdm::verification::discs {

inline constexpr double mu = 1e6;  // [Pa]
inline constexpr StaggeredSettings to_rounding{
    .damage_tolerance = 1e-9, .energy_tolerance = 1e-12, .equilibrium_tolerance = 1e-12};

inline constexpr double radius = 1.0, height = 0.25, azimuth = std::numbers::pi / 36.0, rise = 1e-3 * height;
inline const double area = 0.5 * std::sin(azimuth) * radius * radius;

inline Mesh disc(Index in_radius, Index in_height) {
  return make_cylinder_sector(
      {.azimuth = azimuth, .radius = {{radius, in_radius, 1.0}}, .height = {{height, in_height, 1.0}}});
}

/// `grown` is the share of the rise at a load parameter.
inline FractureModel disc_model(const RegionModel& region, const std::function<double(double)>& grown) {
  FractureModel model = elastic_model(
      {region.elasticity}, {axisymmetric_on("front"), axisymmetric_on("back"),
                            displacement_on("bottom", [](const Vector&) -> Vector { return Vector::Zero(); }),
                            moved("top", {true, true, true}, [grown](const Vector&, double t) -> Vector {
                              return rise * grown(t) * Vector::UnitZ();
                            })});
  model.regions[0].material = region.material;
  return model;
}

inline RegionModel elastic_region(const IsotropicElasticity& elasticity) {
  RegionModel region;
  region.elasticity = elasticity;
  return region;
}

struct Pulled {
  double modulus = 0.0;  // mean stress over nominal strain and mu
  double account = 0.0;  // what is left of the work, relative
};

inline Pulled pulled(const Mesh& mesh, const StepReport& report) {
  const auto top = mesh.patch_index("top");
  return {.modulus = report.reaction[top].z() / area / (rise / height) / mu,
          .account = left_over({}, report.energy) / report.energy.external_work};
}

inline constexpr StaggeredSettings closely{.energy_tolerance = 1e-9, .equilibrium_tolerance = 1e-10};

/// In one step of this duration [s].
inline Pulled pull_at_once(const Mesh& mesh, const RegionModel& region, double duration,
                           const StaggeredSettings& settings = to_rounding) {
  FractureRun run(mesh, disc_model(region, [](double t) { return t; }), settings,
                  {.initial_increment = 1.0, .maximum_increment = 1.0, .duration = duration, .stops = {}});
  Pulled result;
  run_to_end(run, [&](const FractureState&, const StepReport& report) {
    if (report.step > 0) result = pulled(mesh, report);
  });
  return result;
}

/// Shear modulus of the branch of rubber over mu, the relaxed one.
inline constexpr double rubber_branch = 20.0;

/// Rubber at once, with this Poisson's ratio.
inline IsotropicElasticity stiff_rubber(double poisson) {
  return from_young_poisson(2.0 * (1.0 + rubber_branch) * mu * (1.0 + poisson), poisson);
}

/// The same that relaxes within a second; its bulk modulus stays.
inline PronyLaw relaxing_rubber(double poisson) {
  return {.relaxed = {.lambda = stiff_rubber(poisson).bulk_modulus() - 2.0 * mu / 3.0, .mu = mu},
          .shear = {{rubber_branch * mu, 1.0}}};
}

/// Of a Prony series, whose elasticity is the instantaneous one.
inline RegionModel relaxing_region(const PronyLaw& law) {
  RegionModel region;
  region.material = make_prony(law);
  region.elasticity = region.material->elasticity();
  return region;
}

/// Steps that pull at once, and then hold for this duration [s], in steps of at most `step` [s].
inline constexpr double ramp = 1e-7;  // of the load parameter
inline LoadingSettings held(double duration, double step, std::vector<double> stops = {}) {
  for (double& stop : stops) stop /= duration;
  return {.initial_increment = ramp,
          .minimum_increment = 1e-12,
          .maximum_increment = step / duration,
          .duration = duration,
          .stops = std::move(stops),
          .is_proportional = false};
}
inline double pulled_at_once(double t) { return std::min(t / ramp, 1.0); }

}  // namespace pfdm::verification::discs
