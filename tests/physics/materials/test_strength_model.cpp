#include "physics/error.h"
#include "physics/materials/strength_model.h"
#include "tests/physics/physics_checks.h"

#include <cmath>
#include <numbers>

namespace pfdm::this_file {
namespace {

constexpr double E = 70e9, nu = 0.22, Gc = 10.0, ts = 40e6, hs = 27.8e6, sqrt3 = std::numbers::sqrt3;
constexpr double K = E / (3.0 * (1.0 - 2.0 * nu)), mu = E / (2.0 * (1.0 + nu));
constexpr double characteristic = E * Gc / (ts * ts);  // length [m]

StrengthData glass(double ell) {
  return {.elasticity = from_young_poisson(E, nu), .tensile = ts, .hydrostatic = hs, .Gc = Gc, .ell = ell};
}

StrengthModel model(double ell) {
  const StrengthLaw& law = strength_law("strength");
  return {law, glass(ell), law.delta(glass(ell), 0.0)};
}

// Of sound AT1: what drives damage less what resists, over the latter; W by the invariants, not by the strain.
double excess(const StrengthModel& on, const Tensor& sigma) {
  const Tensor s = deviator(sigma);
  const double I1 = sigma.trace(), J2 = 0.5 * contract(s, s), W = J2 / (2.0 * mu) + I1 * I1 / (18.0 * K);
  const double resistance = 3.0 / 8.0 * on.delta() * Gc / on.data().ell;
  return ((StrengthModel::opens(sigma) ? 2.0 * W : 0.0) + on.force(sigma)) / resistance - 1.0;
}

TEST(StrengthModel, IsExactInUniaxialAndHydrostaticTensionWhateverTheLength) {
  for (const double ell : {0.3, 0.1, 0.01}) {
    const StrengthModel on = model(ell * characteristic);
    EXPECT_NEAR(excess(on, Vector(ts, 0.0, 0.0).asDiagonal()), 0.0, 1e-12);
    EXPECT_NEAR(excess(on, hs * Tensor::Identity()), 0.0, 1e-12);
  }
}

// Drucker, Prager, written out by the strengths.
double drucker_prager(const Tensor& sigma) {
  const Tensor s = deviator(sigma);
  return std::sqrt(0.5 * contract(s, s)) + ts / (sqrt3 * (3.0 * hs - ts)) * sigma.trace();
}
constexpr double drucker_prager_limit = sqrt3 * ts * hs / (3.0 * hs - ts);

// The factor of a stress at which a sound cell begins to break, by bisection; infinite if it never does.
double breaking_factor(const StrengthModel& on, const Tensor& sigma) {
  double low = 0.0, high = 100.0;
  if (excess(on, high * sigma) < 0.0) return std::numeric_limits<double>::infinity();
  for (int i = 0; i < 100; ++i) (excess(on, 0.5 * (low + high) * sigma) < 0.0 ? low : high) = 0.5 * (low + high);
  return low;
}

// Largest relative distance from the surface along 200 directions of stress (a spiral on the sphere of principal
// stresses) that meet it at no more than three times the tensile strength.
double distance_from_surface(double ell) {
  const StrengthModel on = model(ell);
  double largest = 0.0;
  int n_met = 0;
  for (int i = 0; i < 200; ++i) {
    const double z = -1.0 + (i + 0.5) / 100.0, turn = 2.399963 * i, r = std::sqrt(1.0 - z * z);
    const Tensor direction = Vector(r * std::cos(turn), r * std::sin(turn), z).asDiagonal();
    const double due = drucker_prager_limit / drucker_prager(direction);
    if (!(due > 0.0 && due < 3.0 * ts)) continue;
    ++n_met;
    const Tensor on_surface = due * direction;
    EXPECT_NEAR(on.surface(on_surface), 1.0, 1e-12);
    largest = std::max(largest, std::abs(breaking_factor(on, on_surface) - 1.0));
  }
  EXPECT_GT(n_met, 100);
  return largest;
}

// Between its two strengths the model's surface is off by O(ell^2): the energy, which the coefficients make up for in
// two directions of stress alone, against delta Gc/ell.
TEST(StrengthModel, TendsToTheDruckerPragerSurface) {
  double coarser = distance_from_surface(0.1 * characteristic);
  EXPECT_LT(coarser, 0.3);
  for (const double ell : {0.05, 0.025, 0.0125}) {
    const double finer = distance_from_surface(ell * characteristic);
    EXPECT_LT(finer, 0.4 * coarser) << ell;
    coarser = finer;
  }
  EXPECT_LT(coarser, 0.006);
}

// By the formula of the paper in numbers (SciPy): E = 70 GPa, nu = 0.22, ell = 80 um.
TEST(StrengthModel, DeltaIsThatOfThePaper) {
  const StrengthLaw& law = strength_law("strength");
  EXPECT_NEAR(law.delta(glass(80e-6), 0.0), 1.2923629, 1e-6);
  EXPECT_NEAR(law.delta(glass(80e-6), 15e-6), 1.1745151, 1e-6);
  EXPECT_NEAR(largest_length(glass(80e-6)), 1.640625e-4, 1e-12);
}

TEST(StrengthModel, HydrostaticStrengthIsThatOfTheCompressiveOne) {
  StrengthData data = glass(1e-5);
  data.hydrostatic = hydrostatic_strength(ts, 1000e6);
  EXPECT_NEAR(data.hydrostatic, 27.8e6, 0.03e6);
  const StrengthModel on(strength_law("strength"), data, 1.0);
  EXPECT_NEAR(on.surface(-1000e6 * Vector::UnitX() * Vector::UnitX().transpose()), 1.0, 1e-12);
}

TEST(StrengthModel, RefusesStrengthsThatNoSurfaceHas) {
  StrengthData data = glass(1e-5);
  data.hydrostatic = ts / 3.0;
  EXPECT_THROW(StrengthModel(strength_law("strength"), data, 1.0), InputError);
  EXPECT_THROW(hydrostatic_strength(ts, ts), InputError);
}

TEST(StrengthModel, UnknownNamesAreAnsweredWithThoseThereAre) {
  expect_unknown_name_is_answered(strength_laws(), strength_law);
}

}  // namespace
}  // namespace pfdm::this_file
