#include "solver/momentum/body/box_means.h"

namespace pfdm {

BoxMeans box_means(const Mesh& mesh, const Unknowns& unknowns, const std::vector<Index>& sides,
                   const std::vector<Vector>& boundary_force, const std::vector<Vector>& u) {
  Vector centre = Vector::Zero();
  for (const Index face : sides) centre += mesh.face_centre[face] / static_cast<double>(sides.size());
  Tensor moment = Tensor::Zero(), motion = Tensor::Zero();
  double volume = 0.0;
  for (const Index face : sides) {
    const Vector from_centre = mesh.face_centre[face] - centre;
    moment += boundary_force[face - mesh.n_interior_faces()] * from_centre.transpose();
    motion += u[unknowns.node_of_face[face]] * mesh.face_area[face].transpose();
    volume += mesh.face_area[face].dot(from_centre) / 3.0;
  }
  const auto symmetric_mean = [&](const Tensor& sum) -> Tensor { return (0.5 / volume) * (sum + sum.transpose()); };
  return {symmetric_mean(moment), symmetric_mean(motion)};
}

std::vector<Index> faces_of_sides(const BoxMotion& motion) {
  std::vector<Index> faces;
  for (const PeriodicFaces& pair : motion.periodic) faces.insert(faces.end(), {pair.face, pair.image});
  if (faces.empty())
    for (const HeldFace& held : motion.held) faces.push_back(held.face);
  return faces;
}

}  // namespace pfdm
