#include "solver/momentum/momentum.h"

#include "solver/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

CellField<Tensor> closures(const Mesh& mesh) {
  CellField<Tensor> closure(as_size(mesh.n_cells()));
  parallel_for(mesh.n_cells(), [&](Index c) {
    Tensor K = Tensor::Zero();
    for (const Index f : mesh.faces_of_cell(c)) {
      const double sign = mesh.owner[f] == c ? 1.0 : -1.0;
      K += sign * mesh.face_area[f] * (mesh.face_centre[f] - mesh.cell_centre[c]).transpose();
    }
    closure[c] = (K / mesh.cell_volume[c]).inverse();
  });
  return closure;
}

// Of axisymmetric meshes; empty of others.
CellField<Vector> sector_areas(const Mesh& mesh, const Unknowns& unknowns) {
  if (!unknowns.is_axisymmetric()) return {};
  CellField<Vector> area(as_size(mesh.n_cells()), Vector::Zero());
  for (const PatchCondition& on : unknowns.conditions) {
    if (on.condition.kind != BoundaryCondition::Kind::axisymmetric) continue;
    const Patch& patch = mesh.patches[as_size(on.patch)];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f)
      area[mesh.owner[f]] += mesh.face_area[f];
  }
  return area;
}

}  // namespace

MomentumOperator::MomentumOperator(const Mesh& mesh, const Unknowns& unknowns)
    : mesh_(mesh),
      unknowns_(unknowns),
      gradient_(mesh, {.zone = unknowns.zone,
                       .node_of_face = unknowns.node_of_face,
                       .neighbour_node = unknowns.neighbour_node,
                       .plane_normal = unknowns.plane_normal,
                       .wanted = {}}),
      moduli_(as_size(mesh.n_cells())),
      jump_share_(jump_shares(mesh, unknowns)),
      liquidity_(as_size(mesh.n_cells()), 0.0),
      pressed_faces_(mesh, unknowns),
      force_of_face_(as_size(mesh.n_faces()), -1),
      second_side_of_node_(unknowns.face_of_node.size(), -1),
      first_side_of_node_(unknowns.face_of_node.size(), -1),
      closure_(closures(mesh)),
      sector_area_(sector_areas(mesh, unknowns)),
      sector_stress_(sector_area_.size() > 0 ? as_size(mesh.n_cells()) : 0, 0.0),
      pressure_(mesh, unknowns),
      gradients_(as_size(mesh.n_cells())) {
  add_links();
  add_sides();
  forces_.resize(links_.size() + sides_.size());
  if (pressure_.any()) flux_.resize(forces_.size());
  list_forces_of_cells();
  cubic_ = CubicFaces(mesh, unknowns, sides_by_turn());
  layers_ = LayerGradients(mesh, unknowns, sides_by_turn(), links_, cells_with_lines(mesh, unknowns));
  bonded_ = BondedSides(mesh, unknowns, sides_, [&](Index c) { return !cubic_.fits(c); });
  bonded_gradients_.resize(bonded_.size());
}

std::vector<MovedFaces::Place> MomentumOperator::places_by_force() const {
  std::vector<MovedFaces::Place> places;
  places.reserve(links_.size() + sides_.size());
  for (const Link& link : links_) places.push_back({.face = link.face, .cell = link.P, .beyond = link.N});
  for (std::size_t i = 0; i < sides_.size(); ++i)
    places.push_back({.face = sides_[i].face, .cell = sides_[i].cell, .node = sides_[i].node, .side = i});
  return places;
}

std::vector<CubicFaces::Side> MomentumOperator::sides_by_turn() const {
  std::vector<CubicFaces::Side> by_turn;
  by_turn.reserve(2 * links_.size() + sides_.size());
  for (const Link& link : links_) {
    by_turn.push_back({.cell = link.P, .face = link.face});
    by_turn.push_back({.cell = link.N, .face = link.face});
  }
  for (const Side& side : sides_) by_turn.push_back({.cell = side.cell, .face = side.face});
  return by_turn;
}

void MomentumOperator::add_links() {
  for (Index f = 0; f < mesh_.n_interior_faces(); ++f) {
    if (unknowns_.node_of_face[f] >= 0) continue;
    const Index P = mesh_.owner[f], N = mesh_.neighbour[f];
    force_of_face_[as_size(f)] = static_cast<Index>(links_.size());
    links_.push_back({.face = f,
                      .P = P,
                      .N = N,
                      .area = mesh_.face_area[f].norm(),
                      .n = mesh_.face_area[f].normalized(),
                      .d_P = mesh_.face_centre[f] - mesh_.cell_centre[P],
                      .d_N = mesh_.face_centre[f] - mesh_.cell_centre[N]});
  }
}

void MomentumOperator::add_sides() {
  const auto add = [&](Index node, Index f, Index cell, double sign) {
    sides_.push_back({.face = f,
                      .cell = cell,
                      .node = node,
                      .area = mesh_.face_area[f].norm(),
                      .n = sign * mesh_.face_area[f].normalized(),
                      .d = mesh_.face_centre[f] - mesh_.cell_centre[cell]});
    return static_cast<Index>(sides_.size()) - 1;
  };
  for (std::size_t k = 0; k < unknowns_.face_of_node.size(); ++k) {
    const Index f = unknowns_.face_of_node[k], node = unknowns_.n_cells + static_cast<Index>(k);
    if (node != unknowns_.node_of_face[f]) {
      first_side_of_node_[k] = add(node, f, mesh_.neighbour[f], -1.0);
      continue;
    }
    first_side_of_node_[k] = add(node, f, mesh_.owner[f], 1.0);
    force_of_face_[as_size(f)] = static_cast<Index>(links_.size()) + first_side_of_node_[k];
    const bool shared = mesh_.is_interior(f) && unknowns_.node_beside(mesh_, mesh_.neighbour[f], f) == node;
    if (shared) second_side_of_node_[k] = add(node, f, mesh_.neighbour[f], -1.0);
  }
  for (const Index f : unknowns_.split_faces)
    split_faces_.push_back({.node = unknowns_.node_of_face[f],
                            .beyond = unknowns_.neighbour_node[f],
                            .area = mesh_.face_area[f].norm(),
                            .P = mesh_.owner[f],
                            .N = mesh_.neighbour[f],
                            .n = mesh_.face_area[f].normalized()});
}

void MomentumOperator::list_forces_of_cells() {
  cell_offsets_.push_back(0);
  for (Index c = 0; c < mesh_.n_cells(); ++c) {
    for (const Index f : mesh_.faces_of_cell(c)) {
      const Index force = force_of_face_[as_size(f)], node = unknowns_.node_beside(mesh_, c, f);
      if (force < 0) continue;
      if (mesh_.owner[f] == c) {
        cell_forces_.push_back({force, 1.0});
      } else if (node < 0) {
        cell_forces_.push_back({force, -1.0});
      } else {
        const std::size_t k = as_size(node - unknowns_.n_cells);
        const Index side = second_side_of_node_[k] >= 0 ? second_side_of_node_[k] : first_side_of_node_[k];
        cell_forces_.push_back({static_cast<Index>(links_.size()) + side, 1.0});
      }
    }
    cell_offsets_.push_back(cell_forces_.size());
  }
}

void MomentumOperator::set_moduli(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g, double part,
                                  CellField<LinearStress> stress) {
  moduli_ = moduli;
  stiffness_ = {};
  law_ = {};
  linear_stress_ = std::move(stress);
  renew_liquidity();
  condense(moduli_);
  pressure_.take_over(moduli_, g);
  find_initial_stress();
  if (has_linear_stress()) condense(linear_stress_);
  gradient_.update(g, part);
  has_linear_stress() ? leave_out_third_order() : weigh_third_order(g);
  parallel_for(static_cast<Index>(links_.size()), [&](Index i) {
    Link& link = links_[as_size(i)];
    const IsotropicElasticity &P = moduli_[link.P], &N = moduli_[link.N];
    const double h_P = std::abs(link.d_P.dot(link.n)), h_N = std::abs(link.d_N.dot(link.n));
    const double a_n = P.constrained_modulus() / h_P, b_n = N.constrained_modulus() / h_N;
    const double a_t = P.mu / h_P, b_t = N.mu / h_N;
    link.weight_n = b_n / (a_n + b_n);
    link.weight_t = b_t / (a_t + b_t);
    link.c_n = a_n * link.weight_n;
    link.c_t = a_t * link.weight_t;
    link.jump_n = jump_stiffness(link.P, link.N, h_P, h_N, link.c_n);
    link.jump_t = slip_stiffness(link.P, link.N, link.c_n, link.c_t);
    if (has_relaxed_flat_cells_ && !is_of_third_order(as_size(i))) link.jump_t *= bending_part(link);
  });
  parallel_for(static_cast<Index>(sides_.size()), [&](Index i) {
    Side& side = sides_[as_size(i)];
    const double h = std::abs(side.d.dot(side.n)) / stiffer_at(turn_of_side(as_size(i)));
    side.a_n = jump_modulus(side.cell) / h;
    side.a_t = moduli_[side.cell].mu / h;
  });
}

void MomentumOperator::set_face_tensors() {
  link_tensors_.resize(links_.size());
  side_tensors_.resize(sides_.size());
  parallel_for(static_cast<Index>(links_.size()), [&](Index i) {
    const Link& link = links_[as_size(i)];
    const double h_P = std::abs(link.d_P.dot(link.n)), h_N = std::abs(link.d_N.dot(link.n));
    const Tensor a = acoustic(link.P, link.n) / h_P, b = acoustic(link.N, link.n) / h_N;
    const Tensor softness = (a + b).inverse(), weight = b * softness;
    const Tensor c = is_finite() ? jump_tensor(link, h_P, h_N) : symmetric_part(weight * a);
    link_tensors_[as_size(i)] = {.weight = weight, .c = c, .softness = softness};
  });
  parallel_for(static_cast<Index>(sides_.size()), [&](Index i) {
    const Side& side = sides_[as_size(i)];
    side_tensors_[as_size(i)] = side_acoustic(as_size(i)) / std::abs(side.d.dot(side.n));
  });
}

void MomentumOperator::reconstruct(const std::vector<Vector>& u) const {
  const Vector &r = unknowns_.radial, &across = unknowns_.plane_normal;
  parallel_for(mesh_.n_cells(), [&](Index c) {
    gradients_[c] = gradient_.of(u.data(), c);
    if (unknowns_.is_axisymmetric())
      gradients_[c] += (r.dot(u[as_size(c)]) / r.dot(mesh_.cell_centre[c])) * across * across.transpose();
  });
  if (cubic_.any()) cubic_.read(u, gradients_);
  if (layers_.any()) layers_.correct(u, gradients_);
  if (pressure_.any()) pressure_.read(u);
}

void MomentumOperator::find_bonded_gradients(const std::vector<Vector>& u) const {
  parallel_for(static_cast<Index>(bonded_.size()), [&](Index k) {
    const Index c = sides_[bonded_.side(as_size(k))].cell;
    bonded_gradients_[as_size(k)] = bonded_.gradient(as_size(k), u, gradients_[c]);
  });
}

void MomentumOperator::find_gradients(const std::vector<Vector>& u) const {
  reconstruct(u);
  find_bonded_gradients(u);
  if (is_finite()) {
    moved_faces_.move(field(u), corner_moves_);
    find_area_changes();
    return find_linear_stresses();
  }
  const Vector& across = unknowns_.plane_normal;
  parallel_for(sector_stress_.size(),
               [&](Index c) { sector_stress_[c] = across.dot(normal_stress(c, across)) + pressure_.mean(c); });
}

void MomentumOperator::compute_linear_forces(const std::vector<Vector>& u) const {
  find_gradients(u);
  const auto n_links = static_cast<Index>(links_.size());
  const bool has_fluxes = pressure_.any() && !is_finite();
  parallel_for(n_links, [&](Index i) {
    const Link& link = links_[as_size(i)];
    const Vector stress_P = linear_traction(link.P, link.n, link.d_P, turn_P(as_size(i)));
    const Vector stress_N = linear_traction(link.N, link.n, link.d_N, turn_N(as_size(i)));
    const Vector u_P = u[as_size(link.P)] + rise(link.P, link.d_P, turn_P(as_size(i)));
    const Vector jump = u[as_size(link.N)] + rise(link.N, link.d_N, turn_N(as_size(i))) - u_P;
    if (has_fluxes) flux_[as_size(i)] = link_flux(as_size(i), u_P, jump, stress_N - stress_P);
    if (!moved_.empty()) moved_[as_size(i)] = linear_face_displacement(as_size(i), u_P, jump, stress_N - stress_P);
    forces_[as_size(i)] = link.area * (stress_N + weigh(as_size(i), stress_P - stress_N) + pull_jump(as_size(i), jump));
    if (!jump_turns_.empty()) forces_[as_size(i)] += link.area * turned_jump(as_size(i));
  });
  parallel_for(static_cast<Index>(sides_.size()), [&](Index i) {
    const Side& side = sides_[as_size(i)];
    const Vector gap =
        u[as_size(side.node)] - u[as_size(side.cell)] - rise(side.cell, side.d, turn_of_side(as_size(i)));
    const Vector stress = linear_traction(side.cell, side.n, side.d, turn_of_side(as_size(i)));
    forces_[as_size(n_links + i)] = side.area * (stress + hold(as_size(i), gap));
    if (has_fluxes) flux_[as_size(n_links + i)] = side_flux(side, u[as_size(side.node)]);
  });
}

void MomentumOperator::add_initial_forces() const {
  if (!has_initial_stress()) return;
  const auto n_links = static_cast<Index>(links_.size());
  parallel_for(n_links, [&](Index i) {
    const Link& link = links_[as_size(i)];
    const Vector on_P = initial_traction(link.P, link.n, turn_P(as_size(i)));
    const Vector on_N = initial_traction(link.N, link.n, turn_N(as_size(i)));
    forces_[as_size(i)] += link.area * (on_N + weigh(as_size(i), on_P - on_N));
    if (!jump_turns_.empty()) forces_[as_size(i)] += link.area * jump_turns_[as_size(i)].initial;
  });
  parallel_for(static_cast<Index>(sides_.size()), [&](Index i) {
    const Side& side = sides_[as_size(i)];
    forces_[as_size(n_links + i)] += side.area * initial_traction(side.cell, side.n, turn_of_side(as_size(i)));
  });
  const Vector& across = unknowns_.plane_normal;
  parallel_for(sector_stress_.size(), [&](Index c) {
    sector_stress_[c] += is_finite() ? initial_sector_[c] : across.dot(initial_stress(c) * across);
  });
}

void MomentumOperator::compute_forces(const std::vector<Vector>& u) const {
  compute_linear_forces(u);
  add_initial_forces();
}

void MomentumOperator::apply(const std::vector<Vector>& u, std::vector<Vector>& out) const {
  compute_linear_forces(u);
  sum_forces(out);
  hold_spins(out);
  pull_by_springs(u, out);
  if (is_finite()) {
    pressed_faces_.add_turn(u, gradients_, out);
    balance_finite_pressures(u, out);
  } else {
    balance_pressures(out);
  }
}

void MomentumOperator::pull_by_springs(const std::vector<Vector>& u, std::vector<Vector>& out) const {
  parallel_for(static_cast<Index>(springs_.size()), [&](Index k) {
    const SplitFace& face = split_faces_[as_size(k)];
    Vector force = face.area * (springs_[as_size(k)].stiffness * separation(as_size(k), u));
    if (is_finite()) force += face.area * turned_spring(as_size(k));
    out[as_size(face.node)] -= force;
    out[as_size(face.beyond)] += force;
  });
}

void MomentumOperator::add_spring_offsets(std::vector<Vector>& load) const {
  for (std::size_t k = 0; k < springs_.size(); ++k) {
    const SplitFace& face = split_faces_[k];
    load[as_size(face.node)] += face.area * springs_[k].offset;
    load[as_size(face.beyond)] -= face.area * springs_[k].offset;
  }
}

void MomentumOperator::sum_forces(std::vector<Vector>& out) const {
  parallel_for(mesh_.n_cells(), [&](Index c) {
    Vector sum = Vector::Zero();
    for (std::size_t k = cell_offsets_[as_size(c)]; k < cell_offsets_[as_size(c) + 1]; ++k)
      sum += cell_forces_[k].sign * forces_[as_size(cell_forces_[k].force)];
    if (sector_area_.size() > 0) sum += sector_stress_[c] * sector_area_[c];
    out[as_size(c)] = -sum;
  });
  const std::size_t n_links = links_.size();
  parallel_for(static_cast<Index>(first_side_of_node_.size()), [&](Index k) {
    Vector sum = forces_[n_links + as_size(first_side_of_node_[as_size(k)])];
    if (const Index second = second_side_of_node_[as_size(k)]; second >= 0) sum += forces_[n_links + as_size(second)];
    out[as_size(unknowns_.n_cells + k)] = unknowns_.free_directions[as_size(k)] * sum;
  });
  gather_from_images(out);
  work_on_free_strains(out);
  keep_in_plane(out);
}

// Plane meshes neither move nor are loaded across their plane.
void MomentumOperator::keep_in_plane(std::vector<Vector>& v) const {
  const Vector& n = unknowns_.plane_normal;
  if (n.isZero()) return;
  parallel_for(unknowns_.n_nodes(), [&](Index i) { v[as_size(i)] -= n.dot(v[as_size(i)]) * n; });
}

std::vector<Vector> MomentumOperator::traction_forces(double t) const {
  std::vector<Vector> load(as_size(unknowns_.n_unknowns()), Vector::Zero());
  for (const PatchCondition& on : unknowns_.conditions) {
    const BoundaryCondition& condition = on.condition;
    if (condition.kind != BoundaryCondition::Kind::components || !condition.value) continue;
    const Patch& patch = mesh_.patches[as_size(on.patch)];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Index node = unknowns_.node_of_face[f];
      load[as_size(node)] = unknowns_.free_directions[as_size(node - unknowns_.n_cells)] *
                            condition.value(mesh_.face_centre[f], t) * mesh_.face_area[f].norm();
    }
  }
  pressed_faces_.add_forces(t, load);
  if (const auto& force = unknowns_.loads.force)
    parallel_for(mesh_.n_cells(), [&](Index c) { load[as_size(c)] += mesh_.cell_volume[c] * force(mesh_, c, t); });
  const BoxMotion& motion = unknowns_.motion;
  for (std::size_t k = 0; k < motion.free_strains.size(); ++k)
    if (motion.free_strains[k].stress)
      load[as_size(unknowns_.first_strain()) + k] =
          motion.size.prod() * motion.free_strains[k].stress(t) * Vector::UnitX();
  keep_in_plane(load);
  return load;
}

std::vector<Vector> MomentumOperator::load_vector(double t) const {
  std::vector<Vector> load = traction_forces(t);
  add_spin_targets(t, load);
  if (has_initial_stress()) take_away_initial_forces(load);
  if (is_finite()) pressed_faces_.add_initial_turn(load);
  return load;
}

void MomentumOperator::prescribe(double t, std::vector<Vector>& u) const {
  for (const PatchCondition& on : unknowns_.conditions) {
    const BoundaryCondition& condition = on.condition;
    if (is_front_or_back(condition)) continue;
    const Patch& patch = mesh_.patches[as_size(on.patch)];
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Index node = unknowns_.node_of_face[f];
      const Tensor& is_free = unknowns_.free_directions[as_size(node - unknowns_.n_cells)];
      const Vector value = condition.value ? condition.value(mesh_.face_centre[f], t) : Vector::Zero();
      u[as_size(node)] = is_free * u[as_size(node)] + (Tensor::Identity() - is_free) * value;
    }
  }
  const BoxMotion& motion = unknowns_.motion;
  const Tensor E = unknowns_.free_strain(u);
  const auto of_body = [&](const Vector& x) -> Vector {
    const Vector free = E * (x - motion.centre);
    return motion.displacement ? (free + motion.displacement(x, t)).eval() : free;
  };
  for (const HeldFace& held : motion.held) {
    Vector& here = u[as_size(unknowns_.node_of_face[held.face])];
    here += held.directions * (of_body(mesh_.face_centre[held.face]) - here);
  }
  for (const PeriodicNodes& pair : unknowns_.periodic)
    u[as_size(pair.image)] = u[as_size(pair.node)] + of_body(place(pair.image)) - of_body(place(pair.node));
  keep_in_plane(u);
}

void MomentumOperator::take_away_initial_forces(std::vector<Vector>& load) const {
  std::vector<Vector> initial(load.size(), Vector::Zero());
  std::fill(forces_.begin(), forces_.end(), Vector::Zero());
  std::fill(sector_stress_.begin(), sector_stress_.end(), 0.0);
  add_initial_forces();
  sum_forces(initial);
  for (std::size_t i = 0; i < load.size(); ++i) load[i] -= initial[i];
  if (has_eigenstrain() && pressure_.any()) take_away_initial_volumes(load);
  for (std::size_t k = 0; k < volume_rows_.size(); ++k)
    load[as_size(unknowns_.n_nodes()) + k] -=
        mesh_.cell_volume[unknowns_.pressure_cells[k]] * volume_rows_[k].initial * Vector::UnitX();
}

}  // namespace pfdm
