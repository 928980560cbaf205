#include "solver/momentum/history_tractions.h"

#include "solver/momentum/isotropic_sweep.h"

namespace pfdm {
namespace {

struct StressByHistory {
  const CellField<LinearStress>& stress;
  Vector operator()(Index cell, const Tensor& G, const Vector& n) const {
    return to_tensor(stress[cell].C * to_mandel(symmetric_part(G))) * n;
  }
};

}  // namespace

void HistoryTractions::set(const CellField<IsotropicElasticity>& moduli, const CellField<double>& g, double part,
                           CellField<LinearStress> stress) {
  set_moduli(moduli, g);
  stress_ = std::move(stress);
  parallel_for(stress_.size(), [&](Index c) {
    if (eigenstrain_.any()) stress_[c].initial -= stress_[c].C * eigenstrain_[c];
    if (!is_plane_stress()) return;
    strain_across_[c] = strain_across(stress_[c], plane_normal());
    stress_[c] = plane_stress(stress_[c], plane_normal());
  });
  cells_.weigh(g, part);
  cells_.leave_out_third_order();
  set_coefficients();
}

void HistoryTractions::find_linear(const std::vector<Vector>& u, Sweep& sweep) const {
  sweep_faces(u, static_cast<IsotropicSweep&>(sweep), StressByHistory{stress_});
}

Vector HistoryTractions::own_traction(Index cell, const Vector& n, const Vector& d, std::size_t turn,
                                      const IsotropicSweep& s) const {
  return traction(cell, n, d, turn, s, StressByHistory{stress_});
}

double HistoryTractions::stress_across(Index cell, const Tensor& strain, const Sweep&) const {
  if (is_plane_stress()) return 0.0;
  return plane_normal().dot(to_tensor(stress_[cell](to_mandel(strain))) * plane_normal());
}

void HistoryTractions::add_reconstructed_strain(const Sweep& sweep, CellMechanics& result) const {
  result.reconstructed_strain = CellField<Tensor>(as_size(stress_.size()));
  parallel_for(stress_.size(), [&](Index c) {
    result.reconstructed_strain[c] = symmetric_part(with_strain_across(c, sweep.gradients[c]));
  });
}

}  // namespace pfdm
