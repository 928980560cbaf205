#include "solver/vibration/signals/signals_fourier.h"

#include <fftw3.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

// FFTW's planner keeps global state; only the execution of a plan is free of it.
std::mutex planner;

class Plan {
 public:
  explicit Plan(fftw_plan plan) : plan_(plan) {}
  ~Plan() {
    const std::scoped_lock lock(planner);
    fftw_destroy_plan(plan_);
  }
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;
  fftw_plan get() const { return plan_; }

 private:
  fftw_plan plan_;
};

/// Plans of one kind of transform by its length, the latest first. Making one costs as much as a transform, and a
/// record is transformed hundreds of times at few lengths. The arrays of Eigen, which are aligned alike, can all use
/// one.
class Plans {
 public:
  template <class Make>
  std::shared_ptr<const Plan> of(Eigen::Index n, const Make& make) {
    constexpr std::size_t most = 16;
    std::shared_ptr<const Plan> left_out;  // ends after the lock
    const std::scoped_lock lock(planner);
    auto known = std::ranges::find(known_, n, &Known::n);
    if (known == known_.end()) {
      if (known_.size() == most) {
        left_out = std::move(known_.back().plan);
        known_.pop_back();
      }
      known_.push_back({n, std::make_shared<const Plan>(make())});
      known = known_.end() - 1;
    }
    std::rotate(known_.begin(), known, known + 1);
    return known_.front().plan;
  }

 private:
  struct Known {
    Eigen::Index n;
    std::shared_ptr<const Plan> plan;
  };
  std::vector<Known> known_;
};

Plans forward_plans, backward_plans;

fftw_complex* as_fftw(Eigen::VectorXcd& x) { return reinterpret_cast<fftw_complex*>(x.data()); }

}  // namespace

Eigen::VectorXcd fourier(const Eigen::Ref<const Eigen::VectorXd>& x) {
  Eigen::VectorXd in = x;
  Eigen::VectorXcd out(x.size() / 2 + 1);
  const auto plan = forward_plans.of(in.size(), [&] {
    return fftw_plan_dft_r2c_1d(static_cast<int>(in.size()), in.data(), as_fftw(out), FFTW_ESTIMATE);
  });
  fftw_execute_dft_r2c(plan->get(), in.data(), as_fftw(out));
  return out;
}

Eigen::VectorXd inverse_fourier(const Eigen::VectorXcd& spectrum, Eigen::Index n) {
  assert(spectrum.size() == n / 2 + 1);
  Eigen::VectorXcd in = spectrum;  // the transform destroys its input
  Eigen::VectorXd out(n);
  const auto plan = backward_plans.of(
      n, [&] { return fftw_plan_dft_c2r_1d(static_cast<int>(n), as_fftw(in), out.data(), FFTW_ESTIMATE); });
  fftw_execute_dft_c2r(plan->get(), as_fftw(in), out.data());
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
