// A strain energy that is written in Python, as a function of F. It is asked at the stretch U = C^(1/2), as rotations
// leave an energy as it is: S = U^-1 P.

#include "cases/python/extension/script_law.h"
#include "physics/elasticity/principal.h"
#include "physics/error.h"
#include "physics/materials/hyperelastic.h"
#include "physics/materials/small_strain_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

using RowTensor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowTangent = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>;

constexpr double least_change = 1e-5;  // of differences, over the least C of the principal directions
constexpr double least_square = 1e-8;  // of a principal stretch, in that
constexpr double agreement = 1e-5;     // of derivatives that are given with differences

struct Asked {
  double energy = 0.0;
  Tensor U, P;
  std::optional<GradientTangent> A;
};

Tensor stretch_of(const Tensor& E) {
  const PrincipalAxes axes = principal_axes(E);
  const Vector stretches =
      (2.0 * axes.value).array().max(-1.0).log1p().unaryExpr([](double c) { return std::exp(0.5 * c); });
  return symmetric_part(axes.direction * stretches.asDiagonal() * axes.direction.transpose());
}

// dS/dE by A = dP/dF at F = U: dP_iJ = dF_iM S_MJ + U_iM dS_MJ.
MandelMatrix by_green_strain(const GradientTangent& A, const Tensor& U, const Tensor& S) {
  const Tensor inverse = U.inverse();
  GradientTangent C = GradientTangent::Zero();
  for (Index M = 0; M < 3; ++M)
    for (Index J = 0; J < 3; ++J)
      for (Index P = 0; P < 3; ++P)
        for (Index L = 0; L < 3; ++L)
          for (Index i = 0; i < 3; ++i)
            for (Index k = 0; k < 3; ++k)
              C(3 * M + J, 3 * P + L) +=
                  inverse(M, i) * inverse(P, k) * (A(3 * i + J, 3 * k + L) - (i == k ? S(L, J) : 0.0));
  return by_strain(C);
}

class ScriptEnergy final : public OwnStrainEnergy {
 public:
  ScriptEnergy(const std::string& place, const py::object& law) : place_(place), law_(place, law, 0, 3) {
    const Asked at_rest = ask(Tensor::Zero());
    energy_ = at_rest.energy;
    initial_stress_ = at_rest.P.trace() / 3.0;
    require_derivatives();
  }

  double initial_stress() const override { return initial_stress_; }

  ShearEnergy at(const Tensor& E) const override {
    const Asked there = ask(E);
    const Mandel S = to_mandel(second_stress(there));
    const MandelMatrix C = there.A ? by_green_strain(*there.A, there.U, to_tensor(S)) : differences(E);
    return {.energy = there.energy - energy_, .stress = S - initial_stress_ * mandel_identity(), .stiffness = C};
  }

 private:
  Asked ask(const Tensor& E) const {
    Asked asked{.U = stretch_of(E), .P = {}, .A = {}};
    RowTensor P;
    RowTangent A;
    const ScriptLaw::Turn turn;
    const RowTensor F = asked.U;
    const ScriptLaw::Answer answer = law_.respond(array_of(F));
    asked.energy = answer.any_number(0, "energy");
    answer.read(1, "stress", {3, 3}, P.data());
    asked.P = P;
    if (answer.is_none(2)) return asked;
    answer.read(2, "tangent", {3, 3, 3, 3}, A.data());
    asked.A = A;
    return asked;
  }

  static py::array_t<double> array_of(const RowTensor& F) { return py::array_t<double>({3, 3}, F.data()); }

  Tensor second_stress(const Asked& at) const {
    const Tensor S = at.U.inverse() * at.P;
    if ((S - S.transpose()).norm() > agreement * S.norm())
      throw InputError(fmt::format(
          "{}: of the stress P that respond() returns F^-1 P is not symmetric, as it is of every energy that "
          "rotations leave as it is",
          place_));
    return symmetric_part(S);
  }

  MandelMatrix differences(const Tensor& E) const {
    const double least = 1.0 + 2.0 * principal_axes(E).value.minCoeff(),
                 h = least_change * std::max(least, least_square);
    MandelMatrix C;
    for (Index k = 0; k < n_components; ++k) {
      const Tensor by = to_tensor(h * Mandel::Unit(k));
      C.col(k) = to_mandel(second_stress(ask(E + by)) - second_stress(ask(E - by))) / (2.0 * h);
    }
    return 0.5 * (C + C.transpose());
  }

  /// At some deformation in which no two stretches are equal.
  void require_derivatives() const {
    Tensor E;
    E << 0.2, 0.05, -0.03, 0.05, -0.1, 0.02, -0.03, 0.02, 0.04;
    const Asked there = ask(E);
    const Tensor S = second_stress(there);
    Mandel slopes;
    for (Index k = 0; k < n_components; ++k) {
      const Tensor by = to_tensor(least_change * Mandel::Unit(k));
      slopes[k] = (ask(E + by).energy - ask(E - by).energy) / (2.0 * least_change);
    }
    const auto refuse = [&](const char* what, const char* of, double by) {
      throw InputError(fmt::format(
          "{}: the {} that respond() returns is not the derivative of the {} by F: at F = {} they differ by "
          "{:.2g} of it",
          place_, what, of, rows_of(there.U), by));
    };
    const double wrong = (slopes - to_mandel(S)).norm() / S.norm();
    if (!(wrong <= agreement)) refuse("stress", "energy", wrong);
    if (!there.A) return;
    const MandelMatrix due = differences(E);
    const double off = (by_green_strain(*there.A, there.U, S) - due).norm() / (due.norm() + S.norm());
    if (!(off <= agreement)) refuse("tangent", "stress", off);
  }

  static std::string rows_of(const Tensor& F) {
    std::string text;
    for (Index i = 0; i < 3; ++i)
      text += fmt::format("{}[{:.4f}, {:.4f}, {:.4f}]", i == 0 ? "[" : ", ", F(i, 0), F(i, 1), F(i, 2));
    return text + "]";
  }

  std::string place_;
  ScriptLaw law_;
  double energy_ = 0.0, initial_stress_ = 0.0;  // at F = 1 [J/m^3], [Pa]
};

}  // namespace

std::shared_ptr<const Material> make_script_hyperelastic(const std::string& place, const py::object& law,
                                                         const Material& known) {
  const auto* finite = dynamic_cast<const HyperelasticMaterial*>(&known);
  if (finite == nullptr) throw InputError(fmt::format("{}: the case has no material of finite strain there", place));
  HyperelasticParameters parameters = finite->parameters();
  parameters.own = std::make_shared<const ScriptEnergy>(place, law);
  try {
    return make_own_hyperelastic(std::move(parameters));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", place, error.what()));
  }
}

}  // namespace pfdm
