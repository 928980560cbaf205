// An interface law that is written in Python, in the axes of its face: along the normal, and twice across it.

#include "cases/python/extension/script_law.h"

#include "physics/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace pfdm {
namespace {

class ScriptInterface final : public OwnInterfaceLaw {
 public:
  ScriptInterface(const std::string& place, const py::object& law, bool is_finite_strain)
      : place_(place), law_(place, law, 3 * most_interface_branches), is_finite_strain_(is_finite_strain) {}

  bool depends_on_rate() const override { return law_.depends_on_rate(); }

  InterfaceResponse respond(const InterfaceStrength& at, const Vector& n, const Vector& separation,
                            const InterfaceHistory& before, double duration) const override {
    Tensor axes;
    axes << n, n.unitOrthogonal(), n.cross(n.unitOrthogonal());
    const Vector parted = axes.transpose() * separation;
    InterfaceResponse response{.traction = {}, .tangent = {}, .secant = {}, .history = before};
    response.history.opening = parted[0];
    response.history.shear = separation - parted[0] * n;
    Vector traction;
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> tangent;
    {
      const ScriptLaw::Turn turn;
      const ScriptLaw::Answer answer =
          law_.respond(copy_of(parted), numbers_of_law(before), duration, at.strength, at.toughness);
      answer.read_finite(0, "traction", {3}, traction.data());
      answer.read_finite(1, "tangent", {3, 3}, tangent.data());
      std::array<double, 3 * most_interface_branches> numbers{};
      answer.read(2, "history", {static_cast<py::ssize_t>(law_.history_size())}, numbers.data());
      for (std::size_t i = 0; i < law_.history_size(); ++i) response.history.branch[i / 3][i % 3] = numbers[i];
      response.stored = answer.number(3, "stored energy");
      response.history.dissipated += answer.number(4, "dissipated energy");
    }
    if (is_finite_strain_) require_pull_along(parted, traction);
    response.traction = axes * traction;
    response.tangent = axes * tangent * axes.transpose();
    response.secant = axes * secants(parted, traction, tangent).asDiagonal() * axes.transpose();
    return response;
  }

 private:
  py::array_t<double> numbers_of_law(const InterfaceHistory& history) const {
    std::vector<double> numbers(law_.history_size());
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = history.branch[i / 3][i % 3];
    return copy_of(numbers);
  }

  /// Else the two sides, which are apart, would transfer a moment.
  void require_pull_along(const Vector& parted, const Vector& traction) const {
    constexpr double rounding = 1e-6;
    if (parted[0] <= 0.0 || parted.cross(traction).norm() <= rounding * parted.norm() * traction.norm()) return;
    throw InputError(
        fmt::format("{}: at finite strain an opened interface has to pull along its separation; for ({:.4g}, {:.4g}, "
                    "{:.4g}) m respond() returns the traction ({:.4g}, {:.4g}, {:.4g}) Pa",
                    place_, parted[0], parted[1], parted[2], traction[0], traction[1], traction[2]));
  }

  /// Along the normal and twice across; tangents where nothing has moved.
  static Vector secants(const Vector& parted, const Vector& traction, const Tensor& tangent) {
    const Vector across(0.0, parted[1], parted[2]);
    const double normal = parted[0] != 0.0 ? traction[0] / parted[0] : tangent(0, 0);
    const double shear = across.squaredNorm() > 0.0 ? traction.dot(across) / across.squaredNorm() : tangent(1, 1);
    return Vector(normal, shear, shear).cwiseMax(0.0);
  }

  std::string place_;
  ScriptLaw law_;
  bool is_finite_strain_;
};

}  // namespace

std::shared_ptr<const OwnInterfaceLaw> make_script_interface(const std::string& place, const py::object& law,
                                                             bool is_finite_strain) {
  return std::make_shared<const ScriptInterface>(place, law, is_finite_strain);
}

}  // namespace pfdm
