#include "postproc/cohesive/first_debonding.h"

#include "physics/angle.h"
#include "postproc/cohesive/cohesive_law.h"
#include "postproc/cohesive/flat_surface.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/json.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfdm {
namespace {

double damage_of_column(const Column& column, const CellField<double>& damage) {
  double largest = 0.0;
  for (const LineSegment& segment : column.segments) largest = std::max(largest, damage[segment.cell]);
  return largest;
}

std::vector<double> damage_of_faces(const ColumnSet& set, const OutputFields& output) {
  const OutputInterface& now = *std::ranges::find(output.interfaces, set.name, &OutputInterface::name);
  std::vector<double> values;
  for (std::size_t k = 0; k < set.columns.size(); ++k) values.push_back(now.damage[k]);
  return values;
}

double area_of(const std::vector<const Column*>& columns) {
  double sum = 0.0;
  for (const Column* column : columns) sum += column->area;
  return sum;
}

/// Those about the pole with the larger part of their area.
std::vector<const Column*> about_one_pole(const std::vector<const Column*>& columns, const Vector& axis) {
  std::vector<const Column*> plus, minus;
  for (const Column* column : columns) (column->normal.dot(axis) > 0.0 ? plus : minus).push_back(column);
  return area_of(plus) > area_of(minus) ? plus : minus;
}

FirstDebonding described(const ColumnSet& set, const std::vector<const Column*>& debonded, const Vector& axis,
                         Index step) {
  FirstDebonding first{.surface = set.name, .step = step};
  if (is_flat(set.kind, set.columns)) return first;
  const std::vector<const Column*> cap = about_one_pole(debonded, axis);
  first.polar_from = std::numbers::pi;
  first.polar_to = 0.0;
  for (const Column* column : cap) {
    first.polar_from = std::min(first.polar_from, polar_angle(column->normal, axis));
    first.polar_to = std::max(first.polar_to, polar_angle(column->normal, axis));
  }
  double whole = 0.0;
  for (const Column& column : set.columns) whole += column.area;
  first.angle = cap_angle(area_of(cap), whole);
  return first;
}

}  // namespace

DebondingWatch::DebondingWatch(const std::vector<ColumnSet>& sets, const Vector& axis, const CellField<double>& damage)
    : sets_(sets), axis_(axis) {
  for (const ColumnSet& set : sets) {
    before_.emplace_back();
    for (const Column& column : set.columns)
      before_.back().push_back(damage_of_column(column, damage) > debonded_damage);
  }
}

std::optional<FirstDebonding> DebondingWatch::look(const CellField<double>& damage, const StepReport& report,
                                                   const std::function<OutputFields()>& output) const {
  const bool faces = std::ranges::any_of(report.debonded_area, [](double area) { return area > 0.0; });
  const std::optional<OutputFields> fields = faces ? std::optional(output()) : std::nullopt;
  std::optional<FirstDebonding> first;
  double largest = 0.0;
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    const ColumnSet& set = sets_[s];
    if (set.is_cohesive && !faces) continue;
    const std::vector<double> of_faces = set.is_cohesive ? damage_of_faces(set, *fields) : std::vector<double>{};
    std::vector<const Column*> debonded;
    for (std::size_t k = 0; k < set.columns.size(); ++k) {
      const bool now = set.is_cohesive ? of_faces[k] > debonded_share
                                       : damage_of_column(set.columns[k], damage) > debonded_damage && !before_[s][k];
      if (now) debonded.push_back(&set.columns[k]);
    }
    if (const double area = area_of(debonded); area > largest) {
      largest = area;
      first = described(set, debonded, axis_, report.step);
    }
  }
  return first;
}

std::map<std::string, double> debonding_figures(const std::optional<FirstDebonding>& first,
                                                std::span<const CurveRow> rows, int component) {
  constexpr double none = FirstDebonding::none;
  const CurveRow *before = nullptr, *after = nullptr;
  for (const CurveRow& row : rows) {
    if (!first || row.step > first->step) break;
    (row.step < first->step ? before : after) = &row;
  }
  const FirstDebonding angles = first.value_or(FirstDebonding{});
  return {{"first_debonding_load", before != nullptr ? before->load : none},
          {"first_debonding_displacement_m", before != nullptr ? before->displacement : none},
          {"first_debonding_force_N", before != nullptr ? before->force[component] : none},
          {"first_debonding_load_after", after != nullptr ? after->load : none},
          {"first_debonding_displacement_after_m", after != nullptr ? after->displacement : none},
          {"first_debonding_force_after_N", after != nullptr ? after->force[component] : none},
          {"first_debonding_polar_angle_from_deg", angles.polar_from / degree},
          {"first_debonding_polar_angle_to_deg", angles.polar_to / degree},
          {"first_debonding_angle_deg", angles.angle / degree}};
}

void write_first_debonding(const std::filesystem::path& path, const FirstDebonding& first) {
  const nlohmann::ordered_json json = {{"surface", first.surface},
                                       {"step", first.step},
                                       {"polar_angle_from_rad", first.polar_from},
                                       {"polar_angle_to_rad", first.polar_to},
                                       {"debonding_angle_rad", first.angle}};
  write_file(path, json_text(json));
}

std::optional<FirstDebonding> take_first_debonding(const std::filesystem::path& path, Index last_step) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  FirstDebonding first = read_json(path, "record of a first debonding", [](const nlohmann::ordered_json& json) {
    return FirstDebonding{.surface = json.at("surface"),
                          .step = whole_number<Index>(json.at("step")),
                          .polar_from = number_of(json.at("polar_angle_from_rad")),
                          .polar_to = number_of(json.at("polar_angle_to_rad")),
                          .angle = number_of(json.at("debonding_angle_rad"))};
  });
  if (first.step <= last_step) return first;
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return std::nullopt;
}

}  // namespace pfdm
