#include "postproc/cohesive/face_columns.h"

#include <algorithm>

namespace pfdm {
namespace {

constexpr double flat = 0.999;  // part of the faces' areas that their sum as vectors comes to on a plane

/// Area of a face along the normal that leaves the first side of the interface.
Vector area_from_first_side(const Mesh& mesh, const CohesiveSurface& surface, std::size_t k) {
  return (surface.sign.empty() ? 1.0 : surface.sign[k]) * mesh.face_area[surface.faces[k]];
}

struct Shape {
  bool is_flat;
  double outwards;  // 1 where the first side is inside, else -1
};

Shape shape_of(const Mesh& mesh, const CohesiveSurface& surface) {
  double whole = 0.0, volume = 0.0;
  Vector sum = Vector::Zero(), centre = Vector::Zero();
  for (std::size_t k = 0; k < surface.faces.size(); ++k) {
    const Vector S = area_from_first_side(mesh, surface, k);
    whole += S.norm();
    sum += S;
    centre += S.norm() * mesh.face_centre[surface.faces[k]];
  }
  centre /= whole;
  for (std::size_t k = 0; k < surface.faces.size(); ++k)
    volume += area_from_first_side(mesh, surface, k).dot(mesh.face_centre[surface.faces[k]] - centre);
  return {.is_flat = sum.norm() > flat * whole, .outwards = volume < 0.0 ? -1.0 : 1.0};
}

}  // namespace

ColumnSet face_columns(const Mesh& mesh, const CohesiveSurface& surface, const Vector& axis) {
  const Shape shape = shape_of(mesh, surface);
  ColumnSet set{.name = surface.name,
                .kind = shape.is_flat ? SurfaceKind::plane : SurfaceKind::interface,
                .columns = {},
                .is_cohesive = true};
  for (std::size_t k = 0; k < surface.faces.size(); ++k) {
    const Vector S = area_from_first_side(mesh, surface, k);
    Column column{.point = mesh.face_centre[surface.faces[k]],
                  .normal = (shape.is_flat ? 1.0 : shape.outwards) * S.normalized(),
                  .area = S.norm()};
    column.tangents = surface_tangents(column.normal, axis);
    set.columns.push_back(std::move(column));
  }
  return set;
}

std::vector<ColumnSample> sample_faces(const Mesh& mesh, const FractureModel& model, const OutputFields& output,
                                       const ColumnSet& set) {
  const CohesiveSurface& surface = *std::ranges::find(model.interfaces, set.name, &CohesiveSurface::name);
  const OutputInterface& now = *std::ranges::find(output.interfaces, set.name, &OutputInterface::name);
  std::vector<ColumnSample> samples(set.columns.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Column& place = set.columns[k];
    const auto i = static_cast<Index>(k);
    // Of the second side from the first; seen from the other one both are reversed.
    const double side = place.normal.dot(area_from_first_side(mesh, surface, k)) > 0.0 ? 1.0 : -1.0;
    const auto components = [&](const Vector& v) -> Vector {
      return side * Vector(v.dot(place.normal), v.dot(place.tangents[0]), v.dot(place.tangents[1]));
    };
    samples[k] = {.traction = components(now.traction[i]),
                  .separation = components(now.separation[i]),
                  .surface_energy = now.dissipated[i],
                  .largest_damage = now.damage[i]};
  }
  return samples;
}

}  // namespace pfdm
