#include "cases/program/fracture/outcome/interface_chart.h"

#include "cases/program/fracture/outcome/opening_law.h"
#include "postproc/page/display_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pfdm {
namespace {

constexpr std::size_t most_states = 1500;
constexpr double beyond_end = 1.2;

struct FaceState {
  double separation, traction;  // [m], [Pa]
};

/// lambda and S lambda (physics/interfaces/interface_law.h) of a face that is open; nothing of a closed one, where
/// contact acts besides.
std::optional<FaceState> state_of(const InterfaceLaw& law, const ColumnSample& sample) {
  const double opening = sample.separation[0], slip = sample.separation.tail<2>().norm();
  if (!(opening > 0.0)) return std::nullopt;
  if (law.mixed_mode->is_potential) return FaceState{opening, sample.traction[0]};
  const double beta2 = law.shear_ratio * law.shear_ratio;
  const double rho = law.mixed_mode->keeps_stiffness ? 1.0 / beta2 : beta2;
  const double k = law.mixed_mode->keeps_stiffness ? 1.0 : beta2;
  const double lambda = std::hypot(opening, std::sqrt(rho) * slip);
  return FaceState{lambda, sample.traction.norm() / std::hypot(opening, k * slip) * lambda};
}

/// Of all faces at all steps, evenly thinned out.
std::vector<FaceState> states_of(const InterfaceLaw& law, const ColumnRecord& record, double end) {
  std::vector<FaceState> states;
  for (const std::vector<ColumnSample>& step : record.steps)
    for (const ColumnSample& sample : step)
      if (const auto state = state_of(law, sample); state && state->separation <= end) states.push_back(*state);
  if (states.size() <= most_states) return states;
  std::vector<FaceState> some;
  for (std::size_t i = 0; i < most_states; ++i) some.push_back(states[i * states.size() / most_states]);
  return some;
}

struct LawCurve {
  std::string label;
  Vector direction;
  SeriesStyle style;
};

/// That in opening, and that in shear where the equivalent one is another.
std::vector<LawCurve> curves_of(const InterfaceLaw& law, const std::string& figures) {
  const std::string given = law.depends_on_rate() ? "given, opened slowly: " : "given: ";
  std::vector<LawCurve> curves{{given + figures, Vector::UnitX(), SeriesStyle::line}};
  if (law.depends_on_mode()) curves.push_back({"in shear", Vector::UnitY(), SeriesStyle::dashed});
  return curves;
}

Series given_series(const InterfaceLaw& law, const InterfaceStrength& at, const LawCurve& curve, double end,
                    const DisplayUnit& x, const DisplayUnit& y) {
  Series series{.label = curve.label, .x = {0.0}, .y = {0.0}, .style = curve.style};
  constexpr int points = 400;
  std::vector<double> separations;
  for (int i = 1; i <= points; ++i) separations.push_back(end * std::pow(double(i) / points, 2.0));
  if (law.law->has_rise()) {  // its peak
    const bool shear = curve.direction.x() == 0.0 && law.depends_on_mode();
    separations.push_back((shear ? at.shear_strength : at.strength) / at.stiffness);
    std::ranges::sort(separations);
  }
  for (const double separation : separations) {
    series.x.push_back(x.factor * separation);
    series.y.push_back(y.factor * traction_along(law, at, curve.direction, separation));
  }
  return series;
}

double largest_of(const std::vector<FaceState>& states, double FaceState::*value) {
  double most = 0.0;
  for (const FaceState& state : states) most = std::max(most, state.*value);
  return most;
}

}  // namespace

Chart interface_chart(const InterfaceSettings& interface, const ColumnRecord& record) {
  const InterfaceLaw& law = interface.law;
  const bool uniform = is_uniform(interface);
  const InterfaceStrength at = uniform ? strength_everywhere(interface) : InterfaceStrength{};
  std::vector<LawCurve> curves;
  double end = std::numeric_limits<double>::infinity();
  if (uniform) {
    curves =
        curves_of(law, fmt::format("{}, {}, {} J/m²", law.law->name, shown(at.strength, "Pa"), shown(at.toughness)));
    end = 0.0;
    for (const LawCurve& curve : curves) end = std::max(end, beyond_end * end_along(law, at, curve.direction));
  }
  const std::vector<FaceState> states = states_of(law, record, end);
  const double widest = uniform ? end : largest_of(states, &FaceState::separation);
  const DisplayUnit x = display_unit(widest, "m");
  const DisplayUnit y =
      display_unit(std::max({at.strength, at.shear_strength, largest_of(states, &FaceState::traction)}), "Pa");
  const std::string_view which = law.mixed_mode->is_potential ? "normal" : "equivalent";
  Chart chart{.caption = fmt::format("Given law of \"{}\" and states of its faces", record.name),
              .x = {.title = fmt::format("{} separation [{}]", which, x.name), .from = 0.0},
              .y = {.title = fmt::format("{} traction [{}]", which, y.name)},
              .series = {}};
  Series faces{
      .label = uniform ? "states of single faces" : "states of single faces; the law varies from place to place",
      .x = {},
      .y = {},
      .style = SeriesStyle::points,
      .colour = 1};
  for (const FaceState& state : states) {
    faces.x.push_back(x.factor * state.separation);
    faces.y.push_back(y.factor * state.traction);
  }
  chart.series.push_back(std::move(faces));
  for (const LawCurve& curve : curves) chart.series.push_back(given_series(law, at, curve, end, x, y));
  return chart;
}

GivenFigures given_figures(const InterfaceSettings& interface) {
  GivenFigures figures{.law = std::string(interface.law.law->name),
                       .mixed_mode = std::string(interface.law.mixed_mode->name)};
  if (!is_uniform(interface)) return figures;
  const InterfaceStrength at = strength_everywhere(interface);
  figures.strength = at.strength;
  figures.toughness = at.toughness;
  figures.shear_strength =
      interface.law.mixed_mode->has_shear_strength() ? at.shear_strength : interface.law.shear_ratio * at.strength;
  const double beta2 = interface.law.shear_ratio * interface.law.shear_ratio;
  figures.shear_toughness = interface.law.mixed_mode->has_shear_strength()
                                ? at.shear_toughness
                                : (interface.law.mixed_mode->keeps_stiffness ? beta2 : 1.0) * at.toughness;
  return figures;
}

}  // namespace pfdm
