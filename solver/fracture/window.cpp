#include "solver/fracture/window.h"

#include <algorithm>

namespace pfdm {
namespace {

// Rings of cells at the cut whose balances differ from those of the whole mesh: a force depends on the gradients of the
// next cell, which reach two cells further.
constexpr int rim = 3;

// Windows are around the cells whose damage changes by more than this share of the largest change,
constexpr double changing_share = 0.3;
// reach this number of lengths ell from them, and have at most this share of the cells.
constexpr double window_reach = 2.0, largest_window = 0.4, most_changing = 0.1;
// They iterate until the change has fallen to this share of itself, or
constexpr double window_fall = 0.1;
// to this share of the tolerance.
constexpr double window_precision = 0.5;
constexpr Index window_iterations = 10;
constexpr Index least_cells = 1500;  // of a mesh that has windows

template <class Visit>
void for_neighbours(const Mesh& mesh, Index cell, const Visit& visit) {
  for (const Index f : mesh.faces_of_cell(cell))
    if (mesh.is_interior(f)) visit(mesh.across(f, cell));
}

// Of each cell a seed that is within reach; -1 where none is.
CellField<Index> nearby_seeds(const Mesh& mesh, const std::vector<Index>& seeds, double reach) {
  CellField<Index> seed(as_size(mesh.n_cells()), -1);
  std::vector<Index> found = seeds;
  for (const Index c : seeds) seed[c] = c;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Index nearest = seed[found[i]];
    for_neighbours(mesh, found[i], [&](Index other) {
      if (seed[other] >= 0 || (mesh.cell_centre[other] - mesh.cell_centre[nearest]).norm() > reach) return;
      seed[other] = nearest;
      found.push_back(other);
    });
  }
  return seed;
}

void add_rings(const Mesh& mesh, int n_rings, std::vector<Index>& cells) {
  std::vector<bool> is_in(as_size(mesh.n_cells()), false);
  for (const Index c : cells) is_in[as_size(c)] = true;
  for (int ring = 0; ring < n_rings; ++ring)
    for (std::size_t i = 0, n = cells.size(); i < n; ++i)
      for_neighbours(mesh, cells[i], [&](Index other) {
        if (is_in[as_size(other)]) return;
        is_in[as_size(other)] = true;
        cells.push_back(other);
      });
}

FractureModel model_of_part(const FractureModel& whole, const std::vector<Index>& cells) {
  FractureModel model = whole;
  model.cells = take_out(whole.cells, cells);
  model.boundary.clear();
  model.initial_damage = {};
  return model;
}

}  // namespace

std::vector<std::vector<Index>> window_cells(const Mesh& mesh, const std::vector<Index>& seeds, double reach) {
  const CellField<Index> seed = nearby_seeds(mesh, seeds, reach);
  std::vector<bool> is_placed(as_size(mesh.n_cells()), false);
  std::vector<std::vector<Index>> parts;
  for (const Index first : seeds) {
    if (is_placed[as_size(first)]) continue;
    std::vector<Index> part{first};
    is_placed[as_size(first)] = true;
    for (std::size_t i = 0; i < part.size(); ++i)
      for_neighbours(mesh, part[i], [&](Index other) {
        if (seed[other] < 0 || is_placed[as_size(other)]) return;
        is_placed[as_size(other)] = true;
        part.push_back(other);
      });
    add_rings(mesh, rim, part);
    std::ranges::sort(part);
    parts.push_back(std::move(part));
  }
  return parts;
}

Window::Window(Staggered& whole, const LocalIterations::Turn& turn, std::vector<Index> cells,
               const StaggeredSettings& settings)
    : whole_(whole),
      turn_(turn),
      part_(part_of(whole.mesh(), std::move(cells))),
      model_(model_of_part(whole.model(), part_.cell)),
      unknowns_(unknowns_of_part(whole.unknowns(), part_)),
      staggered_(part_.mesh, model_, unknowns_, settings),
      start_(take_out_state(turn.start)),
      held_(held_cells()) {
  agree();
}

// The rings of cells next to the cut. Cells that are held in the whole mesh are held here.
CellField<char> Window::held_cells() const {
  const Mesh& mesh = part_.mesh;
  std::vector<Index> rings;
  const Patch& cut = part_.cut_patch();
  for (Index f = cut.first_face; f < cut.first_face + cut.n_faces; ++f) rings.push_back(mesh.owner[f]);
  std::ranges::sort(rings);
  rings.erase(std::unique(rings.begin(), rings.end()), rings.end());
  add_rings(mesh, rim - 1, rings);
  CellField<char> held = take_out(whole_.damage_equation().held(), part_.cell);
  if (held.size() == 0) held = CellField<char>(part_.cell.size(), 0);
  for (const Index c : rings) held[c] = 1;
  return held;
}

// Cells that are not held get no force: they would carry the residual of the whole problem also after they break.
void Window::take_away_free_forces(std::vector<Vector>& force) const {
  for (Index c = 0; c < held_.size(); ++c)
    if (held_[c] == 0) force[as_size(c)] = Vector::Zero();
  for (std::size_t k = 0; k < unknowns_.face_of_node.size(); ++k) {
    const Index f = unknowns_.face_of_node[k];
    const bool is_held =
        held_[part_.mesh.owner[f]] != 0 || (part_.mesh.is_interior(f) && held_[part_.mesh.neighbour[f]] != 0);
    if (!is_held) force[part_.cell.size() + k] = Vector::Zero();
  }
}

// The forces and sources at the cut: what the balances of the part lack against those of the whole.
void Window::agree() {
  staggered_.stiffness().take_out_memory(whole_.stiffness(), part_.cell);
  Staggered::Residuals lack = staggered_.residuals(start_, take_out_state(turn_.from), turn_.duration);
  take_away_free_forces(lack.force);
  for (Index i = 0; i < lack.damage.size(); ++i) {
    if (!staggered_.damage_equation().is_damageable(i)) continue;
    const Index c = part_.cell[as_size(i)];
    lack.damage[i] -= whole_.damage_equation().imbalance(c, turn_.from.damage, turn_.from.driving_energy[c]);
  }
  staggered_.agree({.held = held_,
                    .force = std::move(lack.force),
                    .source = std::move(lack.damage),
                    .residual_reference = whole_.momentum().residual_reference()});
}

// With the damage and the stiffness that the forces at the cut belong to: these would displace without limit a cell
// that has broken or opened since.
void Window::hold_rim_as_it_was(FractureState& here) const {
  for (Index i = 0; i < held_.size(); ++i) {
    if (held_[i] == 0) continue;
    const Index c = part_.cell[as_size(i)];
    here.damage[i] = turn_.from.damage[c];
    here.closure[i] = turn_.from.closure[c];
    if (here.tangent_strain.size() > 0) here.tangent_strain[i] = turn_.from.tangent_strain[c];
  }
}

FractureState Window::take_out_state(const FractureState& whole) const {
  FractureState here;
  here.step = whole.step;
  here.load = whole.load;
  here.damage = take_out(whole.damage, part_.cell);
  here.driving_energy = take_out(whole.driving_energy, part_.cell);
  here.closure = take_out(whole.closure, part_.cell);
  here.tangent_strain = take_out(whole.tangent_strain, part_.cell);
  here.displacement.reserve(as_size(unknowns_.n_nodes()));
  for (const Index c : part_.cell) here.displacement.push_back(whole.displacement[as_size(c)]);
  for (const Index f : unknowns_.face_of_node) {
    const Index face = part_.face[as_size(f)], node = whole_.unknowns().node_of_face[face];
    here.displacement.push_back(node >= 0 ? whole.displacement[as_size(node)] : whole_.face_displacement()[face]);
  }
  return here;
}

// Held cells keep their values in the whole mesh.
void Window::put_back_state(const FractureState& here, FractureState& whole) const {
  for (Index i = 0; i < held_.size(); ++i) {
    if (held_[i] != 0) continue;
    const Index c = part_.cell[as_size(i)];
    whole.damage[c] = here.damage[i];
    whole.driving_energy[c] = here.driving_energy[i];
    whole.closure[c] = here.closure[i];
    if (here.tangent_strain.size() > 0) whole.tangent_strain[c] = here.tangent_strain[i];
  }
  for (std::size_t i = 0; i < part_.cell.size(); ++i) whole.displacement[as_size(part_.cell[i])] = here.displacement[i];
  for (std::size_t k = 0; k < unknowns_.face_of_node.size(); ++k) {
    const Index node = whole_.unknowns().node_of_face[part_.face[as_size(unknowns_.face_of_node[k])]];
    if (node >= 0) whole.displacement[as_size(node)] = here.displacement[part_.cell.size() + k];
  }
}

StepOutcome Window::settle(FractureState& state) {
  FractureState here = take_out_state(state);
  hold_rim_as_it_was(here);
  const StepOutcome outcome = staggered_.alternate(start_, here, {.duration = turn_.duration});
  if (outcome.failed) return outcome;
  whole_.stiffness().put_back_memory(staggered_.stiffness(), part_.cell);
  put_back_state(here, state);
  return outcome;
}

bool Windows::iterate(Staggered& whole, const Turn& turn, FractureState& state, StepOutcome& outcome) {
  const Mesh& mesh = whole.mesh();
  const Index n = mesh.n_cells();
  if (n < least_cells) return false;
  const auto lap = whole.clock().lap("windows");
  StaggeredSettings settings = whole.settings();
  const double least = std::max(changing_share * turn.change, window_precision * settings.damage_tolerance);
  std::vector<Index> changing;
  double ell = 0.0;
  for (Index c = 0; c < n; ++c) {
    if (!(std::abs(turn.answer[c] - turn.from.damage[c]) > least)) continue;
    changing.push_back(c);
    ell = std::max(ell, whole.model().in_cell(mesh, c).ell);
  }
  if (double(changing.size()) > most_changing * double(n)) return false;
  settings.damage_tolerance = std::max(window_precision * settings.damage_tolerance, window_fall * turn.change);
  settings.energy_tolerance = std::numeric_limits<double>::infinity();
  settings.maximum_iterations = window_iterations;
  bool any = false;
  for (std::vector<Index>& cells : window_cells(mesh, changing, window_reach * ell)) {
    const double share = double(cells.size()) / double(n);
    if (share > largest_window) continue;
    any = true;
    const StepOutcome inner = Window(whole, turn, std::move(cells), settings).settle(state);
    outcome.window_iterations += share * double(inner.iterations);
  }
  return any;
}

}  // namespace pfdm
