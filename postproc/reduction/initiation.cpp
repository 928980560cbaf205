#include "postproc/reduction/initiation.h"

#include "physics/error.h"
#include "postproc/curves/measured_curve.h"
#include "postproc/reduction/beam_terms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

constexpr double departure = 0.02;  // of the line's force, at NL
constexpr double scatters = 3.0;    // of the rows about the line

std::size_t first_row_with(const TestRecord& record, double force) {
  return static_cast<std::size_t>(std::ranges::find_if(record.force, [=](double f) { return f >= force; }) -
                                  record.force.begin());
}

double force_on_line(const StraightPart& straight, double displacement) {
  return (displacement - straight.origin) / straight.compliance;
}

double scatter_about(const TestRecord& record, const StraightPart& straight, std::size_t first) {
  double sum = 0.0;
  for (std::size_t i = first; i < straight.end; ++i) {
    const double off = record.force[i] - force_on_line(straight, record.displacement[i]);
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(straight.end - first, 3) - 2));
}

/// Where the record crosses the line from the origin with `compliance` for good, in the rows up to `last`.
std::optional<InitiationPoint> crossing(const TestRecord& record, const StraightPart& straight, double compliance,
                                        std::size_t last) {
  const auto above = [&](std::size_t i) {
    return record.force[i] - (record.displacement[i] - straight.origin) / compliance;
  };
  if (above(last) > 0.0) return std::nullopt;
  std::size_t i = last;
  while (i > straight.end && above(i - 1) <= 0.0) --i;
  const double before = above(i - 1), part = before > 0.0 ? before / (before - above(i)) : 0.0;
  const auto between = [&](const std::vector<double>& v) { return v[i - 1] + part * (v[i] - v[i - 1]); };
  return InitiationPoint{between(record.displacement), between(record.force), i - 1};
}

InitiationPoint at_row(const TestRecord& record, std::size_t row) {
  return {record.displacement[row], record.force[row], row};
}

}  // namespace

StraightPart straight_part(const TestRecord& record) {
  const auto top = std::ranges::max_element(record.force);
  if (top == record.force.end() || !(*top > 0.0)) throw InputError("no force of the record is positive");
  StraightPart straight{.greatest_force = *top,
                        .row_of_greatest = static_cast<std::size_t>(top - record.force.begin())};
  const std::size_t first = first_row_with(record, straight_from * *top);
  straight.end = first_row_with(record, straight_to * *top);
  const auto part = [&](const std::vector<double>& v) {
    return std::vector<double>(v.begin() + first, v.begin() + straight.end);
  };
  const auto line = straight_line(part(record.displacement), part(record.force), 0.0);
  if (!line)
    throw InputError(
        fmt::format("{} rows lie between 10 and 50 % of the greatest force; the initial compliance needs "
                    "three that rise",
                    straight.end - first));
  straight.compliance = 1.0 / line->slope;
  straight.origin = line->zero;
  straight.origin_error = line->zero_error;
  straight.n_points = line->n_points;
  return straight;
}

std::optional<InitiationPoint> nonlinearity(const TestRecord& record, const StraightPart& straight) {
  const std::size_t first = first_row_with(record, straight_from * straight.greatest_force);
  const double scatter = scatter_about(record, straight, first);
  const auto has_left = [&](std::size_t i) {
    const double line = force_on_line(straight, record.displacement[i]);
    return line - record.force[i] > std::max(departure * line, scatters * scatter);
  };
  std::size_t row = straight.row_of_greatest;
  if (!has_left(row)) return std::nullopt;  // the record breaks off, or falls at once
  while (row > straight.end && has_left(row - 1)) --row;
  return InitiationPoint{record.displacement[row], record.force[row], row};
}

InitiationPoint five_percent_or_greatest(const TestRecord& record, const StraightPart& straight,
                                         const SecantRule& rule) {
  const std::size_t top = straight.row_of_greatest;
  const auto point = crossing(record, straight, rule.compliance * straight.compliance, top);
  if (!point) return at_row(record, top);
  const auto first = record.force.begin();
  const auto before = std::max_element(first, first + point->row + 1);
  const bool is_greater = rule.or_greater_before && *before > point->force;
  return is_greater ? at_row(record, static_cast<std::size_t>(before - first)) : *point;
}

}  // namespace pfdm
