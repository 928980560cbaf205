#include "cases/program/fracture/run_estimate.h"

#include "postproc/curves/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

/// "40 s", "3 min", "2 h"; one digit and a half.
std::string about(double seconds) {
  const auto rounded = [](double value) { return value < 9.5 ? std::round(value) : 5.0 * std::round(value / 5.0); };
  if (seconds < 1.0) return "1 s";
  if (seconds < 90.0) return fmt::format("{:g} s", rounded(seconds));
  if (seconds < 5400.0) return fmt::format("{:g} min", rounded(seconds / 60.0));
  return fmt::format("{:g} h", rounded(seconds / 3600.0));
}

std::optional<double> measured_seconds(const std::filesystem::path& results, const std::string& case_hash) {
  try {
    const auto summary = read_summary(results / summary_file);
    if (summary && summary->status == "complete" && summary->case_hash == case_hash)
      return summary->number("wall_seconds");
  } catch (const InputError&) {  // no summary: as good as none
  }
  return std::nullopt;
}

bool shares_differences(const CurveFitSettings& fit) { return fit.solver.differences == Differences::shared; }

/// Five iterations of a stage, each with the run itself and the differences of its parameters: bar_fit 53,
/// glass_bead_fit 29, glass_bead_calibration 35 runs. After shared differences those about the estimates.
int estimated_runs(const CurveFitSettings& fit) {
  constexpr int iterations = 5;
  const int each = fit.solver.differences == Differences::central ? 2 : 1;
  int runs = 0;
  for (const CurveFitStage& stage : fit.stages)
    runs += stage.starts * iterations * (1 + each * static_cast<int>(stage.parameters.size())) + stage.screened +
            (shares_differences(fit) ? 2 * static_cast<int>(stage.parameters.size()) : 0);
  return runs;
}

/// Of the intervals beside the linear ones, of the last stage: glass_bead_calibration 124 by profiles, 80 at most for
/// its posterior.
int estimated_runs_of_intervals(const CurveFitSettings& fit) {
  const auto k = static_cast<int>(fit.stages.back().parameters.size());
  const int each = fit.solver.differences == Differences::central ? 2 : 1;
  constexpr int by_end = 7, batches = 4;
  const int at_end = shares_differences(fit) ? 2 * (k - 1) : 0;  // about each end of a profile
  if (fit.intervals == Intervals::profile) return 2 * k * (by_end * (1 + each * (k - 1)) + at_end);
  return has_posterior(fit.intervals) ? batches * (k + 1) * (k + 2) : 0;
}

/// The first guess, and the points of a stage: bar_fit 7, glass_bead_fit 8.
int estimated_led_runs(const CurveFitSettings& fit) {
  int runs = 1;
  for (const CurveFitStage& stage : fit.stages) runs += 2 + static_cast<int>(stage.parameters.size());
  return runs;
}

}  // namespace

/// Peak of the bead benchmark: 193 MB with 98,000 faces (42,000 tetrahedra and prisms), 448 MB with 261,000; 272 MB
/// with 77,000 faces of 17,000 polyhedra, which VTK's grid holds as triangles.
double estimated_memory(const Mesh& mesh) {
  const bool polyhedra = std::ranges::find(mesh.shape, CellShape::polyhedron) != mesh.shape.end();
  return (polyhedra ? 3.1e3 : 1.9e3) * mesh.n_faces() + 40e6;
}

std::string time_words(const Mesh& mesh, const FractureModel& model, const LoadingSettings& loading,
                       const std::filesystem::path& results, const std::string& case_hash) {
  if (const auto seconds = measured_seconds(results, case_hash))
    return fmt::format("time: the complete run in {} took {:.3g} s", results.string(), *seconds);
  // Processor time of a cell in a step of the largest increment: of 20 shipped cases 3e-5 to 7e-4 s, their median.
  constexpr double usual = 1.1e-4, finite_strain = 5.0;
  const double steps = std::ceil(loading.end / loading.maximum_increment - 1e-9);
  const double seconds = usual * steps * mesh.n_cells() * (model.is_finite_strain() ? finite_strain : 1.0);
  return fmt::format(
      "time: about {} of one processor by cells and steps; shipped cases take a third to seven times such an estimate",
      about(seconds));
}

std::string fit_words(const CurveFitSettings& fit) {
  constexpr int as_often =
      2;  // as a fit that no coarse case leads: 148 runs for 53 of bar_fit, 75 for 29 of glass_bead_fit
  const int intervals = estimated_runs_of_intervals(fit);
  const std::string finer = fit.where.has("finer") ? ", and one of the case that [fit] finer makes" : "";
  if (fit.where.has("coarse"))
    return fmt::format("pfdm fit would make some {} runs, led by some {} of the case that [fit] coarse makes{}",
                       estimated_led_runs(fit), as_often * estimated_runs(fit) + intervals, finer);
  return fmt::format("pfdm fit would make some {} runs{}", estimated_runs(fit) + intervals, finer);
}

}  // namespace pfdm
