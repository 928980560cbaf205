// Forces, tractions and displacements of faces and patches (momentum.h).

#include "solver/momentum/momentum.h"
#include "solver/parallel.h"

namespace pfdm {

SpareSweeps::Lease MomentumOperator::forces_of(const std::vector<Vector>& u) const {
  auto forces = sweep();
  tractions_->find(u, *forces);
  return forces;
}

std::vector<Vector> MomentumOperator::boundary_forces(const std::vector<Vector>& u) const {
  const auto forces = forces_of(u);
  const Index first = skeleton_->mesh.n_interior_faces(), n = skeleton_->mesh.n_faces();
  std::vector<Vector> boundary(n - first, Vector::Zero());
  for (Index f = first; f < n; ++f)
    if (const Index force = skeleton_->force_of_face[f]; force >= 0) boundary[f - first] = forces->force[force];
  return boundary;
}

std::vector<std::pair<Index, Vector>> MomentumOperator::interface_tractions(const std::vector<Vector>& u) const {
  const auto forces = forces_of(u);
  const Mesh& mesh = skeleton_->mesh;
  const Unknowns& unknowns = skeleton_->unknowns;
  std::vector<std::pair<Index, Vector>> tractions;
  for (std::size_t k = 0; k < unknowns.face_of_node.size(); ++k)
    if (const Index f = unknowns.face_of_node[k];
        mesh.is_interior(f) && skeleton_->number_of(unknowns.node_of_face[f]) == k)
      tractions.emplace_back(f, forces->force[skeleton_->force_of_face[f]] / mesh.face_area[f].norm());
  return tractions;
}

FaceField<Vector> MomentumOperator::tractions(const std::vector<Vector>& u) const {
  const auto forces = forces_of(u);
  const Mesh& mesh = skeleton_->mesh;
  FaceField<Vector> traction(mesh.n_faces());
  parallel_for(mesh.n_faces(), [&](Index f) {
    if (const Index force = skeleton_->force_of_face[f]; force >= 0)
      traction[f] = forces->force[force] / mesh.face_area[f].norm();
  });
  return traction;
}

std::vector<Vector> MomentumOperator::patch_displacements(const std::vector<Vector>& u) const {
  const Mesh& mesh = skeleton_->mesh;
  std::vector<Vector> mean(mesh.patches.size(), Vector::Zero());
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    const Patch& patch = mesh.patches[p];
    double area = 0.0;
    for (Index f = patch.first_face; f < patch.first_face + patch.n_faces; ++f) {
      const Index node = skeleton_->unknowns.node_of_face[f];
      if (node < 0) continue;
      mean[p] += mesh.face_area[f].norm() * u[node];
      area += mesh.face_area[f].norm();
    }
    if (area > 0.0) mean[p] /= area;
  }
  return mean;
}

std::vector<MomentumOperator::SplitSides> MomentumOperator::split_sides(const std::vector<Vector>& u) const {
  const auto forces = forces_of(u);
  std::vector<SplitSides> all(skeleton_->split_faces.size());
  parallel_for(count_of(all), [&](Index k) {
    const auto of_node = [&](Index node, Vector& traction, Tensor& give) {
      const std::size_t i = skeleton_->first_side_of_node[skeleton_->number_of(node)];
      traction = forces->force[skeleton_->links.size() + i] / skeleton_->sides[i].area;
      give = tractions_->softness_of_side(i);
    };
    SplitSides& sides = all[k];
    of_node(skeleton_->split_faces[k].node, sides.traction, sides.give);
    of_node(skeleton_->split_faces[k].beyond, sides.traction_beyond, sides.give_beyond);
  });
  return all;
}

}  // namespace pfdm
