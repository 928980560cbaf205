#include "postproc/fields/frame.h"

namespace pfdm {

std::vector<NamedField> frame_fields(const Mesh& mesh, const OutputFields& output) {
  using enum Precision;
  std::vector<NamedField> fields{{"damage", &output.damage, double_precision, "1"},
                                 {"displacement", &output.displacement, double_precision, "m"},
                                 {"stress", &output.stress, single_precision, "Pa"},
                                 {"strain", &output.strain, single_precision, "1"},
                                 {"material", &mesh.region, double_precision},
                                 {"energy_density", &output.energy_density, single_precision, "J/m^3"},
                                 {"driving_energy", &output.driving_energy, single_precision, "J/m^3"}};
  for (const OutputHistory& history : output.history) {
    if (history.tensor.size() > 0)
      fields.push_back({history.name, &history.tensor, single_precision, std::string(history.unit)});
    else
      fields.push_back({history.name, &history.scalar, single_precision, std::string(history.unit)});
  }
  return fields;
}

}  // namespace pfdm
