// What a displacement means: strain, stress and energy of the cells, reactions of the patches; plane stress.
//
// The strain is that of the face displacements at which the two sides of each face agree (Green-Gauss). It is exact in
// a laminate however broken a layer is, where the least-squares gradient, which reaches over the layer, is wrong by
// factors; and with the tractions it closes the energy account: sum over cells of 1/2 sum A t.(u_f - u_c) is half the
// work of the boundary forces, because t and u_f are one on each face and the forces on a cell cancel.

#include "solver/momentum/momentum.h"
#include "solver/parallel.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

// Parts of the stiffness: the stress [Pa] by the strain of a cell, and on its faces; the least energy [J/m^3] of a
// cell, given that of its mean strain. That of a law is never negative, but for rounding.
struct IsotropicPart {
  IsotropicElasticity moduli, jump;
  Tensor of_cell(const Tensor& strain) const { return stress(moduli, strain); }
  Tensor at_face(const Tensor& strain) const { return stress(jump, strain); }
  double least(double mean) const { return std::min(mean, 0.0); }
};
struct LawPart {
  const StrainLaw& law;
  Index cell;
  Tensor of_cell(const Tensor& strain) const { return law.degradable(cell, strain); }
  Tensor at_face(const Tensor& strain) const { return of_cell(strain); }
  double least(double) const { return 0.0; }
};

Tensor skew_part(const Tensor& A) { return 0.5 * (A - A.transpose()); }

// R of F = R U, where no stretch is below 1e-3.
Tensor rotation_of(const Tensor& F) {
  constexpr double least = 1e-3;
  const Eigen::SelfAdjointEigenSolver<Tensor> C(F.transpose() * F);
  Vector inverse;
  for (Index i = 0; i < 3; ++i) inverse[i] = 1.0 / std::max(std::sqrt(std::max(C.eigenvalues()[i], 0.0)), least);
  return F * C.eigenvectors() * inverse.asDiagonal() * C.eigenvectors().transpose();
}

// The tractions of a cell have a moment about its centre; those of all cells together are in balance with the loads.
// In the sheared cells along a bonded surface it does 1 % of the work. At the rotation R of a cell, beyond the rotation
// R_0 of the whole body: 1/2 V skew(P R^T) : skew(R R_0^T).
void add_work_of_moments(const Mesh& mesh, const std::vector<Index>& of_cells, CellMechanics& cells) {
  Tensor whole = Tensor::Zero();
  double volume = 0.0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    whole += mesh.cell_volume[c] * (Tensor::Identity() + cells.gradient[c]);
    volume += mesh.cell_volume[c];
  }
  const Tensor R_0 = rotation_of(whole / volume);
  parallel_for(static_cast<Index>(of_cells.size()), [&](Index k) {
    const Index c = of_cells[as_size(k)];
    const Tensor R = rotation_of(Tensor::Identity() + cells.gradient[c]);
    const Tensor moment = skew_part(cells.moderate_stress[c] * R.transpose());
    cells.energy[c] += 0.5 * mesh.cell_volume[c] * contract(moment, skew_part(R * R_0.transpose()));
  });
}

}  // namespace

// (a + b)^-1 v
Vector MomentumOperator::give(std::size_t i, const Vector& v) const {
  if (!is_isotropic()) return link_tensors_[i].softness * v;
  const Link& link = links_[i];
  const double sum_n = link.c_n / (link.weight_n * (1.0 - link.weight_n));
  const double sum_t = link.c_t / (link.weight_t * (1.0 - link.weight_t));
  return scale(1.0 / sum_n, 1.0 / sum_t, link.n, v);
}

// Equal tractions on both sides: (a + b) u_f = a (u_P + G_P d_P) + b (u_N + G_N d_N) + (sigma_N - sigma_P) n. In a
// tensor, (a + b)^-1 b is the transpose of P's weight.
Vector MomentumOperator::face_displacement(std::size_t i, const std::vector<Vector>& u) const {
  const Link& link = links_[i];
  const Vector from_P = u[as_size(link.P)] + rise(link.P, link.d_P, turn_P(i));
  const Vector from_N = u[as_size(link.N)] + rise(link.N, link.d_N, turn_N(i));
  Vector stress_jump =
      linear_traction(link.N, link.n, link.d_N, turn_N(i)) - linear_traction(link.P, link.n, link.d_P, turn_P(i));
  if (has_initial_stress())
    stress_jump += initial_traction(link.N, link.n, turn_N(i)) - initial_traction(link.P, link.n, turn_P(i));
  const Vector towards_N =
      is_isotropic() ? weigh(i, from_N - from_P) : link_tensors_[i].weight.transpose() * (from_N - from_P);
  return from_P + towards_N + give(i, stress_jump);
}

void MomentumOperator::condense(CellField<IsotropicElasticity>& moduli) {
  if (!unknowns_.plane_stress) return;
  strain_across_ = CellField<StrainAcross>(as_size(moduli.size()));
  if (has_eigenstrain()) initial_stress_ = CellField<Tensor>(as_size(moduli.size()));
  parallel_for(moduli.size(), [&](Index c) {
    LinearStress whole{.C = stiffness_matrix(moduli[c]), .initial = Mandel::Zero()};
    if (has_eigenstrain()) {
      whole.initial = -(whole.C * eigenstrain_[c]);
      initial_stress_[c] = to_tensor(plane_stress(whole, unknowns_.plane_normal).initial);
    }
    strain_across_[c] = strain_across(whole, unknowns_.plane_normal);
    moduli[c] = plane_stress(moduli[c]);
  });
}

bool MomentumOperator::set_eigenstrain(std::optional<double> t) {
  if (!unknowns_.loads.eigenstrain || t == eigenstrain_load_) return false;
  eigenstrain_load_ = t;
  eigenstrain_ = CellField<Mandel>(t ? as_size(mesh_.n_cells()) : 0);
  parallel_for(eigenstrain_.size(), [&](Index c) { eigenstrain_[c] = unknowns_.loads.eigenstrain(mesh_, c, *t); });
  return true;
}

// In a uniform body the forces of eigenstrains cancel. Pressures are zero then.
double MomentumOperator::energy_if_held() const {
  if (is_finite())
    return parallel_sum(eigenstrain_.size(), [&](Index c) {
      IsotropicElasticity sound = unknowns_.sound[as_size(unknowns_.zone[c])];
      sound.lambda = std::min(sound.lambda, CellPressure::moderate_lambda * sound.mu);
      return 2.0 * mesh_.cell_volume[c] * energy_density(sound, to_tensor(eigenstrain_[c]));
    });
  const CellMechanics held =
      mechanics(std::vector<Vector>(as_size(unknowns_.n_unknowns()), Vector::Zero()), Wanted::without_gradient);
  return parallel_sum(held.eigenstrain.size(),
                      [&](Index c) { return std::abs(held.traction_moment[c].dot(held.eigenstrain[c])); });
}

// In plane stress that of isotropic cells is condensed with their moduli.
void MomentumOperator::find_initial_stress() {
  if (!has_eigenstrain()) return;
  if (has_linear_stress()) {
    parallel_for(linear_stress_.size(),
                 [&](Index c) { linear_stress_[c].initial -= linear_stress_[c].C * eigenstrain_[c]; });
  } else if (!unknowns_.plane_stress) {
    initial_stress_ = CellField<Tensor>(as_size(moduli_.size()));
    parallel_for(moduli_.size(),
                 [&](Index c) { initial_stress_[c] = -stress(moduli_[c], to_tensor(eigenstrain_[c])); });
  }
}

void MomentumOperator::condense(CellField<LinearStress>& stress) {
  if (!unknowns_.plane_stress) return;
  strain_across_ = CellField<StrainAcross>(as_size(stress.size()));
  parallel_for(stress.size(), [&](Index c) {
    strain_across_[c] = strain_across(stress[c], unknowns_.plane_normal);
    stress[c] = plane_stress(stress[c], unknowns_.plane_normal);
  });
}

Tensor MomentumOperator::with_strain_across(Index cell, const Tensor& gradient) const {
  if (!unknowns_.plane_stress || is_finite()) return gradient;
  const Vector& n = unknowns_.plane_normal;
  if (has_law()) return gradient - symmetric_part(gradient) + law_at(cell, symmetric_part(gradient)).strain;
  return gradient + strain_across_[cell](to_mandel(symmetric_part(gradient))) * n * n.transpose();
}

double MomentumOperator::stress_across(Index cell, const Tensor& strain) const {
  if (unknowns_.plane_stress) return 0.0;
  const Vector& normal = unknowns_.plane_normal;
  if (is_isotropic() && !has_linear_stress()) {
    const double by_strain = moduli_[cell].lambda * strain.trace() + pressure_.mean(cell);
    return has_eigenstrain() ? by_strain + normal.dot(initial_stress_[cell] * normal) : by_strain;
  }
  const Mandel stress =
      has_law()
          ? Mandel(law_.tangent(cell, without_eigenstrain(cell, strain)) * to_mandel(without_eigenstrain(cell, strain)))
          : linear_stress_[cell](to_mandel(strain));
  return normal.dot(to_tensor(stress) * normal);
}

FaceField<Vector> MomentumOperator::face_displacements(const std::vector<Vector>& u) const {
  FaceField<Vector> u_face(as_size(mesh_.n_faces()), Vector::Zero());
  parallel_for(static_cast<Index>(links_.size()),
               [&](Index i) { u_face[links_[as_size(i)].face] = face_displacement(as_size(i), u); });
  for (std::size_t k = 0; k < unknowns_.face_of_node.size(); ++k)
    if (const auto node = as_size(unknowns_.n_cells) + k;
        as_size(unknowns_.node_of_face[unknowns_.face_of_node[k]]) == node)
      u_face[unknowns_.face_of_node[k]] = u[node];
  return u_face;
}

// A split face has a displacement on each side. Faces of plane patches carry no unknown: they move with their cell,
// within the plane. Those of a sector move with its gradient, in themselves.
Vector MomentumOperator::seen_from(Index cell, Index face, const FaceField<Vector>& u_face,
                                   const std::vector<Vector>& u) const {
  if (const Index node = unknowns_.node_beside(mesh_, cell, face); node != unknowns_.node_of_face[face])
    return u[as_size(node)];
  return force_of_face_[as_size(face)] >= 0 ? u_face[face] : moved_with(cell, face, u);
}

Vector MomentumOperator::moved_with(Index cell, Index face, const std::vector<Vector>& u) const {
  if (unknowns_.is_axisymmetric()) {
    const Vector along = mesh_.face_area[face].normalized();
    const Vector moved = u[as_size(cell)] + gradients_[cell] * (mesh_.face_centre[face] - mesh_.cell_centre[cell]);
    return moved - along.dot(moved) * along;
  }
  const Vector& n = unknowns_.plane_normal;
  return u[as_size(cell)] - n.dot(u[as_size(cell)]) * n;
}

// What the displacement of a side's face, less that of the cell, is beyond the cell's own rise; without that part of
// the jump which has no weight (layer_gradients.h).
Vector MomentumOperator::gap(Index cell, const Vector& d, std::size_t turn, const Vector& move,
                             const std::vector<Vector>& u) const {
  const Vector gap = move - rise(cell, d, turn);
  if (turn >= 2 * links_.size() || !layers_.weighs(turn / 2)) return gap;
  const std::size_t i = turn / 2;
  const Link& link = links_[i];
  const Vector jump =
      u[as_size(link.N)] + rise(link.N, link.d_N, turn_N(i)) - u[as_size(link.P)] - rise(link.P, link.d_P, turn_P(i));
  const Vector without = jump - layers_.weight(i) * jump, towards_N = weigh(i, without);
  return gap - (turn == turn_P(i) ? towards_N : Vector(towards_N - without));
}

// The energy of the mean strain and of what the strains of the faces differ from it; without eigenstrains, of which
// the cell has one.
template <class Stress>
double MomentumOperator::part_energy(Index cell, const Stress& stress_of, const Tensor& strain,
                                     const FaceField<Vector>& u_face, const std::vector<Vector>& u) const {
  const Tensor elastic = without_eigenstrain(cell, strain), mean_stress = stress_of.at_face(elastic);
  double varying = 0.0;
  std::size_t k = cell_offsets_[as_size(cell)];
  for (const Index f : mesh_.faces_of_cell(cell)) {
    if (force_of_face_[as_size(f)] < 0) continue;
    const std::size_t turn = turn_at(cell_forces_[k++]);
    const Vector area = (mesh_.owner[f] == cell ? 1.0 : -1.0) * mesh_.face_area[f];
    const Vector n = area.normalized(), d = mesh_.face_centre[f] - mesh_.cell_centre[cell];
    const Vector move = seen_from(cell, f, u_face, u) - u[as_size(cell)];
    const Tensor in_cell = varies_within_cells() ? gradient_at(cell, turn) : gradients_[cell];
    const double h = bounded_height(d, n) / stiffer_at(turn);
    const Tensor at_face = with_strain_across(cell, in_cell + gap(cell, d, turn, move, u) * n.transpose() / h);
    const Tensor change = stress_of.at_face(without_eigenstrain(cell, symmetric_part(at_face))) - mean_stress;
    const Vector elastic_move = has_eigenstrain() ? (move - to_tensor(eigenstrain_[cell]) * d).eval() : move;
    varying += 0.5 * elastic_move.dot(change * area);
  }
  const double mean = 0.5 * contract(stress_of.of_cell(elastic), elastic);
  return std::max(mean + varying / mesh_.cell_volume[cell], stress_of.least(mean));
}

// In the order of the forces.
std::vector<Vector> MomentumOperator::moves_of_faces(const std::vector<Vector>& u,
                                                     const FaceField<Vector>& u_face) const {
  std::vector<Vector> moves;
  for (const Link& link : links_) moves.push_back(u_face[link.face]);
  for (const Side& side : sides_) moves.push_back(u[as_size(side.node)]);
  return moves;
}

// Area vector [m^2] of a face with a pressure, outwards from the cell.
Vector MomentumOperator::moved_area(const SignedForce& on) const {
  const auto i = as_size(on.force);
  const double area = i < links_.size() ? links_[i].area : sides_[i - links_.size()].area;
  return (on.sign * area) * moved_faces_.area(i);
}

CellMechanics MomentumOperator::mechanics(const std::vector<Vector>& u, Wanted wanted,
                                          const CellField<IsotropicElasticity>& part) const {
  const bool with_gradient = wanted == Wanted::all || is_finite();
  const bool has_pressed_faces = is_finite() && pressure_.any();
  compute_forces(u);
  FaceField<Vector> u_face = face_displacements(u);
  const auto n = as_size(mesh_.n_cells());
  CellMechanics result{.strain = CellField<Tensor>(n),
                       .eigenstrain = eigenstrain_,
                       .traction_moment = CellField<Mandel>(has_eigenstrain() ? n : 0),
                       .gradient = CellField<Tensor>(with_gradient ? n : 0),
                       .stress = CellField<Tensor>(n),
                       .energy = CellField<double>(n),
                       .part_energy = CellField<double>(as_size(part.size()), 0.0)};
  if (has_pressed_faces) {
    result.volume_change = swept_changes(moves_of_faces(u, u_face));
    result.moderate_stress = CellField<Tensor>(n);
  }
  parallel_for(mesh_.n_cells(), [&](Index c) {
    const double volume = mesh_.cell_volume[c];
    Tensor gradient = Tensor::Zero(), moment = Tensor::Zero(), pressed = Tensor::Zero();
    double work = 0.0, by_pressure = 0.0;
    std::size_t k = cell_offsets_[as_size(c)];
    for (const Index f : mesh_.faces_of_cell(c)) {
      const Vector area = (mesh_.owner[f] == c ? 1.0 : -1.0) * mesh_.face_area[f];
      const Vector rise = seen_from(c, f, u_face, u) - u[as_size(c)];
      gradient += rise * area.transpose();
      const bool has_node_or_link = force_of_face_[as_size(f)] >= 0;
      if (!has_node_or_link && !unknowns_.is_axisymmetric()) continue;
      const Vector force = has_node_or_link ? (cell_forces_[k].sign * forces_[as_size(cell_forces_[k].force)]).eval()
                                            : (sector_stress_[c] * area).eval();
      moment += force * (mesh_.face_centre[f] - mesh_.cell_centre[c]).transpose();
      work += 0.5 * force.dot(rise);
      if (has_pressed_faces) {
        const Vector on_face = pressure_.mean(c) * (has_node_or_link ? moved_area(cell_forces_[k])
                                                                     : Vector(moved_faces_.section(c) * area));
        pressed += on_face * (mesh_.face_centre[f] - mesh_.cell_centre[c]).transpose();
        by_pressure += 0.5 * on_face.dot(rise);
      }
      if (has_node_or_link) ++k;
    }
    gradient = with_strain_across(c, gradient * closure_[c].transpose() / volume);
    result.strain[c] = symmetric_part(gradient);
    result.energy[c] = work;
    if (part.size() > 0 && part[c].mu > 0.0)
      result.part_energy[c] =
          part_energy(c, IsotropicPart{part[c], with_jump_modulus(c, part[c])}, result.strain[c], u_face, u);
    else if (part.size() > 0 && has_law())
      result.part_energy[c] = part_energy(c, LawPart{law_, c}, result.strain[c], u_face, u);
    if (with_gradient) result.gradient[c] = gradient;
    if (is_finite()) {
      result.stress[c] = moment * closure_[c] / volume;
      if (has_pressed_faces) result.moderate_stress[c] = (moment - pressed) * closure_[c] / volume;
      result.energy[c] = work - by_pressure - 0.5 * contract(moment - pressed, gradient);
      return;
    }
    const Vector& normal = unknowns_.plane_normal;
    result.stress[c] = symmetric_part((moment * closure_[c]) / volume);
    if (!unknowns_.is_axisymmetric()) {
      const Tensor across = stress_across(c, result.strain[c]) * normal * normal.transpose();
      result.stress[c] += across;
      moment += volume * across;
    }
    if (!has_eigenstrain()) return;
    result.traction_moment[c] = to_mandel(symmetric_part(moment));
    result.energy[c] -= 0.5 * result.traction_moment[c].dot(eigenstrain_[c]);
  });
  if (has_linear_stress()) {
    result.reconstructed_strain = CellField<Tensor>(n);
    parallel_for(mesh_.n_cells(), [&](Index c) {
      result.reconstructed_strain[c] = symmetric_part(with_strain_across(c, gradients_[c]));
    });
  }
  if (is_finite()) result.reconstructed_gradient = gradients_;
  if (has_pressed_faces) add_work_of_moments(mesh_, unknowns_.pressure_cells, result);
  result.face_displacement = std::move(u_face);
  return result;
}

std::vector<Vector> MomentumOperator::boundary_forces(const std::vector<Vector>& u) const {
  compute_forces(u);
  const Index first = mesh_.n_interior_faces();
  std::vector<Vector> boundary(as_size(mesh_.n_faces() - first), Vector::Zero());
  for (Index f = first; f < mesh_.n_faces(); ++f)
    if (const Index force = force_of_face_[as_size(f)]; force >= 0)
      boundary[as_size(f - first)] = forces_[as_size(force)];
  return boundary;
}

std::vector<std::pair<Index, Vector>> MomentumOperator::interface_tractions(const std::vector<Vector>& u) const {
  compute_forces(u);
  std::vector<std::pair<Index, Vector>> tractions;
  for (std::size_t k = 0; k < unknowns_.face_of_node.size(); ++k)
    if (const Index f = unknowns_.face_of_node[k];
        mesh_.is_interior(f) && as_size(unknowns_.node_of_face[f] - unknowns_.n_cells) == k)
      tractions.emplace_back(f, forces_[as_size(force_of_face_[as_size(f)])] / mesh_.face_area[f].norm());
  return tractions;
}

FaceField<Vector> MomentumOperator::tractions(const std::vector<Vector>& u) const {
  compute_forces(u);
  FaceField<Vector> traction(as_size(mesh_.n_faces()));
  parallel_for(mesh_.n_faces(), [&](Index f) {
    if (const Index force = force_of_face_[as_size(f)]; force >= 0)
      traction[f] = forces_[as_size(force)] / mesh_.face_area[f].norm();
  });
  return traction;
}

std::vector<Vector> MomentumOperator::patch_displacements(const std::vector<Vector>& u) const {
  std::vector<Vector> mean(mesh_.patches.size(), Vector::Zero());
  for (std::size_t p = 0; p < mesh_.patches.size(); ++p) {
    const Patch& patch = mesh_.patches[p];
    double area = 0.0;
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Index node = unknowns_.node_of_face[f];
      if (node < 0) continue;
      mean[p] += mesh_.face_area[f].norm() * u[as_size(node)];
      area += mesh_.face_area[f].norm();
    }
    if (area > 0.0) mean[p] /= area;
  }
  return mean;
}

std::vector<MomentumOperator::SplitSides> MomentumOperator::split_sides(const std::vector<Vector>& u) const {
  compute_forces(u);
  std::vector<SplitSides> all(split_faces_.size());
  parallel_for(static_cast<Index>(all.size()), [&](Index k) {
    const auto of_node = [&](Index node, Vector& traction, Tensor& give) {
      const Index i = first_side_of_node_[as_size(node - unknowns_.n_cells)];
      const Side& side = sides_[as_size(i)];
      traction = forces_[links_.size() + as_size(i)] / side.area;
      const Tensor along = side.n * side.n.transpose();
      give = is_isotropic() ? Tensor(along / side.a_n + (Tensor::Identity() - along) / side.a_t)
                            : Tensor(side_tensors_[as_size(i)].inverse());
    };
    SplitSides& sides = all[as_size(k)];
    of_node(split_faces_[as_size(k)].node, sides.traction, sides.give);
    of_node(split_faces_[as_size(k)].beyond, sides.traction_beyond, sides.give_beyond);
  });
  return all;
}

}  // namespace pfdm
