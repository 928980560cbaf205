#include "solver/scalar/diffusion.h"

#include "physics/error.h"
#include "solver/scalar/diffusion_exchanges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace pfdm {
namespace {

using Kind = DiffusionBoundary::Kind;

void require_positive(const CellField<double>& field, const Mesh& mesh, std::string_view name) {
  if (field.size() != mesh.n_cells()) throw InputError(fmt::format("diffusion: {} is not given for each cell", name));
  for (const double value : field)
    if (!(value > 0.0)) throw InputError(fmt::format("diffusion: {} has to be positive, found {:.4g}", name, value));
}

// Into each cell from the patches whose flux is given [W].
CellField<double> inflow_of(const Mesh& mesh, const std::vector<DiffusionBoundary>& boundary) {
  CellField<double> inflow(mesh.n_cells(), 0.0);
  for (const DiffusionBoundary& on : boundary) {
    if (on.kind != Kind::flux) continue;
    const Patch& patch = mesh.patch(on.patch);
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      inflow[mesh.owner[f]] += on.value * mesh.face_area[f].norm();
  }
  return inflow;
}

void require_one_each(const std::vector<DiffusionBoundary>& boundary) {
  for (std::size_t i = 0; i < boundary.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (boundary[i].patch == boundary[j].patch)
        throw InputError(fmt::format("patch \"{}\" has two boundary conditions", boundary[i].patch));
}

struct DiffusionTerm {
  const Mesh& mesh;
  const DiffusionProblem& problem;
  const CellField<double>& inflow;
  const CellField<double>& before;
  double rate = 0.0;  // 1/dt [1/s]; 0: steady

  bool is_free(Index) const { return true; }
  double slope(Index c, double u) const {
    double density = rate > 0.0 ? rate * problem.capacity[c] * (u - before[c]) : 0.0;
    if (problem.source) density -= problem.source(c, u).value;
    return mesh.cell_volume[c] * density - inflow[c];
  }
  double curvature(Index c, double u) const {
    double density = rate > 0.0 ? rate * problem.capacity[c] : 0.0;
    if (problem.source) density -= problem.source(c, u).slope;
    return mesh.cell_volume[c] * density;
  }
  double lower(Index) const { return -std::numeric_limits<double>::infinity(); }
  double upper(Index) const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace

std::vector<Exchange> exchanges_of(const Mesh& mesh, const std::vector<DiffusionBoundary>& boundary) {
  std::vector<Exchange> exchanges;
  for (const DiffusionBoundary& on : boundary) {
    if (on.kind == Kind::flux) continue;
    if (on.kind == Kind::exchange && !(on.coefficient > 0.0))
      throw InputError(fmt::format("patch \"{}\": the exchange coefficient has to be positive, found {:.4g}", on.patch,
                                   on.coefficient));
    const Patch& patch = mesh.patch(on.patch);
    const double coefficient = on.kind == Kind::exchange ? on.coefficient : std::numeric_limits<double>::infinity();
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      exchanges.push_back({.face = f, .cell = mesh.owner[f], .coefficient = coefficient, .value = on.value});
  }
  return exchanges;
}

struct Diffusion::Parts {
  const Mesh& mesh;
  DiffusionProblem problem;
  TwoPointFlux flux;
  CellField<double> inflow;
};

Diffusion::Diffusion(const Mesh& mesh, DiffusionProblem problem) {
  require_positive(problem.conductivity, mesh, "the conductivity");
  if (problem.capacity.size() > 0) require_positive(problem.capacity, mesh, "the heat capacity");
  require_one_each(problem.boundary);
  TwoPointFlux flux(mesh, {.conductance = problem.conductivity,
                           .exchanges = exchanges_of(mesh, problem.boundary),
                           .plane_normal = problem.plane_normal,
                           .resistance = problem.resistance});
  CellField<double> inflow = inflow_of(mesh, problem.boundary);
  parts_.reset(new Parts{mesh, std::move(problem), std::move(flux), std::move(inflow)});
}

Diffusion::~Diffusion() = default;

ScalarSolution Diffusion::solve_steady(CellField<double>& u) {
  const auto fixes_level = [](const DiffusionBoundary& on) { return on.kind != Kind::flux; };
  if (!parts_->problem.source && std::ranges::none_of(parts_->problem.boundary, fixes_level))
    throw InputError("steady diffusion: no patch has a value or an exchange, so the level of the field is arbitrary");
  return solve(0.0, u);
}

ScalarSolution Diffusion::step(double dt, CellField<double>& u) {
  if (!(dt > 0.0)) throw InputError(fmt::format("diffusion: the time step has to be positive, found {:.4g} s", dt));
  if (parts_->problem.capacity.size() == 0) throw InputError("diffusion: a transient problem needs the heat capacity");
  return solve(1.0 / dt, u);
}

// The deferred flux is updated until the field no longer changes. From a field of zeros on without a value at a patch
// nothing says yet what is small: the first solution is as exact as its own first step says.
ScalarSolution Diffusion::solve(double rate, CellField<double>& u) {
  constexpr Index most_updates = 100;
  const Parts& p = *parts_;
  const double precision = p.problem.precision;
  const CellField<double> start = u;
  const DiffusionTerm term{p.mesh, p.problem, p.inflow, start, rate};
  BoundedNewton newton(parts_->flux, term, u);
  ScalarSolution account;
  for (Index update = 0; update < most_updates; ++update) {
    double scale = 0.0;
    for (const DiffusionBoundary& on : p.problem.boundary)
      if (on.kind != Kind::flux) scale = std::max(scale, std::abs(on.value));
    for (const double value : u) scale = std::max(scale, std::abs(value));
    const CellField<double> before = u;
    account = newton.solve({.least_step = 0.01 * precision * scale});
    const double change = parallel_max(u.size(), [&](Index c) { return std::abs(u[c] - before[c]); });
    if (!account.converged) break;
    if (change <= precision * scale) return account;
  }
  account.converged = false;
  return account;
}

double Diffusion::outflow(const std::string& name, const CellField<double>& u) const {
  const Patch& patch = parts_->mesh.patch(name);
  double sum = 0.0;
  for (std::size_t k = 0; k < parts_->flux.exchanges().size(); ++k)
    if (const Index f = parts_->flux.exchanges()[k].face; f >= patch.first_face && f < patch.first_face + patch.n_faces)
      sum += parts_->flux.exchange_flux(k, u);
  for (const DiffusionBoundary& on : parts_->problem.boundary)
    if (on.patch == name && on.kind == Kind::flux)
      for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
        sum -= on.value * parts_->mesh.face_area[f].norm();
  return sum;
}

}  // namespace pfdm
