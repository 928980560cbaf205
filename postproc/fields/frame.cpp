#include "postproc/fields/frame.h"

namespace pfdm {
namespace {

template <class T>
void append(const CellField<T>& part, CellField<T>& whole) {
  whole.values().insert(whole.values().end(), part.begin(), part.end());
}

}  // namespace

InterfaceFrame::InterfaceFrame(const std::vector<OutputInterface>& interfaces) {
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const OutputInterface& one = interfaces[i];
    faces_.insert(faces_.end(), one.faces.begin(), one.faces.end());
    append(CellField<Index>(one.faces.size(), static_cast<Index>(i)), number_);
    append(one.separation, separation_);
    append(one.traction, traction_);
    append(one.opening, opening_);
    append(one.damage, damage_);
  }
}

std::vector<NamedField> InterfaceFrame::fields() const {
  using enum Precision;
  return {{"interface", &number_, double_precision},
          {"opening", &opening_, double_precision, "m"},
          {"separation", &separation_, double_precision, "m"},
          {"traction", &traction_, double_precision, "Pa"},
          {"damage", &damage_, double_precision, "1"}};
}

std::vector<NamedField> frame_fields(const Mesh& mesh, const OutputFields& output) {
  using enum Precision;
  std::vector<NamedField> fields{{"damage", &output.damage, double_precision, "1"},
                                 {"displacement", &output.displacement, double_precision, "m"},
                                 {"stress", &output.stress, single_precision, "Pa"},
                                 {"strain", &output.strain, single_precision, "1"},
                                 {"material", &mesh.region, double_precision},
                                 {"energy_density", &output.energy_density, single_precision, "J/m^3"},
                                 {"driving_energy", &output.driving_energy, single_precision, "J/m^3"}};
  if (output.deformation_gradient.size() > 0)
    fields.push_back({"deformation_gradient", &output.deformation_gradient, single_precision, "1", true});
  for (const OutputHistory& history : output.history) {
    if (history.tensor.size() > 0)
      fields.push_back({history.name, &history.tensor, single_precision, std::string(history.unit)});
    else
      fields.push_back({history.name, &history.scalar, single_precision, std::string(history.unit)});
  }
  return fields;
}

}  // namespace pfdm
