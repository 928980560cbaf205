#include "solver/damage_equation.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace pfdm {
namespace {

constexpr Index factor_block = 8192;  // rows that one incomplete factorisation couples

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
      gradients_(as_size(mesh.n_cells()), Vector::Zero()) {
  build_rows();
}

void DamageEquation::build_links() {
  for (Index c = 0; c < mesh_.n_cells(); ++c) {
    const RegionModel& region = model_.regions[as_size(mesh_.region[c])];
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
  offsets_.assign(as_size(mesh_.n_cells()) + 1, 0);
  for (const Link& link : links_) {
    ++offsets_[as_size(link.P) + 1];
    ++offsets_[as_size(link.N) + 1];
  }
  for (std::size_t c = 0; c + 1 < offsets_.size(); ++c) offsets_[c + 1] += offsets_[c];
  entries_.resize(offsets_.back());
  std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    entries_[next[as_size(link.P)]++] = {link.N, static_cast<Index>(i), link.coefficient};
    entries_[next[as_size(link.N)]++] = {link.P, static_cast<Index>(i), link.coefficient};
  }
}

// The two-sided flux is c (d_N + grad_N.d_N - d_P - grad_P.d_P) plus the averaged normal gradients; what is beyond
// c (d_N - d_P) is deferred.
void DamageEquation::renew_correction(const CellField<double>& d) {
  parallel_for(mesh_.n_cells(), [&](Index c) { gradients_[as_size(c)] = gradient_.of(d.data(), c); });
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
    correction_[as_size(i)] = link.coefficient * beyond;
  });
}

double DamageEquation::local_slope(Index cell, double d, double psi) const {
  const double slope = density_[cell] * model_.crack->alpha_prime(d) +
                       (1.0 - model_.residual_stiffness) * model_.degradation->g_prime(d) * psi;
  const double source = source_.size() > 0 ? source_[cell] : 0.0;
  return mesh_.cell_volume[cell] * (slope - source);
}

double DamageEquation::local_curvature(Index cell, double d, double psi) const {
  return mesh_.cell_volume[cell] * (density_[cell] * model_.crack->alpha_second(d) +
                                    (1.0 - model_.residual_stiffness) * model_.degradation->g_second(d) * psi);
}

double DamageEquation::residual(Index cell, const CellField<double>& d, double psi) const {
  double sum = local_slope(cell, d[cell], psi) + pinned_[cell] * d[cell];
  for (std::size_t k = offsets_[as_size(cell)]; k < offsets_[as_size(cell) + 1]; ++k) {
    const Entry& entry = entries_[k];
    const double towards = cell < entry.column ? 1.0 : -1.0;  // P is the smaller of the two
    sum += entry.coefficient * (d[cell] - d[entry.column]) - towards * correction_[as_size(entry.link)];
  }
  return sum;
}

DamageSolution DamageEquation::solve(const CellField<double>& psi_plus, const CellField<double>& lower,
                                     Index corrections, CellField<double>& d) {
  constexpr Index most_changes = 50;  // of the active set
  const Index n = mesh_.n_cells();
  DamageSolution account;
  std::vector<double> r(as_size(n)), diagonal(as_size(n)), step(as_size(n));
  ActiveSet active(as_size(n), 0), before;
  for (Index correction = 0; correction < corrections; ++correction) {
    renew_correction(d);
    account.converged = false;
    parallel_for(n, [&](Index c) { active[as_size(c)] = is_damageable(c) ? 0 : 1; });
    for (Index change = 0; change < most_changes && !account.converged; ++change) {
      before = active;
      choose_active(psi_plus, lower, change == 0, d, active);
      parallel_for(n, [&](Index c) {
        double sum = pinned_[c] + local_curvature(c, d[c], psi_plus[c]);
        for (std::size_t k = offsets_[as_size(c)]; k < offsets_[as_size(c) + 1]; ++k) sum += entries_[k].coefficient;
        diagonal[as_size(c)] = sum;
        r[as_size(c)] = active[as_size(c)] != 0 ? 0.0 : -residual(c, d, psi_plus[c]);
        step[as_size(c)] = 0.0;
      });
      solve_linear(diagonal, active, r, step, account);
      parallel_for(n, [&](Index c) { d[c] += step[as_size(c)]; });
      ++account.active_set_iterations;
      const double moved = parallel_max(n, [&](Index c) { return std::abs(step[as_size(c)]); });
      account.converged = moved < 1e-6 && (active == before || change == 0);
    }
    parallel_for(n, [&](Index c) {
      if (is_damageable(c)) d[c] = std::clamp(d[c], lower[c], 1.0);
    });
  }
  return account;
}

// Cells beyond a bound are put on it; those on a bound are held there while the residual pushes against it.
void DamageEquation::choose_active(const CellField<double>& psi_plus, const CellField<double>& lower, bool first,
                                   CellField<double>& d, ActiveSet& active) const {
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (is_damageable(c)) d[c] = std::clamp(d[c], lower[c], 1.0);
  });
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (!is_damageable(c)) return;
    const bool at_lower = d[c] <= lower[c], at_upper = d[c] >= 1.0;
    if (!at_lower && !at_upper) {
      active[as_size(c)] = 0;
      return;
    }
    const double push = residual(c, d, psi_plus[c]);
    // What only its neighbours hold down may rise with them: else a profile would grow by a cell per change.
    const bool held = !first || local_slope(c, d[c], psi_plus[c]) > 0.0;
    active[as_size(c)] = (at_lower && push >= 0.0 && held) || (at_upper && push <= 0.0) ? 1 : 0;
  });
}

// Incomplete Cholesky with the pattern of the matrix and only its diagonal changed (Meijerink, van der Vorst 1977),
// within fixed blocks of rows.
void DamageEquation::factor(const std::vector<double>& diagonal, const ActiveSet& active) {
  pivots_ = diagonal;
  parallel_chunks(
      mesh_.n_cells(),
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i)
          for (std::size_t k = offsets_[as_size(i)]; k < offsets_[as_size(i) + 1]; ++k) {
            const Index j = entries_[k].column;
            if (j >= begin && j < i && active[as_size(j)] == 0 && active[as_size(i)] == 0)
              pivots_[as_size(i)] -= entries_[k].coefficient * entries_[k].coefficient / pivots_[as_size(j)];
          }
      },
      factor_block);
}

void DamageEquation::precondition(const ActiveSet& active, const std::vector<double>& r, std::vector<double>& z) const {
  parallel_chunks(
      mesh_.n_cells(),
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
          double sum = r[as_size(i)];
          for (std::size_t k = offsets_[as_size(i)]; k < offsets_[as_size(i) + 1]; ++k)
            if (const Index j = entries_[k].column; j >= begin && j < i) sum += entries_[k].coefficient * z[as_size(j)];
          z[as_size(i)] = active[as_size(i)] != 0 ? 0.0 : sum / pivots_[as_size(i)];
        }
        for (Index i = end - 1; i >= begin; --i) {
          double sum = 0.0;
          for (std::size_t k = offsets_[as_size(i)]; k < offsets_[as_size(i) + 1]; ++k)
            if (const Index j = entries_[k].column; j < end && j > i) sum += entries_[k].coefficient * z[as_size(j)];
          if (active[as_size(i)] == 0) z[as_size(i)] += sum / pivots_[as_size(i)];
        }
      },
      factor_block);
}

// Conjugate gradients on the inactive rows; the residual falls to a thousandth of its start, or to rounding.
void DamageEquation::solve_linear(const std::vector<double>& diagonal, const ActiveSet& active, std::vector<double>& r,
                                  std::vector<double>& x, DamageSolution& account) {
  constexpr Index most_iterations = 500;
  const Index n = mesh_.n_cells();
  const auto largest = [&] {
    return parallel_max(n, [&](Index i) { return std::abs(r[as_size(i)]) / diagonal[as_size(i)]; });
  };
  const double target = std::max(1e-11, 1e-4 * largest());
  if (largest() <= 1e-11) return;
  factor(diagonal, active);
  std::vector<double> z(as_size(n)), p(as_size(n), 0.0), q(as_size(n));
  double rho_before = 0.0;
  for (Index iteration = 0; iteration < most_iterations && largest() > target; ++iteration) {
    precondition(active, r, z);
    const double rho = parallel_sum(n, [&](Index i) { return r[as_size(i)] * z[as_size(i)]; });
    const double beta = iteration == 0 ? 0.0 : rho / rho_before;
    rho_before = rho;
    parallel_for(n, [&](Index i) { p[as_size(i)] = z[as_size(i)] + beta * p[as_size(i)]; });
    parallel_for(n, [&](Index i) {
      if (active[as_size(i)] != 0) return;
      double sum = diagonal[as_size(i)] * p[as_size(i)];
      for (std::size_t k = offsets_[as_size(i)]; k < offsets_[as_size(i) + 1]; ++k)
        sum -= entries_[k].coefficient * p[as_size(entries_[k].column)];
      q[as_size(i)] = sum;
    });
    const double alpha = rho / parallel_sum(n, [&](Index i) { return p[as_size(i)] * q[as_size(i)]; });
    parallel_for(n, [&](Index i) {
      x[as_size(i)] += alpha * p[as_size(i)];
      r[as_size(i)] -= alpha * q[as_size(i)];
    });
    ++account.krylov_iterations;
  }
}

double DamageEquation::fracture_energy(const CellField<double>& d) const {
  const double local = parallel_sum(mesh_.n_cells(), [&](Index c) {
    return mesh_.cell_volume[c] * density_[c] * model_.crack->alpha(d[c]) + 0.5 * pinned_[c] * d[c] * d[c];
  });
  const double gradient = parallel_sum(static_cast<Index>(links_.size()), [&](Index i) {
    const Link& link = links_[as_size(i)];
    const double jump = d[link.N] - d[link.P];
    return 0.5 * jump * (link.coefficient * jump + correction_[as_size(i)]);
  });
  return local + gradient;
}

}  // namespace pfdm
