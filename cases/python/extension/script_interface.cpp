// An interface law that is written in Python, in the axes of its face: along the normal, and twice across it.

#include "cases/python/extension/script_law.h"

#include <algorithm>
#include <array>

namespace pfdm {
namespace {

class ScriptInterface final : public OwnInterfaceLaw {
 public:
  ScriptInterface(const std::string& place, const py::object& law) : law_(place, law, 3 * most_interface_branches) {}

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

  /// Along the normal and twice across; tangents where nothing has moved.
  static Vector secants(const Vector& parted, const Vector& traction, const Tensor& tangent) {
    const Vector across(0.0, parted[1], parted[2]);
    const double normal = parted[0] != 0.0 ? traction[0] / parted[0] : tangent(0, 0);
    const double shear = across.squaredNorm() > 0.0 ? traction.dot(across) / across.squaredNorm() : tangent(1, 1);
    return Vector(normal, shear, shear).cwiseMax(0.0);
  }

  ScriptLaw law_;
};

}  // namespace

std::shared_ptr<const OwnInterfaceLaw> make_script_interface(const std::string& place, const py::object& law) {
  return std::make_shared<const ScriptInterface>(place, law);
}

}  // namespace pfdm
