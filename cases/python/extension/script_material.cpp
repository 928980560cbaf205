// A material that is written in Python. Its history: the numbers of the law, then those of `Own`.

#include "cases/python/extension/script_law.h"
#include "physics/materials/small_strain_material.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

constexpr std::size_t most_numbers = 1000, n_entries = 6;  // of a history; of an answer
constexpr double most_rounding = 1e-9;                     // of a dissipated energy, in that of stress and strain

/// Places after the law's own numbers: the strain that is not elastic, energies [J/m^3], the stress at which it flows
/// [Pa].
enum Own : std::size_t { inelastic_strain = 0, locked = 6, dissipated = 7, flow = 8, n_own = 9 };

class ScriptMaterial final : public SmallStrainMaterial {
 public:
  ScriptMaterial(const std::string& place, const py::object& law, const IsotropicElasticity& elasticity)
      : SmallStrainMaterial("written in Python", elasticity),
        law_(place, law, most_numbers, n_entries),
        flows_(py::bool_(py::getattr(law, "flows", py::bool_(false)))),
        compliance_(stiffness_matrix(elasticity).inverse()) {
    for (std::size_t i = 0; i < law_.history_size(); ++i) names_.push_back(fmt::format("history_{}", i));
  }

  bool depends_on_rate() const override { return law_.depends_on_rate(); }
  bool flows() const override { return flows_; }
  std::size_t history_size() const override { return law_.history_size() + n_own; }
  std::vector<HistoryField> history_fields() const override {
    std::vector<HistoryField> fields;
    for (std::size_t i = 0; i < names_.size(); ++i) fields.push_back({names_[i], "1", i, 1});
    fields.push_back({"inelastic_strain", "1", names_.size() + inelastic_strain, 6});
    return fields;
  }

 protected:
  Response update_strain(const Step& step, std::span<double> history) const override {
    const std::size_t n = law_.history_size();
    Response response{.stress = {}, .tangent = {}};
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> tangent;
    {
      const ScriptLaw::Turn turn;
      const ScriptLaw::Answer answer =
          law_.respond(copy_of(step.from), copy_of(step.to), copy_of(step.history.first(n)), step.duration);
      answer.read(0, "stress", {6}, response.stress.data());
      answer.read(1, "tangent", {6, 6}, tangent.data());
      answer.read(2, "history", {static_cast<py::ssize_t>(n)}, history.data());
      response.tangent = tangent;
      response.solved = response.stress.allFinite() && response.tangent.allFinite();
      if (!response.solved) return response;  // of such an answer the increment is cut, whatever its energies are
      history[n + locked] = answer.number(3, "locked energy");
      const double rounding = most_rounding * response.stress.norm() * step.to.norm();
      history[n + dissipated] = step.history[n + dissipated] + answer.dissipated(4, rounding);
      history[n + flow] = answer.number(5, "flow stress");
    }
    Eigen::Map<Mandel>(history.data() + n + inelastic_strain) = step.to - compliance_ * response.stress;
    return response;
  }

  Inelastic inelastic(std::span<const double> history) const override {
    const std::span<const double> own = history.subspan(law_.history_size());
    return {.strain = Eigen::Map<const Mandel>(own.data() + inelastic_strain),
            .locked = own[locked],
            .dissipated = own[dissipated]};
  }
  double flow_stress(std::span<const double> history, double) const override {
    return history[law_.history_size() + flow];
  }

 private:
  ScriptLaw law_;
  bool flows_;
  MandelMatrix compliance_;  // [1/Pa]
  std::vector<std::string> names_;
};

}  // namespace

std::shared_ptr<const Material> make_script_material(const std::string& place, const py::object& law,
                                                     const IsotropicElasticity& elasticity) {
  return std::make_shared<const ScriptMaterial>(place, law, elasticity);
}

}  // namespace pfdm
