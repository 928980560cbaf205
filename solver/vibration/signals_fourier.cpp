#include "solver/vibration/signals_fourier.h"

#include <fftw3.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <mutex>

namespace pfdm {
namespace {

// FFTW's planner keeps global state; only the execution of a plan is free of it.
std::mutex planner;

class Plan {
 public:
  template <class Make>
  explicit Plan(const Make& make) {
    const std::scoped_lock lock(planner);
    plan_ = make();
  }
  ~Plan() {
    const std::scoped_lock lock(planner);
    fftw_destroy_plan(plan_);
  }
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;
  void execute() const { fftw_execute(plan_); }

 private:
  fftw_plan plan_ = nullptr;
};

fftw_complex* as_fftw(Eigen::VectorXcd& x) { return reinterpret_cast<fftw_complex*>(x.data()); }

}  // namespace

Eigen::VectorXcd fourier(const Eigen::Ref<const Eigen::VectorXd>& x) {
  Eigen::VectorXd in = x;
  Eigen::VectorXcd out(x.size() / 2 + 1);
  const Plan plan(
      [&] { return fftw_plan_dft_r2c_1d(static_cast<int>(in.size()), in.data(), as_fftw(out), FFTW_ESTIMATE); });
  plan.execute();
  return out;
}

Eigen::VectorXd inverse_fourier(const Eigen::VectorXcd& spectrum, Eigen::Index n) {
  assert(spectrum.size() == n / 2 + 1);
  Eigen::VectorXcd in = spectrum;  // the transform destroys its input
  Eigen::VectorXd out(n);
  const Plan plan([&] { return fftw_plan_dft_c2r_1d(static_cast<int>(n), as_fftw(in), out.data(), FFTW_ESTIMATE); });
  plan.execute();
  return out / static_cast<double>(n);
}

Eigen::Index fast_length(Eigen::Index n) {
  for (Eigen::Index length = std::max<Eigen::Index>(n, 1);; ++length) {
    Eigen::Index rest = length;
    for (const Eigen::Index prime : {2, 3, 5})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return length;
  }
}

}  // namespace pfdm
