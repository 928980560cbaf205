#include "solver/fracture/gaps/relaxing_gaps.h"

#include "solver/fracture/model/relaxing_volume.h"
#include "solver/momentum/body/momentum_faces.h"
#include "solver/parallel.h"

#include <algorithm>
#include <array>
#include <map>

namespace pfdm {
namespace {

// Places among a cell's numbers; with a pressure the two volume changes, and what is left of both in each shear branch.
// The faces follow, each with its gap and what is left of it in the shear branches, and with bulk branches that along
// its normal and what is left of it in these.
constexpr std::size_t heat = 0, locked_energy = 1, branch_energy = 2, volumes_from = 3, branches_from = 5;

struct Energy {
  double locked = 0.0, stored = 0.0, heat = 0.0;  // [Pa]
};

// Energies of a branch whose spring had r_n and has r while the gap went from z_n to z.
template <class Value, class Dot>
Energy energy_of(const PronyBranch& branch, const PronyDecay& by, const Value& r_n, const Value& r, const Value& z_n,
                 const Value& z, const Dot& dot) {
  const Value dz = z - z_n;
  const double gained = 2.0 * dot(dz, Value(by.phi * r_n + by.second * dz)) - dot(r, r) + dot(r_n, r_n);
  return {.locked = 0.5 * branch.modulus * dot(r, Value(r - z)),
          .stored = 0.5 * branch.modulus * dot(r, r),
          .heat = 0.5 * branch.modulus * std::max(gained, 0.0)};
}

Eigen::Map<const Vector> vector_at(std::span<const double> numbers, std::size_t at) {
  return Eigen::Map<const Vector>(numbers.data() + at);
}

void advance_volumes(const std::vector<PronyDecay>& shear, const VolumeChanges& now, std::span<const double> from,
                     std::span<double> to) {
  const std::array<double, 2> changes{now.by_gradient, now.by_flux};
  for (std::size_t j = 0; j < changes.size(); ++j) {
    to[volumes_from + j] = changes[j];
    for (std::size_t i = 0; i < shear.size(); ++i) {
      const std::size_t at = branches_from + 2 * i + j;
      to[at] = shear[i].after(from[at], changes[j] - from[volumes_from + j]);
    }
  }
}

}  // namespace

RelaxingGaps::RelaxingGaps(const Mesh& mesh, const CellField<const Material*>& materials, const FractureModel& model)
    : mesh_(mesh) {
  if (materials.size() == 0) return;
  kind_ = CellField<Index>(materials.size(), -1);
  std::map<const Material*, Index> kind_of;
  for (Index c = 0; c < materials.size(); ++c) {
    const Material* material = materials[c];
    const auto [at, is_new] = kind_of.try_emplace(material, -1);
    if (is_new && material != nullptr && material->relaxing() != nullptr) {
      at->second = count_of(kinds_);
      const bool has_pressure = relaxes_with_pressure(*material) && !model.is_plane_stress();
      kinds_.push_back({.law = material->relaxing(),
                        .has_pressure = has_pressure,
                        .keeps_ratio = model.is_plane_stress() && !material->is_finite_strain()});
    }
    kind_[c] = at->second;
  }
  RelaxingGaps::start_step(0.0, {});
}

RelaxingGaps::Moment RelaxingGaps::moment_of(const Kind& kind, double duration) {
  const PronyLaw& law = *kind.law;
  Moment moment{.elasticity = elasticity_over(law, duration)};
  if (kind.keeps_ratio) {
    const IsotropicElasticity at_once = instantaneous_elasticity(law);
    moment.elasticity.lambda = at_once.lambda * moment.elasticity.mu / at_once.mu;
  }
  for (const PronyBranch& branch : law.shear) moment.shear.push_back(decay_over(duration / branch.time));
  for (const PronyBranch& branch : law.bulk) moment.bulk.push_back(decay_over(duration / branch.time));
  return moment;
}

void RelaxingGaps::start_step(double duration, const CellField<double>& shift) {
  is_shifted_ = any() && shift.size() > 0;
  moments_.resize(is_shifted_ ? as_size(kind_.size()) : kinds_.size());
  if (is_shifted_)
    parallel_for(kind_.size(), [&](Index c) {
      if (has(c)) moments_[c] = moment_of(kind(c), duration / shift[c]);
    });
  else
    std::ranges::transform(kinds_, moments_.begin(), [&](const Kind& by) { return moment_of(by, duration); });
}

std::size_t RelaxingGaps::size(Index cell) const {
  const Kind& by = kind(cell);
  return by.per_cell() + mesh_.faces_of_cell(cell).size() * by.per_face();
}

void RelaxingGaps::tell(Index cell, std::span<const double> numbers, At when, HistoryStress& history) const {
  const auto remainder = [when](const PronyDecay& of, const auto& spring, const auto& strain) {
    return when == At::end ? of.remainder(spring, strain) : of.remainder_after(spring, strain);
  };
  const Kind& by = kind(cell);
  const Moment& in_step = moment(cell);
  const std::size_t n_shear = by.law->shear.size(), n_bulk = by.law->bulk.size();
  history.sound[cell] = in_step.elasticity;
  history.relaxes[cell] = 1;
  for (std::size_t i = 0; by.has_pressure && i < n_shear; ++i) {
    const double modulus = by.law->shear[i].modulus;
    const std::span<const double> springs = numbers.subspan(branches_from + 2 * i, 2);
    history.volumes[cell].by_gradient += modulus * remainder(in_step.shear[i], springs[0], numbers[volumes_from]);
    history.volumes[cell].by_flux += modulus * remainder(in_step.shear[i], springs[1], numbers[volumes_from + 1]);
  }
  const auto faces = mesh_.faces_of_cell(cell);
  const std::size_t first = mesh_.cell_face_offsets[cell];
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const std::size_t at = by.per_cell() + k * by.per_face();
    const Vector z = vector_at(numbers, at);
    GapStress& left = history.gaps[first + k];
    for (std::size_t i = 0; i < n_shear; ++i)
      left.shear +=
          by.law->shear[i].modulus * remainder(in_step.shear[i], Vector(vector_at(numbers, at + 3 + 3 * i)), z);
    const std::size_t along = at + by.bulk_from();
    for (std::size_t j = 0; j < n_bulk; ++j)
      left.bulk += by.law->bulk[j].modulus * remainder(in_step.bulk[j], numbers[along + 1 + j], numbers[along]);
  }
}

double RelaxingGaps::in_branches(std::span<const double> numbers) const { return numbers[branch_energy]; }

void RelaxingGaps::hold(Index cell, std::span<double> numbers) const {
  const Kind& by = kind(cell);
  const std::vector<PronyDecay>&shear = moment(cell).shear, &bulk = moment(cell).bulk;
  const auto fade = [&](const PronyDecay& of, std::size_t at, std::size_t n) {
    for (double& spring : numbers.subspan(at, n)) spring *= of.left;
  };
  for (std::size_t i = 0; by.has_pressure && i < shear.size(); ++i) fade(shear[i], branches_from + 2 * i, 2);
  for (std::size_t k = 0; k < mesh_.faces_of_cell(cell).size(); ++k) {
    const std::size_t at = by.per_cell() + k * by.per_face();
    for (std::size_t i = 0; i < shear.size(); ++i) fade(shear[i], at + 3 + 3 * i, 3);
    for (std::size_t j = 0; j < bulk.size(); ++j) fade(bulk[j], at + by.bulk_from() + 1 + j, 1);
  }
}

void RelaxingGaps::advance(Index cell, const VolumeChanges& changes, const std::vector<FaceGap>& gaps,
                           std::span<const double> from, std::span<double> to) const {
  const Kind& by = kind(cell);
  const std::vector<PronyDecay>&shear = moment(cell).shear, &bulk = moment(cell).bulk;
  const std::size_t n_shear = by.law->shear.size(), n_bulk = by.law->bulk.size();
  if (by.has_pressure) advance_volumes(shear, changes, from, to);
  Energy sum;
  const auto add = [&](const Energy& of, double volume) {
    sum.locked += of.locked * volume;
    sum.stored += of.stored * volume;
    sum.heat += of.heat * volume;
  };
  const auto faces = mesh_.faces_of_cell(cell);
  const std::size_t first = mesh_.cell_face_offsets[cell];
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const FaceGap& gap = gaps[first + k];
    const std::size_t at = by.per_cell() + k * by.per_face();
    const Vector n = mesh_.face_area[faces[k]].normalized(), z_n = vector_at(from, at), z = gap.strain;
    const auto dot = [&](const Vector& a, const Vector& b) {
      return a.dot(momentum_faces::scale(gap.by_shear, 1.0, n, b));
    };
    Eigen::Map<Vector>(to.data() + at) = z;
    for (std::size_t i = 0; i < n_shear; ++i) {
      const Vector r_n = vector_at(from, at + 3 + 3 * i), r = shear[i].after(r_n, Vector(z - z_n));
      Eigen::Map<Vector>(to.data() + at + 3 + 3 * i) = r;
      add(energy_of(by.law->shear[i], shear[i], r_n, r, z_n, z, dot), gap.volume);
    }
    const std::size_t along = at + by.bulk_from();
    const double a = gap.along;
    if (n_bulk > 0) to[along] = a;
    for (std::size_t j = 0; j < n_bulk; ++j) {
      const double r_n = from[along + 1 + j], a_n = from[along];
      const double r = to[along + 1 + j] = bulk[j].after(r_n, a - a_n);
      add(energy_of(by.law->bulk[j], bulk[j], r_n, r, a_n, a, [](double x, double y) { return x * y; }),
          gap.by_bulk * gap.volume);
    }
  }
  to[locked_energy] = sum.locked / mesh_.cell_volume[cell];
  to[branch_energy] = sum.stored / mesh_.cell_volume[cell];
  to[heat] = from[heat] + sum.heat / mesh_.cell_volume[cell];
}

}  // namespace pfdm
