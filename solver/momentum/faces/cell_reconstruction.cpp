#include "solver/momentum/faces/cell_reconstruction.h"

#include "solver/momentum/bending/bending_layers.h"
#include "solver/momentum/bending/slender_layers.h"
#include "solver/parallel.h"

#include <utility>

namespace pfdm {
namespace {

// Layers that bend are known by the errors of one ring (bending.md); two rings would be far stiffer in bending.
WideTriangles triangles_of(const FaceSkeleton& skeleton) {
  const Unknowns& unknowns = skeleton.unknowns;
  const bool is_plane = !unknowns.plane_normal.isZero() && !unknowns.is_axisymmetric();
  return is_plane && !is_slender_body(skeleton.mesh, unknowns) ? WideTriangles::in_plane : WideTriangles::unstable;
}

}  // namespace

CellReconstruction::CellReconstruction(const FaceSkeleton& skeleton)
    : skeleton_(skeleton),
      gradient_(skeleton.mesh, {.zone = skeleton.unknowns.zone,
                                .node_of_face = skeleton.unknowns.node_of_face,
                                .neighbour_node = skeleton.unknowns.neighbour_node,
                                .plane_normal = skeleton.unknowns.plane_normal,
                                .wide_triangles = triangles_of(skeleton),
                                .wanted = {}}),
      cubic_(skeleton.mesh, skeleton.unknowns, skeleton.sides_by_turn()),
      layers_(skeleton.mesh, skeleton.unknowns, skeleton.sides_by_turn(), skeleton.links,
              cells_with_lines(skeleton.mesh, skeleton.unknowns, LinesIn::space)),
      pressure_(skeleton.mesh, skeleton.unknowns) {
  // Cubics do not know the hoop strain. And layers that strain by themselves exchange their forces near their ends,
  // within what may be one cell: fits to smooth fields lose up to a tenth of the moment there, slopes along lines do
  // not.
  const Unknowns& unknowns = skeleton.unknowns;
  if (unknowns.is_axisymmetric() || (!unknowns.plane_normal.isZero() && unknowns.loads.eigenstrain)) take_lines_alone();
}

void CellReconstruction::relax_flat_cells() {
  relaxes_flat_cells_ = true;
  // With two layers, modes of coarse meshes were far from orthogonal.
  constexpr Index least_layers = 3;
  const Mesh& mesh = skeleton_.mesh;
  const Unknowns& unknowns = skeleton_.unknowns;
  std::vector<BendingCell> cells = cells_of_layers(mesh, unknowns);
  std::erase_if(cells, [&](const BendingCell& in) {
    return cubic_.fits(in.cell) || cells_through(mesh, unknowns, in.cell, in.across) < least_layers;
  });
  layers_ = LayerGradients(mesh, unknowns, skeleton_.sides_by_turn(), skeleton_.links, cells,
                           LayerGradients::OwnSides::surfaces);
}

CellReconstruction& CellReconstruction::take_lines_alone() {
  if (std::exchange(has_lines_alone_, true)) return *this;
  const Mesh& mesh = skeleton_.mesh;
  const Unknowns& unknowns = skeleton_.unknowns;
  cubic_ = CubicFaces();
  layers_ = LayerGradients(mesh, unknowns, skeleton_.sides_by_turn(), skeleton_.links,
                           cells_with_lines(mesh, unknowns, LinesIn::space_and_plane));
  return *this;
}

void CellReconstruction::weigh_third_order(const CellField<double>& g) {
  cubic_.weigh(g);
  layers_.weigh(g);
}

void CellReconstruction::find_gradients(const std::vector<Vector>& u, CellField<Tensor>& gradients) const {
  const Unknowns& unknowns = skeleton_.unknowns;
  const Vector &r = unknowns.radial, &across = unknowns.plane_normal;
  parallel_for(skeleton_.mesh.n_cells(), [&](Index c) {
    gradients[c] = gradient_.of(u.data(), c);
    if (unknowns.is_axisymmetric())
      gradients[c] += (r.dot(u[c]) / r.dot(skeleton_.mesh.cell_centre[c])) * across * across.transpose();
  });
}

bool CellReconstruction::is_of_third_order(std::size_t link) const {
  const Index P = skeleton_.links[link].P, N = skeleton_.links[link].N;
  return (cubic_.fits(P) && cubic_.fits(N)) || (layers_.cover(P) && layers_.cover(N)) || layers_.weighs(link);
}

}  // namespace pfdm
