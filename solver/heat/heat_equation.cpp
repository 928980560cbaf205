#include "solver/heat/heat_equation.h"

#include "physics/error.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pfdm {
namespace {

constexpr double gamma = 0.29289321881345248;  // 1 - 1/sqrt(2)
constexpr double precision = 1e-10;            // of a stage's rises, relative

}  // namespace

HeatEquation::HeatEquation(const Mesh& mesh, HeatBody body)
    : mesh_(mesh), body_(std::move(body)), source_(mesh.n_cells(), 0.0) {
  for (std::size_t k = 0; k < body_.interfaces.size(); ++k)
    transmittance_.push_back(transmittance(k, std::numeric_limits<double>::infinity()));
  build();
}

HeatEquation::~HeatEquation() = default;

double HeatEquation::give(Index face, Index cell) const {
  const Vector n = mesh_.face_area[face].normalized();
  return std::abs((mesh_.face_centre[face] - mesh_.cell_centre[cell]).dot(n)) / body_.conductivity[cell];
}

double HeatEquation::resistance_beside(std::size_t k) const {
  const Index f = body_.interfaces[k];
  return give(f, mesh_.owner[f]) + give(f, mesh_.neighbour[f]);
}

double HeatEquation::transmittance(std::size_t k, double conductance) const {
  return conductance > 0.0 ? 1.0 / (resistance_beside(k) + 1.0 / conductance) : 0.0;
}

void HeatEquation::set_transmittance(const std::vector<double>& transmittance) {
  if (transmittance == transmittance_) return;
  transmittance_ = transmittance;
  build();
}

void HeatEquation::build() {
  DiffusionProblem problem{
      .conductivity = body_.conductivity,
      .capacity = body_.capacity,
      .boundary = body_.boundary,
      .source = [this](Index c, double) { return DiffusionSource{.value = source_[c]}; },
      .plane_normal = body_.plane_normal,
      .precision = precision,
  };
  if (!body_.interfaces.empty()) problem.resistance = FaceField<double>(mesh_.n_faces(), 0.0);
  constexpr double rounding = 1e-12;
  for (std::size_t k = 0; k < body_.interfaces.size(); ++k) {
    const double whole = 1.0 / transmittance_[k], own = whole - resistance_beside(k);
    problem.resistance[body_.interfaces[k]] = std::isinf(whole) || own > rounding * whole ? own : 0.0;
  }
  diffusion_ = std::make_unique<Diffusion>(mesh_, std::move(problem));
}

void HeatEquation::add_interfaces(const std::vector<double>& made, CellField<double>& heat) const {
  for (std::size_t k = 0; k < body_.interfaces.size(); ++k) {
    const Index f = body_.interfaces[k], P = mesh_.owner[f], N = mesh_.neighbour[f];
    const double part_of_P = 0.5 * (1.0 + (give(f, N) - give(f, P)) * transmittance_[k]);
    heat[P] += part_of_P * made[k];
    heat[N] += (1.0 - part_of_P) * made[k];
  }
}

double HeatEquation::outflow(const CellField<double>& rise) const {
  double sum = 0.0;
  for (const DiffusionBoundary& on : body_.boundary) sum += diffusion_->outflow(on.patch, rise);
  return sum;
}

double HeatEquation::stored(const CellField<double>& rise) const {
  return parallel_sum(mesh_.n_cells(), [&](Index c) { return mesh_.cell_volume[c] * body_.capacity[c] * rise[c]; });
}

void HeatEquation::step(double dt, const CellField<double>& heat, CellField<double>& rise, HeatBalance& account) {
  const auto advance = [&](CellField<double>& u) {
    if (!diffusion_->step(gamma * dt, u).converged)
      throw ComputationError(
          fmt::format("conduction of heat: a step of {:.4g} s did not converge; very skewed cells, as at the centre of "
                      "a sphere_sector without inner_radius, are the usual cause",
                      dt));
    return outflow(u);
  };
  parallel_for(mesh_.n_cells(), [&](Index c) { source_[c] = heat[c] / (dt * mesh_.cell_volume[c]); });
  CellField<double> first = rise;
  const double lost_first = advance(first);
  constexpr double beyond = (1.0 - gamma) / gamma;
  parallel_for(mesh_.n_cells(), [&](Index c) { rise[c] += beyond * (first[c] - rise[c]); });
  const double lost_last = advance(rise);
  account.made += parallel_sum(mesh_.n_cells(), [&](Index c) { return heat[c]; });
  account.stored = stored(rise);
  account.lost += dt * ((1.0 - gamma) * lost_first + gamma * lost_last);
}

std::vector<HeatRow> HeatEquation::under_steady_source(const CellField<double>& power, double time, Index n,
                                                       CellField<double>& rise) {
  const double dt = time / static_cast<double>(n);
  CellField<double> heat = power;
  for (double& q : heat) q *= dt;
  std::vector<HeatRow> rows{{.time = 0.0, .figures = figures(rise), .account = {.stored = stored(rise)}}};
  for (Index i = 1; i <= n; ++i) {
    HeatRow row = rows.back();
    step(dt, heat, rise, row.account);
    row.time = time * static_cast<double>(i) / static_cast<double>(n);
    row.figures = figures(rise);
    rows.push_back(row);
  }
  return rows;
}

HeatFigures HeatEquation::figures(const CellField<double>& rise) const {
  const auto most = static_cast<Index>(std::max_element(rise.begin(), rise.end()) - rise.begin());
  const double whole = parallel_sum(mesh_.n_cells(), [&](Index c) { return mesh_.cell_volume[c] * body_.capacity[c]; });
  return {.greatest = rise[most], .mean = stored(rise) / whole, .place = mesh_.cell_centre[most]};
}

}  // namespace pfdm
