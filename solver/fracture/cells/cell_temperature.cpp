#include "solver/fracture/cells/cell_temperature.h"

#include "physics/materials/prony.h"
#include "physics/materials/prony_response.h"
#include "solver/parallel.h"

#include <algorithm>
#include <cmath>

namespace pfdm {

CellTemperature::CellTemperature(const Mesh& mesh, const FractureModel& model) : mesh_(mesh), model_(model) {
  for (Index c = 0; c < mesh.n_cells() && !shifts_; ++c) shifts_ = shift(c) != nullptr;
}

double CellTemperature::temperature(Index cell, double load, double rise) const {
  const BodyLoads& loads = model_.loads;
  const double change = loads.temperature ? loads.temperature(mesh_.cell_centre[cell], load) : 0.0;
  return loads.start_temperature + change + rise;
}

CellField<double> CellTemperature::factors(const FractureState& from, double load) const {
  if (!shifts_) return {};
  const CellField<double>& rise = from.heat.rise;
  const bool feels = model_.heat && model_.heat->is_two_way;
  CellField<double> factor(mesh_.n_cells(), 1.0);
  parallel_for(mesh_.n_cells(), [&](Index c) {
    if (const TemperatureShift* by = shift(c))
      factor[c] = by->factor(temperature(c, 0.5 * (from.load + load), feels ? rise[c] : 0.0));
  });
  return factor;
}

double CellTemperature::change_of_moduli(const CellField<double>& before, const CellField<double>& now, double load,
                                         double angular_frequency) const {
  if (!shifts_) return 0.0;
  return parallel_max(mesh_.n_cells(), [&](Index c) {
    const TemperatureShift* by = shift(c);
    if (by == nullptr) return 0.0;
    const RelaxationModulus modulus = shear_modulus(*model_.in_cell(mesh_, c).material->relaxing());
    const auto at = [&](double rise) {
      return complex_modulus(modulus, angular_frequency * by->factor(temperature(c, load, rise)));
    };
    const std::complex<double> then = at(before[c]), today = at(now[c]);
    const auto change = [](double from, double to) { return from > 0.0 ? std::abs(to / from - 1.0) : 0.0; };
    return std::max(change(then.real(), today.real()), change(then.imag(), today.imag()));
  });
}

}  // namespace pfdm
