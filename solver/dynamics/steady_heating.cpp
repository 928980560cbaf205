#include "solver/dynamics/steady_heating.h"

#include "physics/error.h"
#include "solver/scalar/free_diffusion.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace pfdm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Eigen::Index between_trials = 4;  // vectors

VectorXd as_vector(const CellField<double>& field) {
  return VectorXd::Map(&field[0], static_cast<Eigen::Index>(field.size()));
}

constexpr Index most_factored = 10000;  // cells

/// A step from a rise, without a source.
class Step {
 public:
  Step(const Mesh& mesh, const HeatedMaterial& material, std::vector<DiffusionBoundary> boundary, double dt)
      : field_(mesh.n_cells(), 0.0), dt_(dt) {
    constexpr double precision = 1e-11;
    const CellField<double> conductivity(mesh.n_cells(), material.conductivity),
        capacity(mesh.n_cells(), material.capacity);
    if (mesh.n_cells() <= most_factored) {
      factored_.emplace(mesh, conductivity, capacity, std::move(boundary), dt, precision);
      return;
    }
    for (DiffusionBoundary& on : boundary) on.value = 0.0;
    diffusion_.emplace(mesh, DiffusionProblem{.conductivity = conductivity,
                                              .capacity = capacity,
                                              .boundary = std::move(boundary),
                                              .precision = precision});
  }
  VectorXd operator()(const VectorXd& rise) {
    for (Index c = 0; c < field_.size(); ++c) field_[c] = rise[c];
    const bool converged = factored_ ? factored_->step(field_) : diffusion_->step(dt_, field_).converged;
    if (!converged) throw ComputationError("conduction of heat: a step did not converge");
    return as_vector(field_);
  }

 private:
  std::optional<FreeDiffusion> factored_;
  std::optional<Diffusion> diffusion_;  // of meshes whose factors would be large
  CellField<double> field_;
  double dt_;
};

/// Columns: coefficients of the rise after each step in the first m vectors, times the norm of the first step's rise.
MatrixXd coefficients(const MatrixXd& hessenberg, Eigen::Index m, double norm, int n) {
  MatrixXd all(m, n);
  VectorXd now = VectorXd::Zero(m);
  for (int step = 0; step < n; ++step) {
    now = hessenberg.topLeftCorner(m, m) * now;
    now[0] += norm;
    all.col(step) = now;
  }
  return all;
}

/// Takes the parts along the columns of V off a vector, twice, and returns them.
VectorXd make_orthogonal(const MatrixXd& V, VectorXd& to) {
  VectorXd parts = VectorXd::Zero(V.cols());
  for (int twice = 0; twice < 2; ++twice) {
    const VectorXd along = V.transpose() * to;
    to -= V * along;
    parts += along;
  }
  return parts;
}

}  // namespace

std::vector<SurfaceTemperature> surface_under_steady_source(const Mesh& mesh, const HeatedMaterial& material,
                                                            const std::vector<DiffusionBoundary>& boundary,
                                                            const CellField<double>& source, const std::string& patch,
                                                            double dt, int n, double precision) {
  HeatedBody body(mesh, material, boundary);
  body.set_source(source);
  body.step(dt);
  const VectorXd first = as_vector(body.rise());
  const double norm = first.norm();
  std::vector<SurfaceTemperature> surface(n);
  Step step(mesh, material, boundary, dt);
  const auto most = static_cast<Eigen::Index>(n);
  MatrixXd V(first.size(), 0), H = MatrixXd::Zero(most + 1, most), weights;
  if (!(norm > 0.0)) {
    std::ranges::fill(surface, body.surface(patch));
    return surface;
  }
  V.conservativeResize(Eigen::NoChange, 1);
  V.col(0) = first / norm;
  for (Eigen::Index m = 1;; ++m) {
    VectorXd next = step(V.col(m - 1));
    H.col(m - 1).head(m) = make_orthogonal(V, next);
    const double rest = next.norm();
    H(m, m - 1) = rest;
    const bool ends = m == most || !(rest > 1e-14);
    if (ends || m % between_trials == 0) {
      weights = coefficients(H, m, norm, n);
      // What the space lacks after each step, kept from then on at most.
      const double lacks = rest * weights.row(m - 1).cwiseAbs().sum();
      if (ends || lacks <= precision * weights.colwise().norm().maxCoeff()) break;
    }
    V.conservativeResize(Eigen::NoChange, m + 1);
    V.col(m) = next / rest;
  }
  CellField<double> rise(mesh.n_cells(), 0.0);
  for (Eigen::Index k = 0; k < weights.cols(); ++k) {
    const VectorXd there = V.leftCols(weights.rows()) * weights.col(k);
    for (Index c = 0; c < rise.size(); ++c) rise[c] = there[c];
    surface[k] = body.surface(patch, rise);
  }
  return surface;
}

}  // namespace pfdm
