#include "solver/momentum/body/pressed_faces.h"

#include "solver/parallel.h"

namespace pfdm {
namespace {

bool is_a_mirror(const BoundaryCondition& condition) {
  return condition.kind == BoundaryCondition::Kind::symmetry || is_front_or_back(condition);
}

}  // namespace

PressedFaces::PressedFaces(const Mesh& mesh, const Unknowns& unknowns) : mesh_(&mesh), unknowns_(&unknowns) {
  std::vector<Index> number_of_point(mesh.points.size(), -1);
  for (std::size_t k = 0; k < unknowns.conditions.size(); ++k) {
    if (!unknowns.conditions[k].condition.pressure) continue;
    const Patch& patch = mesh.patches[unknowns.conditions[k].patch];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) add_face(k, f, number_of_point);
  }
  if (!faces_.empty()) hold_points(number_of_point);
}

void PressedFaces::add_face(std::size_t condition, Index face, std::vector<Index>& number_of_point) {
  Face at{.condition = condition, .face = face, .node = unknowns_->node_of_face[face], .area = mesh_->face_area[face]};
  for (const Index p : mesh_->points_of_face(face)) {
    Index& number = number_of_point[p];
    if (number < 0) {
      number = count_of(points_);
      points_.push_back({.point = p});
    }
    points_[number].corners.push_back(
        {.cell = mesh_->owner[face], .node = at.node, .d = mesh_->points[p] - mesh_->face_centre[face]});
    at.points.push_back(number);
  }
  faces_.push_back(std::move(at));
}

void PressedFaces::hold_points(const std::vector<Index>& number_of_point) {
  for (const PatchCondition& on : unknowns_->conditions) {
    if (!is_a_mirror(on.condition)) continue;
    const Patch& patch = mesh_->patches[on.patch];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      for (const Index p : mesh_->points_of_face(f)) {
        if (number_of_point[p] < 0) continue;
        Tensor& free = points_[number_of_point[p]].free;
        const Vector n = free * mesh_->face_area[f].normalized();
        constexpr double sine = 1e-3;  // below it the plane is one that it is held in already
        if (n.norm() > sine) free -= n * n.transpose() / n.squaredNorm();
      }
  }
}

void PressedFaces::add_forces(double t, std::vector<Vector>& load) const {
  for (const Face& at : faces_) load[at.node] -= free_part(at, pressure_on(at, t) * at.area);
}

void PressedFaces::weigh(Point& point, const CellField<double>& g) const {
  double sum = 0.0;
  for (Corner& corner : point.corners) sum += corner.weight = g[corner.cell] / corner.d.norm();
  for (Corner& corner : point.corners) corner.weight /= sum;
}

Vector PressedFaces::move(const Point& point, const std::vector<Vector>& u, const CellField<Tensor>& gradients) {
  Vector sum = Vector::Zero();
  for (const Corner& corner : point.corners)
    sum += corner.weight * (u[corner.node] + gradients[corner.cell] * corner.d);
  return point.free * sum;
}

std::vector<Vector> PressedFaces::moves(const std::vector<Vector>& u, const CellField<Tensor>& gradients) const {
  std::vector<Vector> moves(points_.size());
  parallel_for(count_of(points_), [&](Index i) { moves[i] = move(points_[i], u, gradients); });
  return moves;
}

// Change of the pressure's force by that of the area 1/2 sum x_i x x_(i+1).
Vector PressedFaces::turn(const Face& at, const std::vector<Vector>& moves) const {
  Vector change = Vector::Zero();
  for (std::size_t k = 0; k < at.points.size(); ++k) {
    const std::size_t i = at.points[k], next = at.points[(k + 1) % at.points.size()];
    change += 0.5 * (moves[i].cross(points_[next].place) + points_[i].place.cross(moves[next]));
  }
  return free_part(at, at.pressure * change);
}

void PressedFaces::linearise(double t, const std::vector<Vector>& u, const CellField<Tensor>& gradients,
                             const CellField<double>& g) {
  follows_ = true;
  for (Point& point : points_) weigh(point, g);
  const std::vector<Vector> moved = moves(u, gradients);
  for (std::size_t i = 0; i < points_.size(); ++i) points_[i].place = mesh_->points[points_[i].point] + moved[i];
  for (Face& at : faces_) {
    at.pressure = pressure_on(at, t);
    at.initial_turn = turn(at, moved);
    at.area.setZero();
    for (std::size_t k = 0; k < at.points.size(); ++k)
      at.area += 0.5 * points_[at.points[k]].place.cross(points_[at.points[(k + 1) % at.points.size()]].place);
  }
}

void PressedFaces::add_turn(const std::vector<Vector>& u, const CellField<Tensor>& gradients,
                            std::vector<Vector>& out) const {
  if (faces_.empty() || !follows_) return;
  const std::vector<Vector> moved = moves(u, gradients);
  parallel_for(count_of(faces_), [&](Index i) {
    const Face& at = faces_[i];
    out[at.node] += turn(at, moved);
  });
}

void PressedFaces::add_initial_turn(std::vector<Vector>& load) const {
  for (const Face& at : faces_) load[at.node] += at.initial_turn;
}

}  // namespace pfdm
