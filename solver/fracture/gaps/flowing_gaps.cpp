#include "solver/fracture/gaps/flowing_gaps.h"

#include "solver/momentum/body/momentum_faces.h"
#include "solver/momentum/body/unknowns.h"

#include <algorithm>

namespace pfdm {
namespace {

// Places among a cell's numbers: energies; both volume changes, each with its elastic part. The faces follow, each with
// its gap, the elastic part of that, its gap along the normal as bulk moduli bear it, and the elastic part of that.
namespace places {
constexpr std::size_t heat = 0, locked = 1, volumes = 2, faces = 6, along = 6, per_face = 8;
}

using PlacedVector = Eigen::Map<const Vector>;

/// Half the work of the stiffness on the elastic part of a gap, less half of that on the gap; and heat by the
/// trapezoid.
struct GapEnergies {
  double locked = 0.0, heat = 0.0;
  template <class Value, class Dot>
  void add(const Value& r, const Value& z, const Value& r_n, const Value& z_n, const Dot& dot) {
    locked += 0.5 * dot(r, Value(r - z));
    heat += std::max(0.0, 0.5 * dot(Value(r + r_n), Value(z - z_n - r + r_n)));
  }
};

}  // namespace

FlowingGaps::FlowingGaps(const Mesh& mesh, const CellField<const Material*>& materials, const FractureModel& model)
    : mesh_(mesh), model_(model), material_(materials) {
  for (Index c = 0; c < material_.size(); ++c) {
    if (material_[c] != nullptr && !(material_[c]->flows() && can_flow(mesh.shape[c]))) material_[c] = nullptr;
    any_ = any_ || material_[c] != nullptr;
  }
  FlowingGaps::start_step(0.0, {});
}

std::size_t FlowingGaps::size(Index cell) const {
  return places::faces + places::per_face * mesh_.faces_of_cell(cell).size();
}

void FlowingGaps::start_step(double, const CellField<double>&) {
  left_ = CellField<double>(any_ ? material_.size() : 0, 1.0);
}

// In plane stress the modulus along a face's normal is linear in mu at one Poisson's ratio alone.
bool FlowingGaps::keeps_ratio(Index cell) const {
  return model_.is_plane_stress() ||
         (mesh_.shape[cell] == CellShape::hexahedron && !is_nearly_incompressible(material_[cell]->elasticity()));
}

IsotropicElasticity FlowingGaps::elasticity(Index cell) const {
  const IsotropicElasticity& at_once = material_[cell]->elasticity();
  const double mu = left_[cell] * at_once.mu;
  if (keeps_ratio(cell)) return {.lambda = left_[cell] * at_once.lambda, .mu = mu};
  return {.lambda = at_once.bulk_modulus() - 2.0 * mu / 3.0, .mu = mu};
}

void FlowingGaps::tell(Index cell, std::span<const double> numbers, HistoryStress& history) const {
  const double mu = material_[cell]->elasticity().mu, K = bulk_modulus(cell), left = left_[cell];
  history.sound[cell] = elasticity(cell);
  history.relaxes[cell] = 1;
  const auto remainder = [&](std::size_t at) { return numbers[at + 1] - left * numbers[at]; };
  history.volumes[cell] = {.by_gradient = mu * remainder(places::volumes),
                           .by_flux = mu * remainder(places::volumes + 2)};
  const std::size_t first = mesh_.cell_face_offsets[cell];
  for (std::size_t k = 0; k < mesh_.faces_of_cell(cell).size(); ++k) {
    const std::size_t at = places::faces + k * places::per_face;
    const PlacedVector z(numbers.data() + at), r(numbers.data() + at + 3);
    history.gaps[first + k] = {.shear = mu * (r - left * z), .bulk = K * remainder(at + places::along)};
  }
}

void FlowingGaps::advance(Index cell, double left, const CellMechanics& now, std::span<const double> from,
                          std::span<double> to) {
  left_[cell] = left;
  const auto follow = [&](std::size_t at, double change) {
    to[at] = change;
    to[at + 1] = left * (from[at + 1] + change - from[at]);
  };
  follow(places::volumes, now.volume_changes[cell].by_gradient);
  follow(places::volumes + 2, now.volume_changes[cell].by_flux);
  const double mu = material_[cell]->elasticity().mu, K = bulk_modulus(cell);
  GapEnergies energies;
  const auto faces = mesh_.faces_of_cell(cell);
  const std::size_t first = mesh_.cell_face_offsets[cell];
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const FaceGap& gap = now.gaps[first + k];
    const std::size_t at = places::faces + k * places::per_face, along = at + places::along;
    const Vector n = mesh_.face_area[faces[k]].normalized(), z = gap.strain;
    const Vector z_n = PlacedVector(from.data() + at), r_n = PlacedVector(from.data() + at + 3),
                 r = left * (r_n + z - z_n);
    Eigen::Map<Vector>(to.data() + at) = z;
    Eigen::Map<Vector>(to.data() + at + 3) = r;
    follow(along, gap.along);
    energies.add(r, z, r_n, z_n, [&](const Vector& a, const Vector& b) {
      return mu * gap.volume * a.dot(momentum_faces::scale(gap.by_shear, 1.0, n, b));
    });
    energies.add(to[along + 1], to[along], from[along + 1], from[along],
                 [&](double a, double b) { return K * gap.by_bulk * gap.volume * a * b; });
  }
  to[places::locked] = energies.locked / mesh_.cell_volume[cell];
  to[places::heat] = from[places::heat] + energies.heat / mesh_.cell_volume[cell];
}

}  // namespace pfdm
