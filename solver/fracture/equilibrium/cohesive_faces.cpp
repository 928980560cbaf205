#include "solver/fracture/equilibrium/cohesive_faces.h"

#include "physics/error.h"
#include "physics/quantity_text.h"
#include "solver/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace pfdm {
namespace {

constexpr double rigid_stiffness = 1e3;  // over that of the cells beside the face

}  // namespace

CohesiveFaces::CohesiveFaces(const Mesh& mesh, const FractureModel& model, const Unknowns& unknowns)
    : mesh_(mesh), model_(model), normals_(make_face_normals(model)) {
  if (unknowns.split_faces.empty()) return;
  std::set<Index> seen;
  for (std::size_t s = 0; s < model.interfaces.size(); ++s)
    for (std::size_t k = 0; k < model.interfaces[s].faces.size(); ++k) {
      const Index f = model.interfaces[s].faces[k];
      if (!seen.insert(f).second)
        throw InputError(fmt::format(
            "interface \"{}\": a face at ({:.4g}, {:.4g}, {:.4g}) m belongs to another one too",
            model.interfaces[s].name, mesh.face_centre[f][0], mesh.face_centre[f][1], mesh.face_centre[f][2]));
      add(s, model.interfaces[s], k);
    }
}

void CohesiveFaces::add(std::size_t number, const CohesiveSurface& surface, std::size_t k) {
  const Index f = surface.faces[k];
  bond_.push_back(bond(f));
  InterfaceStrength at = surface.at[k];
  if (surface.law.law->has_rise() && !(at.stiffness > 0.0)) at.stiffness = rigid_stiffness * bond_.back();
  if (surface.law.is_all_rise(at))
    throw InputError(
        fmt::format("interface \"{}\": with the stiffness {} the rise to the strength takes more than the toughness; "
                    "at least strength^2 / (2 toughness) = {}",
                    surface.name, quantity_text(at.stiffness, "Pa/m"),
                    quantity_text(0.5 * at.strength * at.strength / at.toughness, "Pa/m")));
  faces_.push_back({.surface = number,
                    .sides = {.P = mesh_.owner[f], .N = mesh_.neighbour[f], .n = mesh_.face_area[f].normalized()},
                    .area = mesh_.face_area[f].norm(),
                    .at = at});
}

std::vector<Vector> CohesiveFaces::held_forces(const std::vector<InterfaceHistory>& histories) const {
  const auto can_hold = [](const CohesiveSurface& surface) {
    return surface.law.own_law != nullptr || !surface.law.branches.empty();
  };
  if (std::ranges::none_of(model_.interfaces, can_hold)) return {};
  std::vector<Vector> forces(faces_.size());
  parallel_for(count_of(faces_), [&](Index k) {
    const Face& face = faces_[k];
    const BranchTractions& q = histories[k].branch;
    forces[k] =
        face.area * (law(face).own_law ? law(face).respond(face.at, face.sides.n, Vector::Zero(), histories[k]).traction
                                       : std::accumulate(q.begin(), q.end(), Vector(Vector::Zero())));
  });
  return forces;
}

bool CohesiveFaces::has_rate_laws() const {
  return std::ranges::any_of(model_.interfaces, [](const CohesiveSurface& surface) { return surface.law.rate.any(); });
}

bool CohesiveFaces::are_sound(const std::vector<InterfaceHistory>& histories) const {
  const auto can_rub = [](const CohesiveSurface& surface) { return surface.law.friction > 0.0; };
  if (std::ranges::any_of(model_.interfaces, can_rub)) return false;
  constexpr double rounding = 1e-9;  // of the toughness
  for (std::size_t k = 0; k < faces_.size(); ++k)
    if (histories[k].dissipated > rounding * faces_[k].at.toughness) return false;
  return true;
}

double CohesiveFaces::bond(Index face) const {
  const Vector n = mesh_.face_area[face].normalized();
  const auto softness = [&](Index c) {
    const double h = std::abs((mesh_.face_centre[face] - mesh_.cell_centre[c]).dot(n));
    return h / model_.in_cell(mesh_, c).elasticity.constrained_modulus();
  };
  return 1.0 / (softness(mesh_.owner[face]) + softness(mesh_.neighbour[face]));
}

double CohesiveFaces::advance(const MomentumOperator& balance, const std::vector<Vector>& u,
                              const std::vector<InterfaceHistory>& before, std::vector<InterfaceHistory>& after) const {
  after.resize(faces_.size());
  return parallel_sum(count_of(faces_), [&](Index k) {
    const InterfaceResponse response =
        respond(k, normal(faces_[k], balance), balance.separation(k, u), before[k], after[k]);
    after[k] = response.history;
    return faces_[k].area * response.stored;
  });
}

double CohesiveFaces::dissipated(const std::vector<InterfaceHistory>& from,
                                 const std::vector<InterfaceHistory>& to) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < faces_.size(); ++k)
    sum += faces_[k].area * (to[k].dissipated + to[k].rubbed - from[k].dissipated - from[k].rubbed);
  return sum;
}

double CohesiveFaces::viscous_dissipation(const std::vector<InterfaceHistory>& from,
                                          const std::vector<InterfaceHistory>& to) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < faces_.size(); ++k) sum += faces_[k].area * (to[k].viscous - from[k].viscous);
  return sum;
}

std::vector<double> CohesiveFaces::heat(const std::vector<InterfaceHistory>& from,
                                        const std::vector<InterfaceHistory>& to, double debonding_share) const {
  std::vector<double> made(faces_.size());
  for (std::size_t k = 0; k < faces_.size(); ++k)
    made[k] = faces_[k].area * (to[k].rubbed - from[k].rubbed + to[k].viscous - from[k].viscous +
                                debonding_share * (to[k].dissipated - from[k].dissipated));
  return made;
}

bool CohesiveFaces::has_debonded(std::size_t k, const Vector& n, const Vector& separation,
                                 const InterfaceHistory& history) const {
  constexpr double most_of_it = 0.9;
  return law(faces_[k]).damage(faces_[k].at, n, separation, history) >= most_of_it;
}

std::vector<char> CohesiveFaces::parted(const MomentumOperator& balance, const std::vector<Vector>& u,
                                        const std::vector<InterfaceHistory>& histories) const {
  std::vector<char> parted(faces_.size(), 0);
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Vector n = normal(faces_[k], balance), separation = balance.separation(k, u);
    parted[k] = n.dot(separation) > 0.0 && has_debonded(k, n, separation, histories[k]) ? 1 : 0;
  }
  return parted;
}

std::vector<double> CohesiveFaces::debonded_areas(const MomentumOperator& balance, const std::vector<Vector>& u,
                                                  const std::vector<InterfaceHistory>& histories) const {
  std::vector<double> areas(model_.interfaces.size(), 0.0);
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Face& face = faces_[k];
    const Vector n = normal(face, balance);
    if (has_debonded(k, n, balance.separation(k, u), histories[k])) areas[face.surface] += face.area;
  }
  return areas;
}

double CohesiveFaces::dissipated_at(const MomentumOperator& balance, const std::vector<Vector>& u,
                                    const std::vector<InterfaceHistory>& from) const {
  std::vector<InterfaceHistory> to;
  advance(balance, u, from, to);
  return dissipated(from, to);
}

double CohesiveFaces::dissipation_growth(const MomentumOperator& balance, const std::vector<Vector>& u,
                                         const std::vector<InterfaceHistory>& from,
                                         const std::vector<Vector>& change) const {
  return parallel_sum(count_of(faces_), [&](Index k) {
    const Face& face = faces_[k];
    const InterfaceResponse response = law(face).respond(face.at, face.sides.n, balance.separation(k, u), from[k]);
    return face.area * response.dissipation_slope.dot(balance.separation(k, change));
  });
}

std::vector<OutputInterface> CohesiveFaces::output(const MomentumOperator& balance, const FractureState& state) const {
  std::vector<OutputInterface> list;
  std::size_t k = 0;
  for (const CohesiveSurface& surface : model_.interfaces) {
    const std::size_t n = surface.faces.size();
    OutputInterface out{.name = surface.name,
                        .faces = surface.faces,
                        .separation = CellField<Vector>(n),
                        .traction = CellField<Vector>(n),
                        .opening = CellField<double>(n),
                        .damage = CellField<double>(n),
                        .dissipated = CellField<double>(n)};
    for (Index i = 0; i < static_cast<Index>(n); ++i, ++k) {
      const Face& face = faces_[k];
      const Vector separation = balance.separation(k, state.displacement);
      const double sign = surface.sign.empty() ? 1.0 : surface.sign[i];
      out.separation[i] = sign * separation;
      const Vector along = normal(face, balance);
      out.opening[i] = along.dot(separation);
      out.dissipated[i] = state.interfaces[k].dissipated;
      out.damage[i] = law(face).damage(face.at, along, separation, state.interfaces[k]);
      out.traction[i] = sign * law(face).respond(face.at, along, separation, state.interfaces[k]).traction;
    }
    list.push_back(std::move(out));
  }
  return list;
}

std::vector<std::string> CohesiveFaces::warnings() const {
  std::vector<double> worst(model_.interfaces.size(), 0.0);
  std::vector<double> length(model_.interfaces.size(), 0.0);
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const Face& face = faces_[k];
    const double ratio = law(face).steepest_fall(face.at) / bond_[k];
    if (!(ratio > worst[face.surface])) continue;
    worst[face.surface] = ratio;
    const auto first = std::ranges::find(faces_, face.surface, &Face::surface) - faces_.begin();
    const Index f = model_.interfaces[face.surface].faces[k - first];
    length[face.surface] = (mesh_.cell_centre[mesh_.neighbour[f]] - mesh_.cell_centre[mesh_.owner[f]]).norm();
  }
  constexpr double jams = 1.0;  // friction from which on, as measured
  std::vector<std::string> lines;
  for (const CohesiveSurface& surface : model_.interfaces)
    if (surface.law.friction >= jams)
      lines.push_back(
          fmt::format("interface \"{}\": with a friction of {:.3g} bodies that slide may jam, and which of several "
                      "equilibria is found "
                      "depends on the load steps: compare with loading.maximum_increment halved",
                      surface.name, surface.law.friction));
  for (std::size_t s = 0; s < worst.size(); ++s)
    if (worst[s] > 1.0)
      lines.push_back(fmt::format(
          "interface \"{}\": the law softens faster than the cells beside it unload, {} from centre to centre; faces "
          "would tear one by one, in jumps: at most {} resolves the law",
          model_.interfaces[s].name, quantity_text(length[s], "m", 3), quantity_text(length[s] / worst[s], "m", 3)));
  return lines;
}

}  // namespace pfdm
