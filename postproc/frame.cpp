#include "postproc/frame.h"

namespace pfdm {

std::vector<NamedField> frame_fields(const Mesh& mesh, const OutputFields& output) {
  using enum Precision;
  return {{"damage", &output.damage, double_precision},
          {"displacement", &output.displacement, double_precision},
          {"stress", &output.stress, single_precision},
          {"strain", &output.strain, single_precision},
          {"material", &mesh.region, double_precision},
          {"energy_density", &output.energy_density, single_precision},
          {"driving_energy", &output.driving_energy, single_precision}};
}

}  // namespace pfdm
