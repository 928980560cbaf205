#include "solver/momentum/small_strain/history_tractions.h"

#include "solver/momentum/small_strain/isotropic_sweep.h"

namespace pfdm {
namespace {

// A gap includes the gradient of a side beyond that of the cell.
struct StressByHistory {
  const CellField<LinearStress>& stress;
  const CellField<IsotropicElasticity>& moduli;
  Tensor of_cell(Index cell, const Tensor& G) const { return to_tensor(stress[cell].C * to_mandel(symmetric_part(G))); }
  Vector operator()(Index cell, const Tensor& G, const Vector& n) const { return of_cell(cell, G) * n; }
  Vector at_side(Index cell, const Tensor& G, const Tensor& at_side, const Vector& n) const {
    return (*this)(cell, G, n) + IsotropicStress{moduli}(cell, at_side - G, n);
  }
};

// The same in a sweep over the faces, found once a cell.
struct SweptStress {
  const StressByHistory by_history;
  CellField<Tensor>& of_cells;
  void see(const CellField<Tensor>& gradients) const {
    if (of_cells.size() == 0) of_cells = CellField<Tensor>(gradients.size());
    parallel_for(gradients.size(), [&](Index c) { of_cells[c] = by_history.of_cell(c, gradients[c]); });
  }
  Vector operator()(Index cell, const Tensor&, const Vector& n) const { return of_cells[cell] * n; }
  Vector at_side(Index cell, const Tensor& G, const Tensor& at_side, const Vector& n) const {
    return of_cells[cell] * n + IsotropicStress{by_history.moduli}(cell, at_side - G, n);
  }
};

}  // namespace

void HistoryTractions::set(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g, double part,
                           HistoryStress history) {
  set_moduli(moduli, g, history.sound, history.relaxes);
  stress_ = std::move(history.stress);
  bear_gaps(history, g);
  give_to_pressures(history, g);
  parallel_for(stress_.size(), [&](Index c) {
    if (eigenstrain_.any()) stress_[c].initial -= stress_[c].C * eigenstrain_[c];
    if (!is_plane_stress()) return;
    strain_across_[c] = strain_across(stress_[c], plane_normal());
    stress_[c] = plane_stress(stress_[c], plane_normal());
  });
  cells_.weigh(g, part);
  cells_.weigh_third_order(g);
  extrapolate_eigenstrains();
  find_initial_tractions();
  set_coefficients();
}

// Gives to the pressures the stress K tr eps + p_0 less K_s tr eps, and less what K_s had of earlier tr eps.
void HistoryTractions::give_to_pressures(const HistoryStress& history, const CellField<double>& g) {
  if (!cells_.pressure().any()) return;
  pressure_ = CellField<double>(stress_.size(), 0.0);
  parallel_for(stress_.size(), [&](Index c) {
    const double modulus = cells_.pressure().modulus(c);
    if (!(modulus > 0.0)) return;
    LinearStress& stress = stress_[c];
    const double p = trace(stress.initial) / 3.0;
    stress.initial -= p * mandel_identity();
    stress.C.topLeftCorner<3, 3>().array() -= modulus;
    pressure_[c] = p;
    if (history.volumes.size() == 0) return;
    const double by_shear = g[c] * moderate_bulk(c);
    stress.initial += by_shear * history.volumes[c].by_gradient * mandel_identity();
    pressure_[c] -= by_shear * history.volumes[c].by_flux;
  });
}

HistoryTractions::GapStiffness HistoryTractions::gap_stiffness(Index c, const HistoryStress& history) const {
  if (history.relaxes[c] == 0) return {};
  const IsotropicElasticity& sound = history.sound[c];
  const double share = jump_modulus(c) / moduli()[c].constrained_modulus();
  if (is_plane_stress()) return {share * plane_stress(sound).constrained_modulus() / sound.mu, 0.0};
  if (cells_.pressure().modulus(c) > 0.0) return {jump_modulus(c) / moduli()[c].mu, 0.0};
  return {share * 4.0 / 3.0, share};
}

// visit(place of the face in Mesh::cell_faces, the face, its normal outwards, force) of each that bears a force.
template <class Visit>
void HistoryTractions::visit_sides(Index cell, const Visit& visit) const {
  const Mesh& mesh = skeleton_.mesh;
  const FaceSkeleton::SignedForce* next = skeleton_.forces_of(cell).data();
  const std::size_t first = mesh.cell_face_offsets[cell];
  const auto faces = mesh.faces_of_cell(cell);
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (skeleton_.force_of_face[faces[k]] >= 0)
      visit(first + k, faces[k], mesh.outward_area(faces[k], cell).normalized(), *next++);
}

void HistoryTractions::bear_gaps(const HistoryStress& history, const CellField<double>& g) {
  gaps_ = {};
  initial_.assign(skeleton_.n_turns(), Vector::Zero());
  if (history.gaps.empty()) return;
  gaps_ = CellField<GapStiffness>(stress_.size());
  parallel_for(stress_.size(), [&](Index c) {
    gaps_[c] = gap_stiffness(c, history);
    if (!(gaps_[c].by_shear > 0.0)) return;
    visit_sides(c, [&](std::size_t at, Index, const Vector& n, const FaceSkeleton::SignedForce& on) {
      const GapStress& left = history.gaps[at];
      initial_[skeleton_.turn_at(on)] =
          g[c] * (momentum_faces::scale(gaps_[c].by_shear, 1.0, n, left.shear) + gaps_[c].by_bulk * left.bulk * n);
    });
  });
}

// Of the cells, beside those of the gaps, which are outwards. Normals lead outwards from P and from sides, into N.
void HistoryTractions::find_initial_tractions() {
  parallel_for(count_of(skeleton_.links), [&](Index i) {
    const momentum_faces::Link& link = skeleton_.links[i];
    const std::size_t P = FaceSkeleton::turn_P(i), N = FaceSkeleton::turn_N(i);
    initial_[P] = IsotropicTractions::initial_traction(link.P, link.n, P) + initial_[P];
    initial_[N] = IsotropicTractions::initial_traction(link.N, link.n, N) - initial_[N];
  });
  parallel_for(count_of(skeleton_.sides), [&](Index i) {
    const momentum_faces::Side& side = skeleton_.sides[i];
    const std::size_t turn = skeleton_.turn_of_side(i);
    initial_[turn] = IsotropicTractions::initial_traction(side.cell, side.n, turn) + initial_[turn];
  });
}

void HistoryTractions::find_linear(const std::vector<Vector>& u, Sweep& sweep) const {
  auto& s = static_cast<IsotropicSweep&>(sweep);
  sweep_faces(u, s, SweptStress{{stress_, of_stress()}, s.stress});
}

double HistoryTractions::free_volume_change(Index cell) const {
  const double by_history = -pressure_[cell] / cells_.pressure().modulus(cell);
  return eigenstrain_.any() ? by_history + trace(eigenstrain_[cell]) : by_history;
}

Vector HistoryTractions::own_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                                      const IsotropicSweep& s) const {
  return traction(cell, n, d, turn, s, StressByHistory{stress_, of_stress()});
}

double HistoryTractions::stress_across(Index cell, const Tensor& strain, const Sweep& sweep) const {
  if (is_plane_stress()) return 0.0;
  const double by_strain = plane_normal().dot(to_tensor(stress_[cell](to_mandel(strain))) * plane_normal());
  return by_strain + of(sweep).pressure.mean(cell);
}

void HistoryTractions::add_histories(const FaceMoves& moves, CellMechanics& result) const {
  const IsotropicSweep& sweep = of(moves.sweep);
  result.reconstructed_strain = CellField<Tensor>(stress_.size());
  if (gaps_.size() > 0) result.gaps.resize(skeleton_.mesh.cell_faces.size());
  if (gaps_.size() > 0) result.volume_changes = CellField<VolumeChanges>(stress_.size());
  parallel_for(stress_.size(), [&](Index c) {
    Tensor& strain = result.reconstructed_strain[c];
    strain = symmetric_part(with_strain_across(c, sweep.gradients[c]));
    if (const double modulus = cells_.pressure().modulus(c); modulus > 0.0) {
      const double change = sweep.pressure.mean(c) / modulus + free_volume_change(c);
      const double free = eigenstrain_.any() ? trace(eigenstrain_[c]) : 0.0;
      if (relaxes(c)) result.volume_changes[c] = {.by_gradient = strain.trace() - free, .by_flux = change - free};
      strain += (change - strain.trace()) / 3.0 * Tensor::Identity();
    }
    if (relaxes(c)) add_gaps(c, moves, result);
  });
}

void HistoryTractions::add_strain_on_side(Index cell, const Vector& n, std::size_t turn, const Sweep& sweep,
                                          FaceGap& gap) const {
  if (!varies_at(turn)) return;
  const Tensor beyond = gradient_at(cell, turn, sweep) - sweep.gradients[cell] - eigenstrain_change(turn);
  const double by_bulk = gaps_[cell].by_bulk, volume = beyond.trace(),
               of_mean = of_stress()[cell].lambda / moduli()[cell].mu;
  const Vector by_shear = beyond * n + beyond.transpose() * n + (by_bulk > 0.0 ? -2.0 / 3.0 : of_mean) * volume * n;
  gap.strain += momentum_faces::scale(1.0 / gaps_[cell].by_shear, 1.0, n, by_shear);
  if (by_bulk > 0.0) gap.along += volume / by_bulk;
}

void HistoryTractions::add_gaps(Index cell, const FaceMoves& moves, CellMechanics& result) const {
  const Mesh& mesh = skeleton_.mesh;
  visit_sides(cell, [&](std::size_t at, Index f, const Vector& n, const FaceSkeleton::SignedForce& on) {
    const std::size_t turn = skeleton_.turn_at(on);
    const Vector d = mesh.face_centre[f] - mesh.cell_centre[cell];
    const Vector move = moves.seen_from(cell, f) - moves.u[cell];
    const double h = std::abs(d.dot(n));
    FaceGap& at_face = result.gaps[at];
    at_face.strain = gap(cell, d, turn, move, moves.u, moves.sweep) * stiffer_at(turn) / h;
    at_face.along = at_face.strain.dot(n);
    at_face.volume = mesh.face_area[f].norm() * h;
    at_face.by_shear = gaps_[cell].by_shear;
    at_face.by_bulk = gaps_[cell].by_bulk;
    add_strain_on_side(cell, n, turn, moves.sweep, at_face);
  });
}

}  // namespace pfdm
