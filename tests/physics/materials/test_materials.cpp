// Materials with a history: what holds for each of them, and J2 plasticity against closed forms.

#include "physics/error.h"
#include "physics/materials/endochronic_material.h"
#include "physics/materials/j2_plasticity.h"
#include "physics/materials/prony.h"
#include "physics/materials/small_strain_material.h"
#include "tests/physics/endochronic_laws.h"
#include "tests/physics/physics_checks.h"

#include <memory>
#include <vector>

namespace pfdm::this_file {
namespace {

const IsotropicElasticity steel = from_young_poisson(210e9, 0.3);

std::vector<std::shared_ptr<const Material>> examples() {
  return {
      make_endochronic_material(one_term_law()),
      make_endochronic_material(three_term_law()),
      make_prony({.relaxed = steel, .shear = {{100e9, 8000.0}, {40e9, 300.0}}}),
      make_prony({.relaxed = steel, .shear = {{100e9, 8000.0}}, .bulk = {{60e9, 3000.0}}, .drive = PronyDrive::stored}),
      make_j2_plasticity(steel, {.yield_stress = 250e6}),
      make_j2_plasticity(steel, {.yield_stress = 250e6, .isotropic_hardening = 2e9}),
      make_j2_plasticity(steel, {.yield_stress = 250e6, .isotropic_hardening = 1e9, .kinematic_hardening = 20e9})};
}

/// A material point on its way.
class Point {
 public:
  explicit Point(const Material& material) : material_(material), history_(material.history_size()) {
    material.start(history_);
  }

  MaterialResponse go_to(const Tensor& H) {
    std::vector<double> next(history_.size());
    MaterialResponse response = material_.update({H_, H, 1.0, history_}, next);
    EXPECT_TRUE(response.solved);
    H_ = H;
    history_ = next;
    return response;
  }
  MaterialResponse look_at(const Tensor& H) const {
    std::vector<double> next(history_.size());
    return material_.update({H_, H, 1.0, history_}, next);
  }
  const Tensor& H() const { return H_; }
  const std::vector<double>& history() const { return history_; }
  MaterialEnergy energy() const { return material_.energy(H_, history_, energy_split("none")); }
  Tensor stress() const { return material_.stress(H_, history_); }

 private:
  const Material& material_;
  Tensor H_ = Tensor::Zero();
  std::vector<double> history_;
};

// Steps of random directions, rotations among them, as far as plastic flow.
void for_points(const std::function<void(Point&, const Tensor& next)>& check) {
  for (const auto& material : examples()) {
    SCOPED_TRACE(material->name());
    RandomTensors random;
    Point point(*material);
    for (int i = 0; i < 12; ++i) {
      Tensor next = point.H() + random.symmetric(2e-3);
      next(0, 1) += 1e-3, next(1, 0) -= 1e-3;
      check(point, next);
    }
  }
}

TEST(Material, TangentIsTheSlopeOfTheStress) {
  for_points([](Point& point, const Tensor& next) {
    const MaterialResponse response = point.look_at(next);
    constexpr double step = 1e-8;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Tensor change = Tensor::Zero();
        change(i, j) = step;
        const Tensor slope = (point.look_at(next + change).stress - point.look_at(next - change).stress) / (2.0 * step);
        const Eigen::Matrix<double, 9, 1> column = response.tangent.col(3 * i + j);
        const Tensor tangent = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(column.data());
        EXPECT_LE((tangent - slope).norm(), 2e-6 * response.tangent.norm());
      }
    point.go_to(next);
  });
}

TEST(Material, TheStressIsThatOfTheLastStep) {
  for_points([](Point& point, const Tensor& next) {
    const MaterialResponse response = point.go_to(next);
    EXPECT_LE((point.stress() - response.stress).norm(), 1e-12 * response.stress.norm());
  });
}

TEST(Material, WorkIsStoredOrHeat) {
  for (const auto& material : examples()) {
    SCOPED_TRACE(material->name());
    Point point(*material);
    RandomTensors random;
    double work = 0.0;
    constexpr int n = 4000;
    for (int leg = 0; leg < 3; ++leg) {
      const Tensor change = random.symmetric(3e-3) / n;
      for (int i = 0; i < n; ++i) {
        const Tensor before = point.stress();
        work += 0.5 * contract(before + point.go_to(point.H() + change).stress, change);
      }
    }
    const MaterialEnergy energy = point.energy();
    EXPECT_GT(energy.dissipated, 0.1 * work);
    EXPECT_NEAR(energy.driving + energy.idle + energy.dissipated, work, 1e-3 * work);
  }
}

TEST(Material, FieldsLieWithinTheHistory) {
  for (const auto& material : examples())
    for (const HistoryField& field : material->history_fields()) {
      EXPECT_TRUE(field.size == 1 || field.size == 6) << field.name;
      EXPECT_LE(field.first + field.size, material->history_size()) << field.name;
    }
}

Tensor shear(double gamma) {
  Tensor H = Tensor::Zero();
  H(0, 1) = gamma;
  return H;
}

// Beyond yield at Y/sqrt(3) the tangent modulus is mu h/(3 mu + h), h = K + H, whatever the size of the steps; it
// yields backwards at -tau with isotropic, at tau - 2 Y/sqrt(3) with kinematic hardening.
TEST(J2Plasticity, SimpleShearAndItsReversal) {
  constexpr double Y = 250e6, h = 3e9, gamma = 0.02;
  const double mu = steel.mu, tau_0 = Y / std::sqrt(3.0), mu_t = mu * h / (3.0 * mu + h);
  const double tau = tau_0 + mu_t * (gamma - tau_0 / mu);
  for (const double share : {0.0, 0.4, 1.0}) {
    const auto material = make_j2_plasticity(
        steel, {.yield_stress = Y, .isotropic_hardening = share * h, .kinematic_hardening = (1.0 - share) * h});
    Point point(*material);
    for (const double step : {0.1, 0.5, 1.0})
      if (step < 1.0) point.go_to(shear(step * gamma));
    EXPECT_NEAR(point.go_to(shear(gamma)).stress(0, 1), tau, 1e-9 * tau);
    const double radius = tau_0 + share * (tau - tau_0);  // of the yield surface, in shear
    const double back = gamma - 2.0 * radius / mu;        // where it yields again
    EXPECT_NEAR(point.go_to(shear(back + 1e-9)).stress(0, 1), tau - 2.0 * radius, 1e-3 * tau_0);
    const double far = back - 0.01;
    EXPECT_NEAR(point.go_to(shear(far)).stress(0, 1), tau - 2.0 * radius - mu_t * 0.01, 1e-9 * tau);
  }
}

// Equivalent plastic strain and heat of monotonic tension in uniaxial strain: only the volume goes on to resist.
TEST(J2Plasticity, ConfinedTensionOfAPerfectlyPlasticBody) {
  constexpr double Y = 250e6, strain = 0.01;
  const auto material = make_j2_plasticity(steel, {.yield_stress = Y});
  Point point(*material);
  Tensor H = Tensor::Zero();
  H(0, 0) = strain;
  const Tensor sigma = point.go_to(H).stress;
  const double K = steel.bulk_modulus();
  EXPECT_NEAR(sigma(0, 0), K * strain + 2.0 / 3.0 * Y, 1e-9 * K * strain);
  EXPECT_NEAR(sigma(1, 1), K * strain - 1.0 / 3.0 * Y, 1e-9 * K * strain);
  const double p = 2.0 / 3.0 * strain - Y / (3.0 * steel.mu);  // e_11 = 2/3 eps = s_11/(2 mu) + p
  EXPECT_NEAR(point.history()[6], p, 1e-12);
  EXPECT_NEAR(point.energy().dissipated, Y * p, 1e-9 * Y * p);
  EXPECT_EQ(point.energy().locked, 0.0);
}

TEST(J2Plasticity, RefusesWhatMakesNoSense) {
  EXPECT_THROW(make_j2_plasticity(steel, {.yield_stress = 0.0}), InputError);
  EXPECT_THROW(make_j2_plasticity(steel, {.yield_stress = 1.0, .isotropic_hardening = -1.0}), InputError);
  EXPECT_THROW(make_j2_plasticity(steel, {.yield_stress = 1.0, .kinematic_hardening = -1.0}), InputError);
  std::vector<double> from(7), to(7);
  const auto material = make_j2_plasticity(steel, {.yield_stress = 1e6});
  const Tensor nothing = Tensor::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(material->update({Tensor::Zero(), nothing, 1.0, from}, to).solved);
}

}  // namespace
}  // namespace pfdm::this_file
