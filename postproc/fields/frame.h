#pragma once
// What a frame of a fracture run shows, by the names that other tools rely on.

#include "mesh/mesh.h"
#include "postproc/fields/vtu_writer.h"
#include "solver/fracture/model/state.h"

#include <vector>

namespace pfdm {

/// damage, displacement [m], stress [Pa], strain, material, energy_density [J/m^3], driving_energy [J/m^3];
/// at finite strain also deformation_gradient, stress being Cauchy's and strain Green's;
/// besides, what the histories of the materials show, as plastic_strain.
/// Points into both arguments.
std::vector<NamedField> frame_fields(const Mesh& mesh, const OutputFields& output);

/// The cohesive interfaces of a frame, one after the other.
class InterfaceFrame {
 public:
  explicit InterfaceFrame(const std::vector<OutputInterface>& interfaces);
  /// interface (its number), opening [m], separation [m], traction [Pa], damage. Points into this.
  std::vector<NamedField> fields() const;
  const std::vector<Index>& faces() const { return faces_; }

 private:
  std::vector<Index> faces_;
  CellField<Index> number_;
  CellField<Vector> separation_, traction_;
  CellField<double> opening_, damage_;
};

}  // namespace pfdm
