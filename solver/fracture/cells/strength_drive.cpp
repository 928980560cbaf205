#include "solver/fracture/cells/strength_drive.h"

#include "solver/parallel.h"

#include <utility>

namespace pfdm {
namespace {

class StrengthCells final : public BodyStrength {
 public:
  StrengthCells(const Mesh& mesh, const FractureModel& model, const CellStiffness& stiffness)
      : mesh_(mesh), model_(model), stiffness_(stiffness) {}

  void begin(const FractureState& start, const std::function<Seen()>& at_start) override {
    const Seen seen = at_start();
    before_ = drive(seen.mechanics, start, seen.psi_plus);
  }

  void see(const CellMechanics& mechanics, const FractureState& state, const CellField<double>& psi_plus) override {
    now_ = drive(mechanics, state, psi_plus);
  }

  void give(double scale, const std::function<void(CellField<double>)>& take) const override {
    CellField<double> force(mesh_.n_cells());
    parallel_for(mesh_.n_cells(), [&](Index c) { force[c] = scale * now_.force[c]; });
    take(std::move(force));
  }

  double opening(Index cell, double psi_plus, double scale) const override {
    return psi_plus - scale * scale * now_.closed[cell];
  }

  bool is_closed(Index cell) const override { return now_.closed[cell] > 0.0; }

  double dissipation(const CellField<double>& d_from, const CellField<double>& d_to) const override {
    const auto mean = [](const CellField<double>& a, const CellField<double>& b, Index c) {
      return 0.5 * (a[c] + b[c]);
    };
    return parallel_sum(mesh_.n_cells(), [&](Index c) {
      if (d_from[c] == d_to[c]) return 0.0;
      const Degradation& degradation = model_.degradation_of(model_.in_cell(mesh_, c));
      const double g_from = degradation.g(d_from[c]), g_to = degradation.g(d_to[c]);
      const double g_middle = degradation.g(0.5 * (d_from[c] + d_to[c]));
      const double integral = (d_to[c] - d_from[c]) * (g_from + 4.0 * g_middle + g_to) / 6.0;  // exact: quadratic g
      const double lost = (1.0 - model_.residual_stiffness) * (g_to - g_from);
      return -mesh_.cell_volume[c] *
             (integral * mean(before_.force, now_.force, c) + lost * mean(before_.closed, now_.closed, c));
    });
  }

 private:
  // Zero in cells without a strength model [J/m^3].
  struct Drive {
    CellField<double> force;   // c
    CellField<double> closed;  // psi_plus - psi_open
  };

  Drive drive(const CellMechanics& mechanics, const FractureState& state, const CellField<double>& psi_plus) const {
    const std::size_t n = mesh_.n_cells();
    Drive drive{.force = CellField<double>(n, 0.0), .closed = CellField<double>(n, 0.0)};
    parallel_for(mesh_.n_cells(), [&](Index c) {
      const RegionModel& region = model_.in_cell(mesh_, c);
      if (!region.strength.is_chosen() || !region.damageable) return;
      const Tensor sigma = stiffness_.undamaged_stress(c, mechanics, state);
      drive.force[c] = region.strength.force(sigma);
      if (!StrengthModel::opens(sigma)) drive.closed[c] = psi_plus[c];
    });
    return drive;
  }

  const Mesh& mesh_;
  const FractureModel& model_;
  const CellStiffness& stiffness_;
  Drive before_, now_;
};

}  // namespace

std::unique_ptr<BodyStrength> make_body_strength(const Mesh& mesh, const FractureModel& model,
                                                 const CellStiffness& stiffness) {
  if (model.has_strength()) return std::make_unique<StrengthCells>(mesh, model, stiffness);
  return std::make_unique<BodyStrength>();
}

}  // namespace pfdm
