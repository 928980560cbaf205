#include "postproc/reduction/reduced_test.h"

#include "physics/quantity_text.h"
#include "postproc/reduction/beam_terms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfdm {
namespace {

constexpr double least_share = 0.1;         // of the greatest force: the specimen still carries
constexpr double noticeable_factor = 0.99;  // F
constexpr double noticeable_origin = 0.01;  // of the displacement at the greatest force

/// Where a row's crack length was read; the crack of the beginning at those before any.
bool was_read(const TestRecord& record, std::size_t row) {
  return !record.crack_length.empty() && std::isfinite(record.crack_length[row]);
}

/// Whether the specimen still carries.
bool carries(const ReducedTest& test, std::size_t row) {
  return test.record.force[row] >= least_share * test.straight.greatest_force;
}

/// From the first point of initiation on, before the specimen has failed.
std::vector<std::size_t> rows_with_growth(const ReducedTest& test) {
  std::size_t from = test.five_percent.row;
  if (test.nonlinearity) from = std::min(from, test.nonlinearity->row);
  std::vector<std::size_t> rows;
  for (std::size_t i = from; i < test.record.n_rows(); ++i)
    if (was_read(test.record, i) && carries(test, i)) rows.push_back(i);
  return rows;
}

std::optional<InitiationPoint> seen_first(const TestRecord& record, double first_length) {
  constexpr double rounding = 1e-6;
  const bool has_gaps = std::ranges::any_of(record.crack_length, [](double length) { return !std::isfinite(length); });
  const double least = has_gaps ? 0.0 : (1.0 + rounding) * first_length;
  const auto seen = std::ranges::find_if(record.crack_length, [=](double length) { return length > least; });
  if (seen == record.crack_length.end()) return std::nullopt;
  const auto row = static_cast<std::size_t>(seen - record.crack_length.begin());
  return InitiationPoint{record.displacement[row], record.force[row], row};
}

Reduced at_point(const CalibratedMethod& method, const InitiationPoint& point, double crack_length) {
  return method.at(point.force, point.displacement, crack_length);
}

std::vector<ReducedPoint> points_of(const CalibratedMethod& method, bool needs_lengths, const ReducedTest& test) {
  std::vector<ReducedPoint> points;
  const TestRecord& record = test.record;
  for (std::size_t i = test.five_percent.row + 1; i < record.n_rows(); ++i) {
    if (!carries(test, i)) continue;
    if (needs_lengths && !was_read(record, i)) continue;
    const Reduced found =
        method.at(record.force[i], record.displacement[i], needs_lengths ? record.crack_length[i] : not_given);
    if (std::isfinite(found.toughness)) points.push_back({i, found});
  }
  return points;
}

Propagation propagation_of(const std::vector<ReducedPoint>& points, std::size_t from) {
  std::vector<double> lengths, values;
  for (const ReducedPoint& p : points)
    if (p.row > from) {
      lengths.push_back(p.found.crack_length);
      values.push_back(p.found.toughness);
    }
  Propagation found{.n_points = values.size()};
  if (values.empty()) return found;
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double v : values) sum += v;
  found.toughness = sum / n;
  for (const double v : values) squares += (v - found.toughness) * (v - found.toughness);
  if (values.size() > 1) found.deviation = std::sqrt(squares / (n - 1.0));
  found.rise = fitted_line(lengths, values).slope;
  return found;
}

ReducedByMethod reduced_by(const ReductionMethod& method, const CalibrationData& data, ReducedTest& test) {
  ReducedByMethod result{.name = method.name, .source = method.source};
  const CalibratedMethod calibrated = method.calibrate(data);
  result.missing = calibrated.missing;
  if (!calibrated.remark.empty()) test.remarks.push_back(calibrated.remark);
  if (!calibrated.at) return result;
  const double a0 = data.specimen.crack_length;
  result.constants = calibrated.constants;
  if (test.nonlinearity) result.nonlinearity = at_point(calibrated, *test.nonlinearity, a0);
  result.five_percent = at_point(calibrated, test.five_percent, a0);
  if (test.visual) result.visual = at_point(calibrated, *test.visual, test.record.crack_length[test.visual->row]);
  result.points = points_of(calibrated, method.needs_crack_lengths, test);
  result.propagation = propagation_of(result.points, test.straight.row_of_greatest);
  return result;
}

/// Of a double cantilever beam whose end blocks are not given.
void remark_on_large_displacement(ReducedTest& test, const TestDimensions& s) {
  if (test.specimen != "double_cantilever_beam" || !std::isnan(s.block_offset + s.block_length)) return;
  double least = 1.0;
  for (std::size_t i = 0; i < test.record.n_rows(); ++i)
    if (was_read(test.record, i))
      least = std::min(least, large_displacement_factor(test.record.displacement[i], test.record.crack_length[i], 0.0));
  if (least < noticeable_factor)
    test.remarks.push_back(fmt::format(
        "F of the standard takes up to {:.1f} % off G with N = 1; beams at large displacements need N too, which "
        "block_offset = block_length = \"0 mm\" takes in",
        100.0 * (1.0 - least)));
}

void remark_on(ReducedTest& test) {
  const double reach = test.record.displacement[test.straight.row_of_greatest];
  if (std::abs(test.origin) > noticeable_origin * std::abs(reach))
    test.remarks.push_back(
        fmt::format("the straight part of the record meets zero force at {}, which is taken as the origin here; a fit "
                    "has it by toe or offset in [experiment] alone",
                    quantity_text(test.origin, "m")));
  if (test.straight.row_of_greatest + 1 == test.record.n_rows())
    test.remarks.emplace_back("the force still rises at the end of the record: nothing is known of propagation");
}

}  // namespace

ReducedTest reduced_test(const ReducedSpecimen& specimen, TestRecord record, const TestDimensions& dimensions,
                         std::string name) {
  ReducedTest test{
      .name = std::move(name), .specimen = std::string(specimen.name), .record = std::move(record), .straight = {}};
  test.straight = straight_part(test.record);
  test.origin = std::exchange(test.straight.origin, 0.0);
  for (double& d : test.record.displacement) d -= test.origin;
  test.nonlinearity = nonlinearity(test.record, test.straight);
  test.five_percent = five_percent_or_greatest(test.record, test.straight, specimen.secant);
  test.visual = seen_first(test.record, dimensions.crack_length);
  const CalibrationData data{test.record, dimensions, test.straight, test.five_percent, rows_with_growth(test)};
  for (const ReductionMethod& method : specimen.methods()) test.methods.push_back(reduced_by(method, data, test));
  remark_on(test);
  remark_on_large_displacement(test, dimensions);
  return test;
}

double best_toughness(const ReducedTest& test) {
  for (const ReducedByMethod& method : test.methods)
    if (method.propagation.n_points >= 3) return method.propagation.toughness;
  for (const ReducedByMethod& method : test.methods)
    if (std::isfinite(method.five_percent.toughness)) return method.five_percent.toughness;
  return not_given;
}

double constant_of(const ReducedTest& test, std::string_view name) {
  for (const ReducedByMethod& method : test.methods)
    for (const ReductionConstant& constant : method.constants)
      if (constant.name == name) return constant.value;
  return not_given;
}

}  // namespace pfdm
