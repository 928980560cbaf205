#pragma once
// Finite differences, random tensors and error messages for the tests of the laws.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <span>
#include <string>

#include "physics/error.h"
#include "physics/tensor.h"

namespace pfdm {

/// Central difference of a function of one number.
inline double slope(const std::function<double(double)>& f, double x, double step = 1e-5) {
  return (f(x + step) - f(x - step)) / (2.0 * step);
}

/// The symmetric tensor d f / d eps of a function of a symmetric tensor, by central differences.
inline Tensor slope(const std::function<double(const Tensor&)>& f, const Tensor& eps, double step) {
  Tensor result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Tensor change = Tensor::Zero();
      change(i, j) += 0.5 * step;
      change(j, i) += 0.5 * step;
      result(i, j) = (f(eps + change) - f(eps - change)) / (2.0 * step);
    }
  return result;
}

/// Entries uniform in [-size, size].
class RandomTensors {
 public:
  Tensor symmetric(double size) {
    Tensor a;
    for (double& entry : a.reshaped()) entry = size * uniform_(engine_);
    return symmetric_part(a);
  }

  Tensor rotation() {
    Eigen::Vector4d q;
    for (double& entry : q.reshaped()) entry = uniform_(engine_);
    return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
  }

  Vector direction() { return rotation().col(2); }

 private:
  std::mt19937 engine_{20240611};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

/// The message of the error that the function must throw.
template <class Error, class Function>
std::string message_of(Function&& function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

/// Asking for a name that is not in the table must name those that are.
template <class Law, class Find>
void expect_unknown_name_is_answered(std::span<const Law> table, const Find& find) {
  const std::string message = message_of<InputError>([&] { find("no_such_law"); });
  EXPECT_THAT(message, ::testing::HasSubstr("no_such_law"));
  for (const Law& law : table) {
    EXPECT_THAT(message, ::testing::HasSubstr(std::string(law.name)));
    EXPECT_EQ(&find(law.name), &law);
    EXPECT_FALSE(law.description.empty()) << law.name;
  }
}

}  // namespace pfdm
