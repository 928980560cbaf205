#include "solver/fracture/heat_combinations.h"

#include "physics/error.h"
#include "physics/materials/temperature_shift.h"
#include "solver/momentum/body/cell_eigenstrain.h"

#include <fmt/format.h>

namespace pfdm {

// Time goes on, with a step's heat in it, and each cell conducts.
void require_heat(const Mesh& mesh, const FractureModel& m, const LoadingSettings& loading) {
  if (m.motion.any()) throw InputError("heat ([heat]) cannot be combined with a box that follows a mean strain");
  if (loading.controls_dissipation())
    throw InputError(
        "heat ([heat]) cannot be combined with dissipation control (loading.maximum_dissipation): the load may "
        "decrease, time cannot");
  if (!(loading.duration > 0.0))
    throw InputError("heat ([heat]) requires loading.duration, the time in which t grows by 1, as in \"1 s\"");
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const RegionModel& region = m.in_cell(mesh, c);
    if (!(region.conductivity > 0.0 && region.specific_heat > 0.0 && region.density > 0.0))
      throw InputError(fmt::format(
          "heat ([heat]) requires conductivity, specific_heat and density of each material; region \"{}\" has {} "
          "W/(m K), {} J/(kg K) and {} kg/m^3",
          mesh.region_names[mesh.region[c]], region.conductivity, region.specific_heat, region.density));
  }
}

void require_temperature(const Mesh& mesh, const FractureModel& m, const Unknowns& unknowns) {
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const TemperatureShift* shift = m.in_cell(mesh, c).temperature_shift();
    if (shift == nullptr) continue;
    const auto refuse = [&](const std::string& what) {
      throw InputError(fmt::format("region \"{}\": its times depend on the temperature (temperature_shift): {}",
                                   mesh.region_names[mesh.region[c]], what));
    };
    if (m.loads.start_temperature == 0.0)
      refuse("give the temperature at which the body starts, as in start_temperature = \"20 degC\" in [loads]");
    if (!(m.loads.start_temperature > shift->least_temperature()))
      refuse(fmt::format("start_temperature is {:.5g} K, its law holds above {:.5g} K, reference less C2",
                         m.loads.start_temperature, shift->least_temperature()));
  }
  const Vector& across = unknowns.plane_normal;
  if (!unknowns.loads.expansion || across.isZero()) return;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (shears_across(to_tensor(unknowns.loads.expansion(mesh, c)), across))
      throw InputError(
          fmt::format("the expansion of region \"{}\" shears across a mesh one cell thick, which does not "
                      "follow the heat of coupling = \"two_way\"",
                      mesh.region_names[mesh.region[c]]));
}

}  // namespace pfdm
