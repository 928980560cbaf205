#include "solver/fracture/body_heat.h"

#include "physics/error.h"
#include "solver/fracture/conducted_heat.h"

namespace pfdm {

std::vector<HeatRow> BodyHeat::warm_by_cycles(const HeatState&, double, Index, CellField<double>&) {
  throw ComputationError("heat: there is no whole cycle whose heat could warm the body");
}

std::unique_ptr<BodyHeat> make_body_heat(const Mesh& mesh, const FractureModel& model, const Vector& plane_normal) {
  if (model.heat) return std::make_unique<ConductedHeat>(mesh, model, plane_normal);
  return std::make_unique<BodyHeat>();
}

}  // namespace pfdm
