#include "postproc/frame.h"

namespace pfdm {

std::vector<NamedField> frame_fields(const Mesh& mesh, const OutputFields& output) {
  using enum Precision;
  std::vector<NamedField> fields{{"damage", &output.damage, double_precision},
                                 {"displacement", &output.displacement, double_precision},
                                 {"stress", &output.stress, single_precision},
                                 {"strain", &output.strain, single_precision},
                                 {"material", &mesh.region, double_precision},
                                 {"energy_density", &output.energy_density, single_precision},
                                 {"driving_energy", &output.driving_energy, single_precision}};
  if (output.plastic_strain.size() > 0) {
    fields.push_back({"plastic_strain", &output.plastic_strain, single_precision});
    fields.push_back({"plastic_path_length", &output.plastic_path_length, single_precision});
  }
  return fields;
}

}  // namespace pfdm
