#include "solver/dynamics/heated_body.h"

#include "physics/error.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

CellField<double> uniform(const Mesh& mesh, double value) { return CellField<double>(mesh.n_cells(), value); }

double over_volume(const Mesh& mesh, const CellField<double>& density) {
  return parallel_sum(mesh.n_cells(), [&](Index c) { return mesh.cell_volume[c] * density[c]; });
}

}  // namespace

double conductance_of_radiation(double emissivity, double temperature) {
  constexpr double stefan_boltzmann = 5.670374419e-8;  // [W/(m^2 K^4)]
  return 4.0 * emissivity * stefan_boltzmann * temperature * temperature * temperature;
}

HeatedBody::HeatedBody(const Mesh& mesh, const HeatedMaterial& material, std::vector<DiffusionBoundary> boundary)
    : mesh_(mesh),
      material_(material),
      boundary_(std::move(boundary)),
      source_(uniform(mesh, 0.0)),
      rise_(uniform(mesh, 0.0)),
      diffusion_(mesh, {.conductivity = uniform(mesh, material.conductivity),
                        .capacity = uniform(mesh, material.capacity),
                        .boundary = boundary_,
                        .source = [this](Index c, double) { return DiffusionSource{.value = source_[c]}; },
                        .precision = 1e-11}) {}

void HeatedBody::set_source(CellField<double> source) { source_ = std::move(source); }

void HeatedBody::step(double dt) {
  if (!diffusion_.step(dt, rise_).converged)
    throw ComputationError(fmt::format("conduction of heat: a step of {:.4g} s did not converge", dt));
  account_.heat += dt * over_volume(mesh_, source_);
  account_.stored = material_.capacity * over_volume(mesh_, rise_);
  for (const DiffusionBoundary& on : boundary_) account_.lost += dt * diffusion_.outflow(on.patch, rise_);
}

// The flux from the cell to the face goes on into the surroundings.
std::vector<double> HeatedBody::face_rise(const std::string& name, const CellField<double>& cells) const {
  using Kind = DiffusionBoundary::Kind;
  const Patch& patch = mesh_.patch(name);
  const auto found = std::ranges::find(boundary_, name, &DiffusionBoundary::patch);
  std::vector<double> rise;
  for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
    const Index c = mesh_.owner[f];
    double value = cells[c];
    if (found != boundary_.end()) {
      const Vector n = mesh_.face_area[f].normalized();
      const double within = material_.conductivity / std::abs((mesh_.face_centre[f] - mesh_.cell_centre[c]).dot(n));
      if (found->kind == Kind::value) value = found->value;
      if (found->kind == Kind::flux) value += found->value / within;
      if (found->kind == Kind::exchange)
        value = (within * value + found->coefficient * found->value) / (within + found->coefficient);
    }
    rise.push_back(value);
  }
  return rise;
}

SurfaceTemperature HeatedBody::surface(const std::string& name, const CellField<double>& cells) const {
  const Patch& patch = mesh_.patch(name);
  const std::vector<double> rise = face_rise(name, cells);
  SurfaceTemperature result{.mean = 0.0, .largest = rise.front()};
  double area = 0.0;
  for (std::size_t k = 0; k < rise.size(); ++k) {
    const double part = mesh_.face_area[patch.first_face + static_cast<Index>(k)].norm();
    area += part;
    result.mean += part * rise[k];
    result.largest = std::max(result.largest, rise[k]);
  }
  result.mean /= area;
  return result;
}

}  // namespace pfdm
