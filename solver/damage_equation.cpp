#include "solver/damage_equation.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace pfdm {
namespace {

constexpr Index factor_block = 8192;       // rows that one incomplete factorisation couples
constexpr double linear_reduction = 5e-4;  // of the residual, by each linear solve
constexpr double least_diagonal = 0.1;     // of the sum of a row's coefficients

// Cells whose damage gradient may look at each other: those with equal conductance, so that no kink lies between.
CellField<Index> smooth_zones(const Mesh& mesh, const FractureModel& model) {
  std::map<std::pair<double, bool>, Index> number;
  CellField<Index> zone(as_size(mesh.n_cells()));
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = model.regions[as_size(mesh.region[c])];
    zone[c] = number.try_emplace({region.Gc * region.ell, region.damageable}, static_cast<Index>(number.size()))
                  .first->second;
  }
  return zone;
}

}  // namespace

DamageEquation::DamageEquation(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal)
    : mesh_(mesh),
      model_(model),
      damageable_(as_size(mesh.n_cells())),
      density_(as_size(mesh.n_cells())),
      conductance_(as_size(mesh.n_cells())),
      pinned_(as_size(mesh.n_cells()), 0.0),
      gradient_((build_links(), build_gradient(plane_normal))),
      gradients_(as_size(mesh.n_cells()), Vector::Zero()),
      range_(as_size(mesh.n_cells()), 0.0) {
  build_rows();
}

void DamageEquation::build_links() {
  for (Index c = 0; c < mesh_.n_cells(); ++c) {
    const RegionModel& region = model_.in_cell(mesh_, c);
    damageable_[c] = region.damageable ? 1 : 0;
    density_[c] = region.damageable ? region.Gc / (model_.crack->c0 * region.ell) : 0.0;
    conductance_[c] = region.damageable ? 2.0 * region.Gc * region.ell / model_.crack->c0 : 0.0;
  }
  for (Index f = 0; f < mesh_.n_interior_faces(); ++f) {
    const Index P = mesh_.owner[f], N = mesh_.neighbour[f];
    const double area = mesh_.face_area[f].norm();
    const Vector n = mesh_.face_area[f] / area;
    const double h_P = std::abs((mesh_.face_centre[f] - mesh_.cell_centre[P]).dot(n));
    const double h_N = std::abs((mesh_.face_centre[f] - mesh_.cell_centre[N]).dot(n));
    if (is_damageable(P) && is_damageable(N)) {
      const Vector centre_line = (mesh_.cell_centre[N] - mesh_.cell_centre[P]).normalized();
      links_.push_back({.face = f,
                        .P = P,
                        .N = N,
                        .coefficient = area / (h_P / conductance_[P] + h_N / conductance_[N]),
                        .corrected = (centre_line - n).norm() > 1e-3});
    } else if (is_damageable(P)) {
      pinned_[P] += area * conductance_[P] / h_P;
    } else if (is_damageable(N)) {
      pinned_[N] += area * conductance_[N] / h_N;
    }
  }
  correction_.assign(links_.size(), 0.0);
}

Gradient DamageEquation::build_gradient(const Vector& plane_normal) {
  std::vector<char> wanted(as_size(mesh_.n_cells()), 0);
  for (const Link& link : links_)
    if (link.corrected) wanted[as_size(link.P)] = wanted[as_size(link.N)] = 1;
  return Gradient(mesh_, {.zone = smooth_zones(mesh_, model_),
                          .node_of_face = {},
                          .plane_normal = plane_normal,
                          .wanted = std::move(wanted),
                          .zero_if_deficient = true});
}

void DamageEquation::build_rows() {
  const Index n = mesh_.n_cells();
  std::vector<std::vector<std::pair<Index, double>>> across(as_size(n));
  for (const Link& link : links_) {
    across[as_size(link.P)].emplace_back(link.N, link.coefficient);
    across[as_size(link.N)].emplace_back(link.P, link.coefficient);
  }
  rows_.resize(as_size(n));
  total_.assign(as_size(n), 0.0);
  deferred_.assign(as_size(n), 0.0);
  columns_.reserve(2 * links_.size());
  coefficients_.reserve(2 * links_.size());
  for (Index c = 0; c < n; ++c) {
    auto& entries = across[as_size(c)];
    std::sort(entries.begin(), entries.end());
    const Index block_begin = c / factor_block * factor_block, block_end = block_begin + factor_block;
    Row& row = rows_[as_size(c)];
    const auto reached = [this] { return static_cast<std::int32_t>(columns_.size()); };
    row.begin = row.below = row.diagonal = row.above = reached();
    for (const auto& [column, coefficient] : entries) {
      columns_.push_back(static_cast<std::int32_t>(column));
      coefficients_.push_back(coefficient);
      total_[as_size(c)] += coefficient;
      if (column < block_begin) row.below = reached();
      if (column < c) row.diagonal = reached();
      if (column < block_end) row.above = reached();
    }
    row.end = reached();
  }
}

// The two-sided flux is c (d_N + grad_N.d_N - d_P - grad_P.d_P) plus the averaged normal gradients; what is beyond
// c (d_N - d_P) is deferred, and never moves either side by more than the damage ranges over around it: at the corner
// of a front the gradients overshoot, and the active set would flip for ever.
void DamageEquation::renew_correction(const CellField<double>& d) {
  parallel_for(mesh_.n_cells(), [&](Index c) {
    gradients_[as_size(c)] = gradient_.of(d.data(), c);
    double least = d[c], most = d[c];
    for (auto k = rows_[as_size(c)].begin; k < rows_[as_size(c)].end; ++k) {
      least = std::min(least, d[columns_[as_size(k)]]);
      most = std::max(most, d[columns_[as_size(k)]]);
    }
    range_[as_size(c)] = most - least;
  });
  parallel_for(static_cast<Index>(links_.size()), [&](Index i) {
    const Link& link = links_[as_size(i)];
    if (!link.corrected) return;
    const double area = mesh_.face_area[link.face].norm();
    const Vector n = mesh_.face_area[link.face] / area;
    const Vector d_P = mesh_.face_centre[link.face] - mesh_.cell_centre[link.P];
    const Vector d_N = mesh_.face_centre[link.face] - mesh_.cell_centre[link.N];
    const Vector& grad_P = gradients_[as_size(link.P)];
    const Vector& grad_N = gradients_[as_size(link.N)];
    // Only the part of each centre-to-face vector that lies in the face is not in the two-point flux.
    const double beyond = grad_N.dot(d_N - d_N.dot(n) * n) - grad_P.dot(d_P - d_P.dot(n) * n);
    const double most = std::min(range_[as_size(link.P)], range_[as_size(link.N)]);
    correction_[as_size(i)] = link.coefficient * std::clamp(beyond, -most, most);
  });
  std::fill(deferred_.begin(), deferred_.end(), 0.0);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    deferred_[as_size(links_[i].P)] += correction_[i];
    deferred_[as_size(links_[i].N)] -= correction_[i];
  }
}

double DamageEquation::local_slope(Index cell, double d, double psi) const {
  const RationalCoefficients& rational = model_.in_cell(mesh_, cell).rational;
  const double slope = density_[cell] * model_.crack->alpha_prime(d) +
                       (1.0 - model_.residual_stiffness) * model_.degradation->g_prime(d, rational) * psi;
  const double source = source_.size() > 0 ? source_[cell] : 0.0;
  const double resistance = resistance_ > 0.0 ? resistance_ * (d - from_[cell]) : 0.0;
  return mesh_.cell_volume[cell] * (slope + resistance - source);
}

double DamageEquation::local_curvature(Index cell, double d, double psi) const {
  const RationalCoefficients& rational = model_.in_cell(mesh_, cell).rational;
  return mesh_.cell_volume[cell] *
         (density_[cell] * model_.crack->alpha_second(d) + resistance_ +
          (1.0 - model_.residual_stiffness) * model_.degradation->g_second(d, rational) * psi);
}

void DamageEquation::resist_change(double resistance, const CellField<double>& from) {
  resistance_ = resistance;
  from_ = from;
}

double DamageEquation::viscous_dissipation(const CellField<double>& d) const {
  if (!(resistance_ > 0.0)) return 0.0;
  return parallel_sum(mesh_.n_cells(), [&](Index c) {
    const double change = d[c] - from_[c];
    return mesh_.cell_volume[c] * resistance_ * change * change;
  });
}

double DamageEquation::times_off_diagonal(Index cell, const double* x) const {
  const Row& row = rows_[as_size(cell)];
  double sum = 0.0;
  for (auto k = row.begin; k < row.end; ++k) sum += coefficients_[as_size(k)] * x[columns_[as_size(k)]];
  return sum;
}

double DamageEquation::residual(Index cell, const CellField<double>& d, double psi) const {
  return local_slope(cell, d[cell], psi) + (pinned_[cell] + total_[as_size(cell)]) * d[cell] -
         times_off_diagonal(cell, d.data()) - deferred_[as_size(cell)];
}

DamageSolution DamageEquation::solve(const CellField<double>& psi_plus, const CellField<double>& lower,
                                     const Tolerance& tolerance, CellField<double>& d) {
  constexpr Index most_changes = 50;  // of the active set
  const Index n = mesh_.n_cells();
  DamageSolution account;
  std::vector<double> r(as_size(n)), diagonal(as_size(n)), step(as_size(n));
  ActiveSet active(as_size(n), 0);
  for (Index correction = 0; correction < tolerance.corrections; ++correction) {
    renew_correction(d);
    account.converged = false;
    double target = 0.0;  // of the step that each cell would still take
    parallel_for(n, [&](Index c) { active[as_size(c)] = is_free(c) ? 0 : 1; });
    for (Index change = 0; change < most_changes; ++change) {
      parallel_for(n, [&](Index c) {
        // Where alpha is concave (Wu), cells much wider than ell would have a negative diagonal, and sound ones break.
        const double links = pinned_[c] + total_[as_size(c)];
        const double stiffness = links + local_curvature(c, std::clamp(d[c], 0.0, 1.0), psi_plus[c]);
        diagonal[as_size(c)] = links > 0.0 ? std::max(stiffness, least_diagonal * links) : stiffness;
      });
      choose_active(psi_plus, lower, diagonal, d, active);
      parallel_for(n, [&](Index c) {
        r[as_size(c)] = active[as_size(c)] != 0 ? 0.0 : -residual(c, d, psi_plus[c]);
        step[as_size(c)] = 0.0;
      });
      const double wanted = parallel_max(n, [&](Index c) { return std::abs(r[as_size(c)]) / diagonal[as_size(c)]; });
      if (change == 0) target = std::max(tolerance.reduction * wanted, 1e-10);
      account.converged = wanted <= target;
      if (account.converged) break;
      solve_linear(diagonal, active, r, step, account);
      parallel_for(n, [&](Index c) { d[c] += step[as_size(c)]; });
      ++account.active_set_iterations;
    }
    parallel_for(n, [&](Index c) {
      if (is_free(c)) d[c] = std::clamp(d[c], lower[c], 1.0);
    });
  }
  return account;
}

CellField<double> DamageEquation::relaxed(const CellField<double>& given) {
  constexpr Index most_turns = 100;  // of the deferred correction, and of an active set that has far to go
  constexpr double precision = 1e-6;
  const CellField<double> no_energy(as_size(mesh_.n_cells()), 0.0);
  CellField<double> d = given;
  for (Index turn = 0; turn < most_turns; ++turn) {
    const CellField<double> before = d;
    const DamageSolution solution = solve(no_energy, given, {}, d);
    const double change = parallel_max(d.size(), [&](Index c) { return std::abs(d[c] - before[c]); });
    if (solution.converged && change < precision) break;
  }
  return d;
}

// Cells that a Newton step of their own would carry beyond a bound are put on it.
void DamageEquation::choose_active(const CellField<double>& psi_plus, const CellField<double>& lower,
                                   const std::vector<double>& diagonal, CellField<double>& d, ActiveSet& active) const {
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (!is_free(c)) return;
    const double wanted = d[c] - residual(c, d, psi_plus[c]) / diagonal[as_size(c)];
    active[as_size(c)] = wanted < lower[c] ? -1 : (wanted > 1.0 ? 1 : 0);
  });
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (is_free(c) && active[as_size(c)] != 0) d[c] = active[as_size(c)] < 0 ? lower[c] : 1.0;
  });
}

// Incomplete Cholesky with the pattern of the matrix and only its diagonal changed (Meijerink, van der Vorst 1977),
// within fixed blocks of rows.
void DamageEquation::factor(const std::vector<double>& diagonal, const ActiveSet& active) {
  pivots_ = diagonal;
  parallel_chunks(
      mesh_.n_cells(),
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
          if (active[as_size(i)] != 0) continue;
          const Row& row = rows_[as_size(i)];
          for (auto k = row.below; k < row.diagonal; ++k)
            if (const auto j = as_size(columns_[as_size(k)]); active[j] == 0)
              pivots_[as_size(i)] -= coefficients_[as_size(k)] * coefficients_[as_size(k)] / pivots_[j];
        }
        for (Index i = begin; i < end; ++i)
          pivots_[as_size(i)] = active[as_size(i)] != 0 ? 0.0 : 1.0 / pivots_[as_size(i)];
      },
      factor_block);
}

// Returns r.z; pivots_ are inverted, and zero in active rows.
double DamageEquation::precondition(const std::vector<double>& r, std::vector<double>& z) const {
  std::vector<double> products(rows_.size() / as_size(factor_block) + 1, 0.0);
  parallel_chunks(
      mesh_.n_cells(),
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
          const Row& row = rows_[as_size(i)];
          double sum = r[as_size(i)];
          for (auto k = row.below; k < row.diagonal; ++k)
            sum += coefficients_[as_size(k)] * z[as_size(columns_[as_size(k)])];
          z[as_size(i)] = sum * pivots_[as_size(i)];
        }
        double product = 0.0;
        for (Index i = end - 1; i >= begin; --i) {
          const Row& row = rows_[as_size(i)];
          double sum = 0.0;
          for (auto k = row.diagonal; k < row.above; ++k)
            sum += coefficients_[as_size(k)] * z[as_size(columns_[as_size(k)])];
          z[as_size(i)] += sum * pivots_[as_size(i)];
          product += r[as_size(i)] * z[as_size(i)];
        }
        products[as_size(begin / factor_block)] = product;
      },
      factor_block);
  return std::accumulate(products.begin(), products.end(), 0.0);
}

// Conjugate gradients on the inactive rows; the residual falls by linear_reduction, or to rounding.
void DamageEquation::solve_linear(const std::vector<double>& diagonal, const ActiveSet& active, std::vector<double>& r,
                                  std::vector<double>& x, DamageSolution& account) {
  constexpr Index most_iterations = 500;
  const Index n = mesh_.n_cells();
  double largest = parallel_max(n, [&](Index i) { return std::abs(r[as_size(i)]) / diagonal[as_size(i)]; });
  const double target = std::max(1e-11, linear_reduction * largest);
  if (largest <= 1e-11) return;
  factor(diagonal, active);
  std::vector<double> z(as_size(n)), p(as_size(n), 0.0), q(as_size(n), 0.0);
  double rho_before = 0.0;
  for (Index iteration = 0; iteration < most_iterations && largest > target; ++iteration) {
    const double rho = precondition(r, z);
    const double beta = iteration == 0 ? 0.0 : rho / rho_before;
    rho_before = rho;
    parallel_for(n, [&](Index i) { p[as_size(i)] = z[as_size(i)] + beta * p[as_size(i)]; });
    const double curvature = parallel_sum(n, [&](Index i) {
      if (active[as_size(i)] != 0) return 0.0;
      q[as_size(i)] = diagonal[as_size(i)] * p[as_size(i)] - times_off_diagonal(i, p.data());
      return p[as_size(i)] * q[as_size(i)];
    });
    const double alpha = rho / curvature;
    largest = parallel_max(n, [&](Index i) {
      x[as_size(i)] += alpha * p[as_size(i)];
      r[as_size(i)] -= alpha * q[as_size(i)];
      return std::abs(r[as_size(i)]) / diagonal[as_size(i)];
    });
    ++account.krylov_iterations;
  }
}

double DamageEquation::local_energy(Index c, double d) const {
  return mesh_.cell_volume[c] * density_[c] * model_.crack->alpha(d) + 0.5 * pinned_[c] * d * d;
}

double DamageEquation::gradient_energy(Index i, const CellField<double>& d) const {
  const Link& link = links_[as_size(i)];
  const double jump = d[link.N] - d[link.P];
  return 0.5 * jump * (link.coefficient * jump + correction_[as_size(i)]);
}

double DamageEquation::fracture_energy(const CellField<double>& d) const {
  const double local = parallel_sum(mesh_.n_cells(), [&](Index c) { return local_energy(c, d[c]); });
  return local + parallel_sum(static_cast<Index>(links_.size()), [&](Index i) { return gradient_energy(i, d); });
}

CellField<double> DamageEquation::fracture_energy_density(const CellField<double>& d) const {
  CellField<double> energy(as_size(mesh_.n_cells()));
  for (Index c = 0; c < mesh_.n_cells(); ++c) energy[c] = local_energy(c, d[c]);
  for (Index i = 0; i < static_cast<Index>(links_.size()); ++i) {
    const double half = 0.5 * gradient_energy(i, d);
    energy[links_[as_size(i)].P] += half;
    energy[links_[as_size(i)].N] += half;
  }
  for (Index c = 0; c < mesh_.n_cells(); ++c) energy[c] /= mesh_.cell_volume[c];
  return energy;
}

double DamageEquation::renewed_fracture_energy(const CellField<double>& d) {
  renew_correction(d);
  return fracture_energy(d);
}

}  // namespace pfdm
