// How often jumps of a noisy record are found (postproc/curves/recorded_jumps.h), and how far off they are.
//
//     jump_recognition 2000

#include "postproc/curves/recorded_jumps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

namespace {

constexpr double height = 10.0, least_fall = 0.05;
constexpr int n_rows = 81;

/// Synthetic: rows 1 apart of a curve that rises with slope 1 and falls by 10 at `place`, with normal noise.
pfdm::SampledCurve record_of(double place, double deviation, std::mt19937& engine) {
  std::normal_distribution<double> noise(0.0, deviation);
  pfdm::SampledCurve record{.name = "synthetic", .x = {}, .y = {}};
  for (int i = 0; i < n_rows; ++i) {
    record.x.push_back(i);
    record.y.push_back(i - (i > place ? height : 0.0) + noise(engine));
  }
  record.deviation.assign(record.x.size(), deviation);
  return record;
}

/// The value that so large a share of them does not exceed.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void show(double ratio, int n_records) {
  std::mt19937 engine(2026);
  std::uniform_real_distribution<double> place(20.0, 60.0);
  std::vector<double> off;  // of the largest found, in its standard deviations
  int n_others = 0;
  for (int n = 0; n < n_records; ++n) {
    const double at = place(engine);
    const auto jumps = pfdm::recorded_jumps(record_of(at, height / ratio, engine), least_fall);
    if (jumps.empty()) continue;
    const auto fall = [](const pfdm::RecordedJump& jump) { return jump.force_before - jump.force_after; };
    const auto largest = std::ranges::max_element(jumps, {}, fall);
    off.push_back(std::abs(largest->displacement - at) / largest->deviation);
    n_others += static_cast<int>(jumps.size()) - 1;
  }
  const auto elsewhere = std::ranges::count_if(off, [](double deviations) { return deviations > 4.0; });
  fmt::print(
      "{:4g} deviations of the noise: found in {:.1f} % of {}, 95 % within {:.2f}, 99 % within {:.2f} of the "
      "stated deviations, {} beyond 4; {} other jumps\n",
      ratio, 100.0 * static_cast<double>(off.size()) / n_records, n_records, quantile(off, 0.95), quantile(off, 0.99),
      elsewhere, n_others);
}

}  // namespace

int main(int argc, char** argv) {
  const int n_records = argc > 1 ? std::atoi(argv[1]) : 2000;
  for (const double ratio : {20.0, 10.0, 7.0, 5.0, 4.0, 3.0}) show(ratio, n_records);
}
