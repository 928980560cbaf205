// Hyperelastic laws: what holds for each of them, and closed forms that are worked out here.

#include "physics/materials/hyperelastic.h"
#include "tests/physics/physics_checks.h"

#include <cmath>
#include <memory>
#include <vector>

namespace pfdm::this_file {
namespace {

using Made = std::shared_ptr<const HyperelasticMaterial>;

const IsotropicElasticity rubber = from_young_poisson(1.5e6, 0.45);

HyperelasticParameters parameters_of(std::string_view law) {
  HyperelasticParameters p{.elasticity = rubber};
  if (law == "mooney_rivlin") p.second_invariant = 0.3;
  if (law == "ogden") p.shares = {0.7, 0.5, -0.2}, p.exponents = {1.3, 5.0, -2.0};
  if (law == "lopez_pamies") p.shares = {0.6, 0.4}, p.exponents = {0.7, 2.1};
  return p;
}

std::vector<Made> examples() {
  std::vector<Made> all;
  for (const HyperelasticLaw& law : hyperelastic_laws())
    for (const VolumetricForm form : {VolumetricForm::quadratic, VolumetricForm::logarithmic}) {
      HyperelasticParameters p = parameters_of(law.name);
      p.volumetric = form;
      all.push_back(std::make_shared<const HyperelasticMaterial>(law, p));
    }
  return all;
}

// Stretches from 0.6 to 1.8 under some rotation.
Tensor some_gradient(RandomTensors& random) {
  const Tensor Q = random.rotation(), R = random.rotation();
  Vector stretch;
  for (double& l : stretch.reshaped()) l = 1.2 + random.symmetric(0.6)(0, 0);
  return R * Q * stretch.asDiagonal() * Q.transpose() - Tensor::Identity();
}

void for_gradients(const std::function<void(const HyperelasticMaterial&, const Tensor& H, RandomTensors&)>& check) {
  for (const Made& material : examples()) {
    SCOPED_TRACE(material->name());
    RandomTensors random;
    for (int i = 0; i < 20; ++i) check(*material, some_gradient(random), random);
  }
}

using Part = PotentialAt (HyperelasticMaterial::*)(const Tensor&) const;

TEST(Hyperelastic, StressAndTangentAreSlopesOfTheEnergy) {
  constexpr double step = 1e-5;
  for (const Part part : {&HyperelasticMaterial::potential, &HyperelasticMaterial::compression})
    for_gradients([&](const HyperelasticMaterial& material, const Tensor& H, RandomTensors&) {
      const PotentialAt at = (material.*part)(H);
      const double scale = rubber.constrained_modulus();
      for (Index k = 0; k < 3; ++k)
        for (Index L = 0; L < 3; ++L) {
          Tensor change = Tensor::Zero();
          change(k, L) = step;
          const PotentialAt above = (material.*part)(H + change), below = (material.*part)(H - change);
          EXPECT_NEAR(at.stress(k, L), (above.energy - below.energy) / (2.0 * step), 1e-7 * scale);
          const Components slope = to_components((above.stress - below.stress) / (2.0 * step));
          EXPECT_LE((at.tangent.col(3 * k + L) - slope).norm(), 1e-7 * std::max(scale, at.tangent.norm()));
        }
      EXPECT_LE((at.tangent - at.tangent.transpose()).norm(), 1e-12 * scale);
    });
}

TEST(Hyperelastic, RotationsTurnTheStress) {
  for (const Part part : {&HyperelasticMaterial::potential, &HyperelasticMaterial::compression})
    for_gradients([&](const HyperelasticMaterial& material, const Tensor& H, RandomTensors& random) {
      const PotentialAt at = (material.*part)(H);
      const Tensor R = random.rotation();
      const Tensor F = Tensor::Identity() + H;
      const PotentialAt turned = (material.*part)(R * F - Tensor::Identity());
      const PotentialAt isotropic = (material.*part)(F * R - Tensor::Identity());
      const double scale = rubber.constrained_modulus();
      EXPECT_NEAR(turned.energy, at.energy, 1e-12 * scale);
      EXPECT_NEAR(isotropic.energy, at.energy, 1e-12 * scale);
      EXPECT_LE((turned.stress - R * at.stress).norm(), 1e-12 * scale);
      EXPECT_LE((isotropic.stress - at.stress * R).norm(), 1e-12 * scale);
    });
}

// Also at strains so small that 1 + strain loses their digits.
TEST(Hyperelastic, SmallStrainsAreLinearElastic) {
  for (const Made& material : examples()) {
    SCOPED_TRACE(material->name());
    RandomTensors random;
    for (const double size : {1e-6, 1e-10}) {
      Tensor H = random.symmetric(size);
      H(0, 1) += size, H(1, 0) -= size;
      const Tensor expected = stress(rubber, symmetric_part(H));
      const PotentialAt at = material->potential(H);
      EXPECT_LE((at.stress - expected).norm(), 20.0 * size * expected.norm() + 1e-11 * expected.norm());
    }
    const GradientTangent A = material->potential(Tensor::Zero()).tangent;
    for (Index k = 0; k < 3; ++k)
      for (Index L = 0; L < 3; ++L) {
        const Tensor column = stress(rubber, symmetric_part(Vector::Unit(k) * Vector::Unit(L).transpose()));
        EXPECT_LE((A.col(3 * k + L) - to_components(column)).norm(), 1e-10 * rubber.constrained_modulus());
      }
  }
}

TEST(Hyperelastic, ADilationIsKeptUnderCompressionOnly) {
  for_gradients([](const HyperelasticMaterial& material, const Tensor& H, RandomTensors&) {
    const double J = 1.0 + volume_change(H), whole = material.potential(H).energy;
    const double kept = material.compression(H).energy;
    const Tensor dilation = (std::cbrt(J) - 1.0) * Tensor::Identity();
    if (J >= 1.0) {
      EXPECT_EQ(kept, 0.0);
    } else {
      EXPECT_NEAR(kept, material.potential(dilation).energy, 1e-9 * rubber.mu);
      // Saint Venant-Kirchhoff's is not convex: a change of shape may release energy under compression.
      if (material.name() != "saint_venant_kirchhoff") {
        EXPECT_LE(kept, whole + 1e-9 * rubber.mu);
      }
    }
    const MaterialEnergy split = material.energy(H, {}, energy_split("volumetric_deviatoric"));
    EXPECT_NEAR(split.driving, whole - kept, 1e-9 * rubber.mu);
    EXPECT_NEAR(material.energy(H, {}, energy_split("none")).driving, whole, 1e-9 * rubber.mu);
  });
}

TEST(Hyperelastic, AnInvertedElementHasNoSolution) {
  const Tensor H = -2.0 * Vector::UnitX() * Vector::UnitX().transpose();
  for (const Made& material : examples()) EXPECT_FALSE(material->update({H, H, 0.0, {}}, {}).solved);
}

// Principal nominal stresses P_i = dW/dl_i, from W as a function of the stretches in the words of its author, by hand.
struct Stretched {
  Vector stretch, stress;
};

Stretched principal(std::string_view law, const Vector& l, VolumetricForm form) {
  const HyperelasticParameters p = parameters_of(law);
  const double mu = rubber.mu, J = l.prod(), I1 = l.squaredNorm();
  Vector P = Vector::Zero();
  double Lambda = rubber.lambda;
  for (Index i = 0; i < 3; ++i) {
    if (law == "neo_hookean") P[i] = mu * l[i] - mu / l[i];
    if (law == "mooney_rivlin") {
      const double mu_01 = 0.3 * mu, mu_10 = 0.7 * mu;
      P[i] = mu_10 * l[i] + mu_01 * l[i] * (I1 - l[i] * l[i]) - (mu_10 + 2.0 * mu_01) / l[i];
      Lambda = rubber.lambda - 2.0 * mu_01;
    }
    if (law == "ogden")
      for (std::size_t k = 0; k < 3; ++k)
        P[i] += 2.0 * p.shares[k] * mu / p.exponents[k] * (std::pow(l[i], p.exponents[k] - 1.0) - 1.0 / l[i]);
    if (law == "lopez_pamies") {
      Lambda = rubber.lambda;
      for (std::size_t k = 0; k < 2; ++k) {
        P[i] += p.shares[k] * mu * (std::pow(I1 / 3.0, p.exponents[k] - 1.0) * l[i] - 1.0 / l[i]);
        Lambda -= 2.0 / 3.0 * p.shares[k] * mu * (p.exponents[k] - 1.0);
      }
    }
    if (law == "saint_venant_kirchhoff") {
      P[i] = l[i] * (rubber.lambda * 0.5 * (I1 - 3.0) + mu * (l[i] * l[i] - 1.0));
      Lambda = 0.0;
    }
  }
  const double slope = form == VolumetricForm::quadratic ? Lambda * (J - 1.0) : 0.5 * Lambda * (J - 1.0 / J);
  for (Index i = 0; i < 3; ++i) P[i] += slope * J / l[i];
  return {l, P};
}

// Uniaxial strain and stress, equal biaxial tension, pure shear and dilation, as principal stretches.
TEST(Hyperelastic, PrincipalStressesAreThoseByHand) {
  for (const HyperelasticLaw& law : hyperelastic_laws())
    for (const VolumetricForm form : {VolumetricForm::quadratic, VolumetricForm::logarithmic}) {
      SCOPED_TRACE(law.name);
      HyperelasticParameters p = parameters_of(law.name);
      p.volumetric = form;
      const HyperelasticMaterial material(law, p);
      for (const Vector& l : {Vector(1.7, 1.0, 1.0), Vector(2.0, 0.72, 0.72), Vector(1.4, 1.4, 0.53),
                              Vector(1.5, 1.0, 0.67), Vector(1.1, 1.1, 1.1), Vector(0.8, 0.9, 1.25)}) {
        const Stretched expected = principal(law.name, l, form);
        const Tensor P = material.potential(Tensor(l.asDiagonal()) - Tensor::Identity()).stress;
        const Tensor difference = P - Tensor(expected.stress.asDiagonal());
        EXPECT_LE(difference.norm(), 1e-11 * expected.stress.norm());
      }
    }
}

// A neo-Hookean polyurethane (Kamarei et al. 2026) with a smaller Lambda: stretches and energies at a nominal stress of
// 0.3 MPa in uniaxial and of 1.0 MPa in hydrostatic tension, found by bisection of
//   mu (l - 1/l) + Lambda (J - 1) J/l   along each principal axis.
TEST(Hyperelastic, UniaxialAndHydrostaticTensionByBisection) {
  const IsotropicElasticity pu{.lambda = 20e6, .mu = 0.52e6};
  const HyperelasticMaterial material(hyperelastic_law("neo_hookean"), {.elasticity = pu});
  const auto by_hand = [&](double l, double J) { return pu.mu * (l - 1.0 / l) + pu.lambda * (J - 1.0) * J / l; };
  const auto root = [](const std::function<double(double)>& rising) {
    double low = 0.5, high = 2.0;
    for (int i = 0; i < 100; ++i) (rising(0.5 * (low + high)) > 0.0 ? high : low) = 0.5 * (low + high);
    return low;
  };
  const auto across = [&](double along) { return root([&](double l) { return by_hand(l, along * l * l); }); };
  const double along = root([&](double l) { return by_hand(l, l * across(l) * across(l)) - 0.3e6; });
  const Vector uniaxial(along, across(along), across(along));
  const double l = root([&](double x) { return by_hand(x, x * x * x) - 1.0e6; });
  for (const auto& [stretch, stress] : {std::pair(uniaxial, 0.3e6), std::pair(Vector(l, l, l), 1.0e6)}) {
    const PotentialAt at = material.potential(Tensor(stretch.asDiagonal()) - Tensor::Identity());
    const double J = stretch.prod();
    const double W =
        0.5 * pu.mu * (stretch.squaredNorm() - 3.0) - pu.mu * std::log(J) + 0.5 * pu.lambda * (J - 1.0) * (J - 1.0);
    EXPECT_NEAR(at.stress(0, 0), stress, 1e-6 * stress);
    EXPECT_NEAR(at.energy, W, 1e-9 * W);
  }
}

// P_12 = mu gamma in simple shear of a neo-Hookean body, whatever U is.
TEST(Hyperelastic, SimpleShearOfNeoHookean) {
  const HyperelasticMaterial material(hyperelastic_law("neo_hookean"), {.elasticity = rubber});
  for (const double gamma : {0.1, 1.0, 3.0}) {
    const Tensor H = gamma * Vector::UnitX() * Vector::UnitY().transpose();
    EXPECT_NEAR(material.potential(H).stress(0, 1), rubber.mu * gamma, 1e-9 * rubber.mu);
  }
}

/// The shear part of a law of the table, as one of one's own.
class Repeated final : public OwnStrainEnergy {
 public:
  Repeated(const HyperelasticLaw& law, HyperelasticParameters p) : law_(law), p_(std::move(p)) {}
  double initial_stress() const override { return law_.initial_stress(p_); }
  ShearEnergy at(const Tensor& E) const override { return law_.shear(p_, E); }

 private:
  const HyperelasticLaw& law_;
  HyperelasticParameters p_;
};

HyperelasticParameters repeating(const HyperelasticLaw& law, const IsotropicElasticity& of_energy, double nu) {
  HyperelasticParameters p = parameters_of(law.name);
  p.elasticity = of_energy;
  return {.elasticity = from_young_poisson(rubber.young_modulus(), nu),
          .own = std::make_shared<const Repeated>(law, p)};
}

TEST(Hyperelastic, EnergiesOfOnesOwnAreLawsLikeOthers) {
  RandomTensors random;
  for (const HyperelasticLaw& law : hyperelastic_laws()) {
    const HyperelasticMaterial own(own_hyperelastic_law(), repeating(law, rubber, rubber.poisson_ratio()));
    const HyperelasticMaterial known(law, parameters_of(law.name));
    for (int i = 0; i < 20; ++i) {
      const Tensor H = some_gradient(random);
      const PotentialAt a = own.potential(H), b = known.potential(H);
      EXPECT_NEAR(a.energy, b.energy, 1e-9 * rubber.mu) << law.name;
      EXPECT_LE((a.stress - b.stress).norm(), 1e-9 * b.stress.norm()) << law.name;
      EXPECT_LE((a.tangent - b.tangent).norm(), 1e-9 * b.tangent.norm()) << law.name;
    }
  }
}

TEST(Hyperelastic, EnergiesOfOnesOwnHaveTheModuliOfTheElasticity) {
  using ::testing::HasSubstr;
  const auto answer = [](std::string_view law, double nu_of_energy, double nu) {
    const IsotropicElasticity of_energy = from_young_poisson(rubber.young_modulus(), nu_of_energy);
    return message_of<InputError>([&] { make_own_hyperelastic(repeating(hyperelastic_law(law), of_energy, nu)); });
  };
  EXPECT_THAT(answer("neo_hookean", 0.40, 0.45), HasSubstr("they must be the same"));
  EXPECT_THAT(answer("saint_venant_kirchhoff", 0.48, 0.48), HasSubstr("has a volume energy of its own"));
  const auto own = make_own_hyperelastic(
      repeating(hyperelastic_law("neo_hookean"), from_young_poisson(rubber.young_modulus(), 0.4999), 0.4999));
  const auto& material = dynamic_cast<const HyperelasticMaterial&>(*own);
  EXPECT_GT(material.pressure_modulus(), 0.99 * own->elasticity().lambda);
}

TEST(Hyperelastic, WrongParametersAreRefused) {
  const auto answer = [](std::string_view law, const HyperelasticParameters& p) {
    return message_of<InputError>([&] { make_hyperelastic(law, p); });
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(answer("saint_venant_kirchhoff", {.elasticity = from_young_poisson(1e6, 0.4999)}),
              HasSubstr("at most 0.47 is allowed"));
  EXPECT_THAT(answer("ogden", {.elasticity = rubber}), HasSubstr("needs exponents and shares"));
  EXPECT_THAT(answer("ogden", {.elasticity = rubber, .shares = {0.5, 0.4}, .exponents = {1.0, 2.0}}),
              HasSubstr("sum to 0.9"));
  EXPECT_THAT(answer("ogden", {.elasticity = rubber, .shares = {1.0}, .exponents = {0.0}}), HasSubstr("not zero"));
  EXPECT_THAT(answer("ogden", {.elasticity = rubber, .shares = {1.0}, .exponents = {1.0, 2.0}}),
              HasSubstr("1 shares for 2 exponents"));
  EXPECT_THAT(answer("mooney_rivlin", {.elasticity = rubber, .second_invariant = 1.2}), HasSubstr("between 0 and 1"));
  EXPECT_THAT(answer("mooney_rivlin", {.elasticity = from_young_poisson(1e6, 0.1), .second_invariant = 0.9}),
              HasSubstr("larger Poisson's ratio"));
  const std::string names = message_of<InputError>([] { hyperelastic_law("no_such_law"); });
  for (const HyperelasticLaw& law : hyperelastic_laws()) EXPECT_THAT(names, HasSubstr(std::string(law.name)));
}

}  // namespace
}  // namespace pfdm::this_file
