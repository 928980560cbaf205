// Pressures of nearly incompressible cells at finite strain (finite_tractions.h): the moved faces that they act on, and
// their equations V J(q) = volume of the moved cell, linearised.

#include "solver/momentum/finite_tractions.h"
#include "solver/parallel.h"

namespace pfdm {

using momentum_faces::Link;
using momentum_faces::Side;

// Whether the pressure acts on the polygon of a side; if not, on cof F N.
bool FiniteTractions::has_polygon(std::size_t i) const {
  const Side& side = skeleton_.sides[i];
  const CellShape shape = skeleton_.mesh.shape[side.cell];
  if (bonded_.number(i) >= 0) return false;
  const bool joins = skeleton_.second_side_of_node[skeleton_.number_of(side.node)] >= 0;
  return joins || (shape != CellShape::hexahedron && shape != CellShape::wedge);
}

void FiniteTractions::place_areas() {
  for (std::size_t i = 0; i < skeleton_.sides.size(); ++i) {
    const Side& side = skeleton_.sides[i];
    if (!has_polygon(i))
      moved_faces_.set_area(skeleton_.links.size() + i, cofactor_at(side.cell, skeleton_.turn_of_side(i)) * side.n);
  }
}

void FiniteTractions::find_area_changes(FiniteSweep& s) const {
  parallel_for(static_cast<Index>(s.area_changes.size()), [&](Index i) {
    const std::size_t n_links = skeleton_.links.size(), k = as_size(i);
    if (k < n_links || has_polygon(k - n_links)) {
      s.area_changes[k] = moved_faces_.area_change(k, s.corner_moves);
      return;
    }
    const Side& side = skeleton_.sides[k - n_links];
    const Index b = bonded_.number(k - n_links);
    s.area_changes[k] = (b < 0 ? cofactor_change(F_[side.cell], s.gradients[side.cell])
                               : cofactor_change(bonded_states_[as_size(b)].F, s.bonded[as_size(b)])) *
                        side.n;
  });
}

// Of the displacements of faces, those of links being in s.moved.
void FiniteTractions::find_fluxes(const std::vector<Vector>& u, FiniteSweep& s) const {
  parallel_for(static_cast<Index>(s.flux.size()), [&](Index i) {
    const std::size_t k = as_size(i), n_links = skeleton_.links.size();
    const Vector& moved = k < n_links ? s.moved[k] : u[as_size(skeleton_.sides[k - n_links].node)];
    s.flux[k] = moved_faces_.flux(k, s.corner_moves, moved, s.area_changes[k]);
  });
}

void FiniteTractions::balance_pressures(const std::vector<Vector>& u, Sweep& sweep, std::vector<Vector>& out) const {
  const std::vector<Index>& cells = skeleton_.unknowns.pressure_cells;
  if (cells.empty()) return;
  FiniteSweep& s = of(sweep);
  find_fluxes(u, s);
  parallel_for(static_cast<Index>(cells.size()), [&](Index k) {
    const Index c = cells[as_size(k)];
    const double slope = volume_rows_[as_size(k)].slope;
    const double rate = skeleton_.mesh.cell_volume[c] * slope * s.pressure.mean(c) - skeleton_.out_of(c, s.flux);
    out[as_size(skeleton_.unknowns.n_nodes() + k)] = rate * Vector::UnitX();
  });
}

// J - 1 of the cells with a pressure [-], of faces that have moved by u_face, in the order of the forces.
CellField<double> FiniteTractions::swept_changes(const std::vector<Vector>& u_face, FiniteSweep& s) const {
  parallel_for(static_cast<Index>(s.flux.size()), [&](Index i) {
    s.flux[as_size(i)] = moved_faces_.swept(as_size(i), s.corner_moves, u_face[as_size(i)]);
  });
  CellField<double> change(as_size(skeleton_.mesh.n_cells()), 0.0);
  for (const Index c : skeleton_.unknowns.pressure_cells)
    change[c] = skeleton_.out_of(c, s.flux) / skeleton_.mesh.cell_volume[c];
  return change;
}

void FiniteTractions::find_initial_volumes(const std::vector<Vector>& u, FiniteSweep& s) {
  const std::vector<Index>& cells = skeleton_.unknowns.pressure_cells;
  volume_rows_.resize(cells.size());
  find_linear(u, s);
  std::vector<Vector> u_face(skeleton_.n_forces());
  const std::size_t n_links = skeleton_.links.size();
  parallel_for(static_cast<Index>(n_links), [&](Index index) {
    const std::size_t i = as_size(index);
    const Vector jump = face_turns_[FaceSkeleton::turn_N(i)].initial - face_turns_[FaceSkeleton::turn_P(i)].initial;
    u_face[i] = s.moved[i] + link_tensors_[i].softness * jump;
  });
  for (std::size_t i = 0; i < skeleton_.sides.size(); ++i) u_face[n_links + i] = u[as_size(skeleton_.sides[i].node)];
  moved_faces_.follow(u_face);
  const CellField<double> change = swept_changes(u_face, s);
  find_fluxes(u, s);
  parallel_for(static_cast<Index>(cells.size()), [&](Index k) {
    const Index c = cells[as_size(k)];
    const VolumeAt volume = laws_[c].volume(pressure_at_[c]);
    const double linear = skeleton_.out_of(c, s.flux) / skeleton_.mesh.cell_volume[c];
    volume_rows_[as_size(k)] = {.slope = volume.slope,
                                .initial = volume.change - volume.slope * pressure_at_[c] - change[c] + linear};
  });
}

void FiniteTractions::take_away_constant_volumes(std::vector<Vector>& load) const {
  const Unknowns& unknowns = skeleton_.unknowns;
  for (std::size_t k = 0; k < volume_rows_.size(); ++k)
    load[as_size(unknowns.n_nodes()) + k] -=
        skeleton_.mesh.cell_volume[unknowns.pressure_cells[k]] * volume_rows_[k].initial * Vector::UnitX();
}

FiniteTractions::PressureRow FiniteTractions::pressure_row(std::size_t k) const {
  const Index c = skeleton_.unknowns.pressure_cells[k];
  return {.slope = volume_rows_[k].slope, .modulus = laws_[c].face.constrained_modulus()};
}

void FiniteTractions::find_pressure_forces(const CellField<double>& q, Sweep& s) const {
  const auto n_links = static_cast<Index>(skeleton_.links.size());
  parallel_for(n_links, [&](Index index) {
    const std::size_t i = as_size(index);
    const Link& link = skeleton_.links[i];
    const Vector& area = moved_faces_.area(i);
    s.force[i] = link.area * (q[link.N] * area + link_tensors_[i].weight * ((q[link.P] - q[link.N]) * area));
  });
  parallel_for(static_cast<Index>(skeleton_.sides.size()), [&](Index i) {
    const Side& side = skeleton_.sides[as_size(i)];
    s.force[as_size(n_links + i)] = (side.area * q[side.cell]) * moved_faces_.area(as_size(n_links + i));
  });
  parallel_for(s.sector_stress.size(), [&](Index c) { s.sector_stress[c] = q[c] * moved_faces_.section(c); });
}

// In the order of the forces.
std::vector<Vector> FiniteTractions::moves_of_faces(const std::vector<Vector>& u,
                                                    const FaceField<Vector>& u_face) const {
  std::vector<Vector> moves;
  for (const Link& link : skeleton_.links) moves.push_back(u_face[link.face]);
  for (const Side& side : skeleton_.sides) moves.push_back(u[as_size(side.node)]);
  return moves;
}

// Area vector [m^2] of a face with a pressure, outwards from the cell.
Vector FiniteTractions::moved_area(const FaceSkeleton::SignedForce& on) const {
  const auto i = as_size(on.force);
  const std::size_t n_links = skeleton_.links.size();
  const double area = i < n_links ? skeleton_.links[i].area : skeleton_.sides[i - n_links].area;
  return (on.sign * area) * moved_faces_.area(i);
}

}  // namespace pfdm
