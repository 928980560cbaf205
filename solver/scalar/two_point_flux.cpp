#include "solver/scalar/two_point_flux.h"

#include "solver/parallel.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pfdm {
namespace {

constexpr double orthogonal = 1e-3;    // deviation of unit vectors
constexpr double smooth_ratio = 1.25;  // of the conductances of neighbours, below which they vary; above they jump

Vector unit_normal(const Mesh& mesh, Index face) { return mesh.face_area[face] / mesh.face_area[face].norm(); }

// Whether u has no kink between two cells: equal conductances, or of a region's own cells nearly equal ones.
bool is_smooth(const Mesh& mesh, const CellField<double>& conductance, Index a, Index b) {
  const auto [least, most] = std::minmax(conductance[a], conductance[b]);
  return most == least || (mesh.region[a] == mesh.region[b] && most < smooth_ratio * least);
}

// Cells that may enter each other's gradient of u: those connected by faces without a kink.
CellField<Index> smooth_zones(const Mesh& mesh, const CellField<double>& conductance) {
  CellField<Index> zone(mesh.n_cells(), -1);
  std::vector<Index> front;
  for (Index first = 0; first < mesh.n_cells(); ++first) {
    if (zone[first] >= 0) continue;
    zone[first] = first;
    front.assign(1, first);
    while (!front.empty()) {
      const Index c = front.back();
      front.pop_back();
      for (const Index f : mesh.faces_of_cell(c)) {
        if (!mesh.is_interior(f)) continue;
        const Index other = mesh.across(f, c);
        if (zone[other] >= 0 || !is_smooth(mesh, conductance, c, other)) continue;
        zone[other] = first;
        front.push_back(other);
      }
    }
  }
  return zone;
}

// The normal of a flat mesh one cell thick: all centres lie in a plane, and faces are along it or across. Gradients
// along it are not to be had from the cells, and those within it are. Zero of other meshes, those of cones among them.
Vector normal_of_flat_layer(const Mesh& mesh) {
  constexpr double flat = 1e-16;  // of the second moments
  Vector middle = Vector::Zero();
  for (Index c = 0; c < mesh.n_cells(); ++c) middle += mesh.cell_centre[c];
  middle /= static_cast<double>(std::max<Index>(mesh.n_cells(), 1));
  Tensor moment = Tensor::Zero();
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const Vector d = mesh.cell_centre[c] - middle;
    moment += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Tensor> modes(moment);
  const Vector& size = modes.eigenvalues();
  if (!(size[0] <= flat * size[2]) || size[1] <= flat * size[2]) return Vector::Zero();
  const Vector normal = modes.eigenvectors().col(0);
  constexpr double straight = 1e-6;
  for (Index f = 0; f < mesh.n_faces(); ++f)
    if (const double along = std::abs(unit_normal(mesh, f).dot(normal)); along > straight && along < 1.0 - straight)
      return Vector::Zero();
  return normal;
}

SymmetricCoupling coupling_of(const Mesh& mesh, const std::vector<TwoPointFlux::Link>& links) {
  std::vector<SymmetricCoupling::Pair> pairs;
  pairs.reserve(links.size());
  for (const TwoPointFlux::Link& link : links) pairs.push_back({link.P, link.N, link.coefficient});
  return {mesh.n_cells(), pairs};
}

}  // namespace

TwoPointFlux::TwoPointFlux(const Mesh& mesh, Medium medium)
    : mesh_(mesh),
      medium_(std::move(medium)),
      exchanged_(mesh.n_cells(), 0.0),
      coupling_((build_links(), coupling_of(mesh, links_))),
      gradient_(build_gradient()),
      gradients_(mesh.n_cells(), Vector::Zero()),
      range_(mesh.n_cells(), std::numeric_limits<double>::infinity()),
      correction_(links_.size(), 0.0),
      exchange_correction_(medium_.exchanges.size(), 0.0),
      deferred_(mesh.n_cells(), 0.0) {
  build_exchanges();
}

Vector TwoPointFlux::point_of(Index cell) const {
  return medium_.shift.size() > 0 ? mesh_.cell_centre[cell] + medium_.shift[cell] : mesh_.cell_centre[cell];
}

// The part of a point-to-face vector that lies in the face: it is not in the two-point flux.
Vector TwoPointFlux::within_face(Index face, Index cell, const Vector& normal) const {
  const Vector d = mesh_.face_centre[face] - point_of(cell);
  return d - d.dot(normal) * normal;
}

bool TwoPointFlux::is_cut(Index face) const {
  return (medium_.cut.size() > 0 && medium_.cut[face] != 0) || std::isinf(resistance_of(face));
}

double TwoPointFlux::link_coefficient(Index face) const {
  const Index P = mesh_.owner[face], N = mesh_.neighbour[face];
  const double area = mesh_.face_area[face].norm();
  const Vector n = mesh_.face_area[face] / area;
  const double h_P = std::abs((mesh_.face_centre[face] - point_of(P)).dot(n));
  const double h_N = std::abs((mesh_.face_centre[face] - point_of(N)).dot(n));
  return area / (h_P / conductance(P) + h_N / conductance(N) + resistance_of(face));
}

void TwoPointFlux::scale(CellField<double> factor) {
  factor_ = std::move(factor);
  for (Link& link : links_) link.coefficient = link_coefficient(link.face);
  coupling_ = coupling_of(mesh_, links_);
  exchange_coefficient_.clear();
  std::fill(exchanged_.begin(), exchanged_.end(), 0.0);
  std::fill(deferred_.begin(), deferred_.end(), 0.0);
  build_exchanges();
}

void TwoPointFlux::build_links() {
  for (Exchange& exchange : medium_.exchanges) exchange.corrected = exchange.corrected && is_oblique(exchange);
  const CellField<double>& k = medium_.conductance;
  for (Index f = 0; f < mesh_.n_interior_faces(); ++f) {
    const Index P = mesh_.owner[f], N = mesh_.neighbour[f];
    if (!(k[P] > 0.0 && k[N] > 0.0) || is_cut(f)) continue;
    const Vector centre_line = (point_of(N) - point_of(P)).normalized();
    links_.push_back({.face = f,
                      .P = P,
                      .N = N,
                      .coefficient = link_coefficient(f),
                      .corrected = (centre_line - unit_normal(mesh_, f)).norm() > orthogonal});
  }
}

bool TwoPointFlux::is_oblique(const Exchange& exchange) const {
  const Vector d = mesh_.face_centre[exchange.face] - point_of(exchange.cell);
  const Vector n = unit_normal(mesh_, exchange.face);
  return (d - d.dot(n) * n).norm() > orthogonal * d.norm();
}

void TwoPointFlux::build_exchanges() {
  for (const Exchange& exchange : medium_.exchanges) {
    const Index c = exchange.cell;
    const Vector n = unit_normal(mesh_, exchange.face);
    const double h = std::abs((mesh_.face_centre[exchange.face] - point_of(c)).dot(n));
    const double resistance = h / conductance(c) + 1.0 / exchange.coefficient;
    const double coefficient = mesh_.face_area[exchange.face].norm() / resistance;
    exchange_coefficient_.push_back(coefficient);
    exchanged_[c] += coefficient;
    deferred_[c] += coefficient * exchange.value;
  }
}

// Across them cells do not enter each other's gradient.
FaceField<char> TwoPointFlux::kinks() const {
  if (medium_.resistance.size() == 0) return medium_.cut;
  FaceField<char> kinks(mesh_.n_faces(), 0);
  for (Index f = 0; f < mesh_.n_interior_faces(); ++f) kinks[f] = is_cut(f) || resistance_of(f) > 0.0 ? 1 : 0;
  return kinks;
}

Gradient TwoPointFlux::build_gradient() const {
  std::vector<char> wanted(mesh_.n_cells(), 0);
  for (const Link& link : links_)
    if (link.corrected) wanted[link.P] = wanted[link.N] = 1;
  for (const Exchange& exchange : medium_.exchanges)
    if (exchange.corrected) wanted[exchange.cell] = 1;
  return Gradient(mesh_, {.zone = smooth_zones(mesh_, medium_.conductance),
                          .node_of_face = {},
                          .cut = kinks(),
                          .shift = medium_.shift,
                          .plane_normal = medium_.plane_normal != Vector::Zero() ? medium_.plane_normal
                                                                                 : normal_of_flat_layer(mesh_),
                          .wanted = std::move(wanted),
                          .zero_if_deficient = true});
}

// The two-sided flux is c (u_N + grad_N.d_N - u_P - grad_P.d_P) plus the averaged normal gradients; what is beyond
// c (u_N - u_P) is deferred. Where it is limited it never moves either side by more than u ranges over around it: at
// the corner of a front the gradients overshoot, and an active set would not converge.
void TwoPointFlux::renew_correction(const CellField<double>& u) {
  parallel_for(mesh_.n_cells(), [&](Index c) {
    gradients_[c] = gradient_.of(u.data(), c);
    if (!medium_.limited) return;
    double least = u[c], most = u[c];
    for (const std::int32_t neighbour : coupling_.columns(c)) {
      least = std::min(least, u[neighbour]);
      most = std::max(most, u[neighbour]);
    }
    range_[c] = most - least;
  });
  parallel_for(count_of(links_), [&](Index i) {
    const Link& link = links_[i];
    if (!link.corrected) return;
    const Vector n = unit_normal(mesh_, link.face);
    const double beyond = gradients_[link.N].dot(within_face(link.face, link.N, n)) -
                          gradients_[link.P].dot(within_face(link.face, link.P, n));
    const double most = std::min(range_[link.P], range_[link.N]);
    correction_[i] = link.coefficient * std::clamp(beyond, -most, most);
  });
  std::fill(deferred_.begin(), deferred_.end(), 0.0);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    deferred_[links_[i].P] += correction_[i];
    deferred_[links_[i].N] -= correction_[i];
  }
  for (std::size_t k = 0; k < medium_.exchanges.size(); ++k) {
    const Exchange& exchange = medium_.exchanges[k];
    const Index c = exchange.cell;
    if (exchange.corrected) {
      const Vector across = within_face(exchange.face, c, unit_normal(mesh_, exchange.face));
      const double most = range_[c];
      exchange_correction_[k] = -exchange_coefficient_[k] * std::clamp(gradients_[c].dot(across), -most, most);
    }
    deferred_[c] += exchange_coefficient_[k] * exchange.value + exchange_correction_[k];
  }
}

double TwoPointFlux::energy(Index i, const CellField<double>& u) const {
  const Link& link = links_[i];
  const double jump = u[link.N] - u[link.P];
  return 0.5 * jump * (link.coefficient * jump + correction_[i]);
}

double TwoPointFlux::exchange_flux(std::size_t k, const CellField<double>& u) const {
  const Exchange& exchange = medium_.exchanges[k];
  return exchange_coefficient_[k] * (u[exchange.cell] - exchange.value) - exchange_correction_[k];
}

}  // namespace pfdm
