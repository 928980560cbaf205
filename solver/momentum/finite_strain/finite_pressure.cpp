#include "solver/momentum/finite_strain/finite_pressure.h"

#include "solver/parallel.h"

namespace pfdm {

using momentum_faces::Side;

FinitePressure::FinitePressure(const FaceSkeleton& skeleton, const CellPressure& pressure, const FiniteStates& states)
    : skeleton_(skeleton),
      pressure_(pressure),
      states_(states),
      moved_faces_(skeleton.mesh, skeleton.unknowns, skeleton.places_by_force(), states.bonded()),
      pressure_at_(skeleton.mesh.n_cells(), 0.0),
      rows_(skeleton.unknowns.pressure_cells.size()) {}

void FinitePressure::prepare(FinitePressureSweep& s) const {
  s.pressure = pressure_.field();
  s.on_sides.resize(states_.n_own());
  if (!any()) return;
  s.moved.resize(skeleton_.n_forces());
  s.area_changes.resize(skeleton_.n_forces());
  s.flux.resize(skeleton_.n_forces());
}

void FinitePressure::read(const std::vector<Vector>& u, const CellField<Tensor>& gradients,
                          FinitePressureSweep& s) const {
  if (any()) pressure_.read(u, s.pressure);
  const BondedSides& bonded = states_.bonded();
  parallel_for(count_of(bonded), [&](Index k) {
    const Index c = skeleton_.sides[bonded.side(k)].cell;
    s.on_sides[k] = bonded.gradient(k, u, gradients[c]);
  });
  moved_faces_.move({u, gradients, s.on_sides}, s.corner_moves);
}

void FinitePressure::linearise(const FinitePressureSweep& s) {
  if (!any()) return;
  moved_faces_.place(s.corner_moves);
  parallel_for(pressure_at_.size(), [&](Index c) { pressure_at_[c] = s.pressure.mean(c); });
  for (std::size_t i = 0; i < skeleton_.sides.size(); ++i) {
    const Side& side = skeleton_.sides[i];
    if (!has_polygon(i))
      moved_faces_.set_area(skeleton_.links.size() + i,
                            states_.cofactor_at(side.cell, skeleton_.turn_of_side(i)) * side.n);
  }
}

// Whether the pressure acts on the polygon of a side; if not, on cof F N.
bool FinitePressure::has_polygon(std::size_t i) const {
  const Side& side = skeleton_.sides[i];
  const CellShape shape = skeleton_.mesh.shape[side.cell];
  if (states_.bonded().number(i) >= 0) return false;
  const Unknowns& unknowns = skeleton_.unknowns;
  const bool joins = skeleton_.second_side_of_node[skeleton_.number_of(side.node)] >= 0;
  const bool is_held = unknowns.free_within(side.node).isZero() || unknowns.glides(side.node, side.n);
  return joins || is_held || (shape != CellShape::hexahedron && shape != CellShape::wedge);
}

void FinitePressure::find_area_changes(const CellField<Tensor>& gradients, FinitePressureSweep& s) const {
  parallel_for(count_of(s.area_changes), [&](Index i) {
    const std::size_t n_links = skeleton_.links.size(), k = as_size(i);
    if (k < n_links || has_polygon(k - n_links)) {
      s.area_changes[k] = moved_faces_.area_change(k, s.corner_moves);
      return;
    }
    const Side& side = skeleton_.sides[k - n_links];
    const Index own = states_.own(k - n_links);
    s.area_changes[k] = (own < 0 ? cofactor_change(states_.deformation()[side.cell], gradients[side.cell])
                                 : cofactor_change(states_.deformation_on(own), s.on_sides[own])) *
                        side.n;
  });
}

void FinitePressure::find_fluxes(FinitePressureSweep& s) const {
  parallel_for(count_of(s.flux),
               [&](Index k) { s.flux[k] = moved_faces_.flux(k, s.corner_moves, s.moved[k], s.area_changes[k]); });
}

void FinitePressure::balance(FinitePressureSweep& s, std::vector<Vector>& out) const {
  const std::vector<Index>& cells = skeleton_.unknowns.pressure_cells;
  if (cells.empty()) return;
  find_fluxes(s);
  parallel_for(count_of(cells), [&](Index k) {
    const Index c = cells[k];
    const double slope = rows_[k].slope;
    const double rate = skeleton_.mesh.cell_volume[c] * slope * s.pressure.mean(c) - skeleton_.out_of(c, s.flux);
    out[skeleton_.unknowns.n_nodes() + k] = rate * Vector::UnitX();
  });
}

CellField<double> FinitePressure::swept_changes(const std::vector<Vector>& u_face, FinitePressureSweep& s) const {
  parallel_for(count_of(s.flux), [&](Index i) { s.flux[i] = moved_faces_.swept(i, s.corner_moves, u_face[i]); });
  CellField<double> change(skeleton_.mesh.n_cells(), 0.0);
  for (const Index c : skeleton_.unknowns.pressure_cells)
    change[c] = skeleton_.out_of(c, s.flux) / skeleton_.mesh.cell_volume[c];
  return change;
}

void FinitePressure::linearise_volumes(const std::vector<Vector>& u_face, FinitePressureSweep& s) {
  const std::vector<Index>& cells = skeleton_.unknowns.pressure_cells;
  moved_faces_.follow(u_face);
  const CellField<double> change = swept_changes(u_face, s);
  find_fluxes(s);
  parallel_for(count_of(cells), [&](Index k) {
    const Index c = cells[k];
    const VolumeAt volume = states_.law(c).volume(pressure_at_[c]);
    const double linear = skeleton_.out_of(c, s.flux) / skeleton_.mesh.cell_volume[c];
    rows_[k] = {.slope = volume.slope, .initial = volume.change - volume.slope * pressure_at_[c] - change[c] + linear};
  });
}

void FinitePressure::take_away_constant(std::vector<Vector>& load) const {
  const Unknowns& unknowns = skeleton_.unknowns;
  for (std::size_t k = 0; k < rows_.size(); ++k)
    load[unknowns.n_nodes() + k] -=
        skeleton_.mesh.cell_volume[unknowns.pressure_cells[k]] * rows_[k].initial * Vector::UnitX();
}

Vector FinitePressure::moved_area(const FaceSkeleton::SignedForce& on) const {
  const std::size_t i = on.force;
  const std::size_t n_links = skeleton_.links.size();
  const double area = i < n_links ? skeleton_.links[i].area : skeleton_.sides[i - n_links].area;
  return (on.sign * area) * moved_faces_.area(i);
}

}  // namespace pfdm
