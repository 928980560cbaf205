#include "cases/program/fracture/outcome/debonded_poles.h"

#include "physics/angle.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

/// A row of debonding.csv: displacement [m], force [N], polar angles of the debonded caps [degrees].
struct Caps {
  double displacement, force, plus, minus;
};

/// Of the surface of this number, in order of the steps.
std::vector<Caps> caps_of(const CsvTable& table, std::size_t surface) {
  std::vector<Caps> caps;
  for (std::size_t i = 0; i < table.n_rows(); ++i)
    if (table.column("surface")[i] == static_cast<double>(surface))
      caps.push_back({table.column("displacement_m")[i], table.column("force_N")[i],
                      table.column("debonding_angle_plus_deg")[i], table.column("debonding_angle_minus_deg")[i]});
  return caps;
}

/// "between 30 and 40 um, where the force goes from 3 to 2 N"
std::string words_of_step(const Caps& before, const Caps& after, const CurveUnits& units) {
  return fmt::format("between {}, where the force goes from {}",
                     two_shown_in(units.displacement, before.displacement, "and", after.displacement),
                     two_shown_in(units.force, before.force, "to", after.force));
}

/// Of the pole whose cap comes later, or of both where they come in the same step; empty where it never does.
std::string words_of_later_pole(const std::vector<Caps>& caps, const Vector& axis, const CurveUnits& units) {
  constexpr double jump = 15.0;  // degrees: a sector of the law
  const auto first = [&](double Caps::*cap) {
    return std::ranges::find_if(caps, [&](const Caps& c) { return c.*cap > 0.0; });
  };
  const bool is_along = first(&Caps::plus) > first(&Caps::minus);
  const auto cap = is_along ? &Caps::plus : &Caps::minus;
  const auto begin = first(cap);
  if (begin == caps.end() || begin == caps.begin()) return {};
  if (first(&Caps::plus) == first(&Caps::minus))
    return "both poles in one step, " + words_of_step(*(begin - 1), *begin, units);
  const std::string pole = name_of_pole(is_along, axis);
  auto largest = begin;
  for (auto at = begin; at != caps.end(); ++at)
    if ((*at).*cap - (*(at - 1)).*cap > (*largest).*cap - (*(largest - 1)).*cap) largest = at;
  const double before = (*(largest - 1)).*cap, after = (*largest).*cap;
  if (after - before < jump)
    return fmt::format("its {} little by little from {} on", pole, shown_in(units.displacement, begin->displacement));
  return fmt::format("its {} {}, and the debonding angle from {:.0f} to {:.0f} degrees", pole,
                     words_of_step(*(largest - 1), *largest, units), before, after);
}

}  // namespace

std::string name_of_pole(bool along, const Vector& axis) {
  constexpr double upright = 0.99;
  if (axis.z() > upright) return along ? "upper pole" : "lower pole";
  return along ? "pole along the load" : "pole against the load";
}

std::optional<std::string> pole_of(double polar_from, double polar_to, const Vector& axis) {
  constexpr double at_pole = 20.0 * degree;  // a place of the mesh about the pole
  if (polar_from < at_pole) return name_of_pole(true, axis);
  if (polar_to > 180.0 * degree - at_pole) return name_of_pole(false, axis);
  return std::nullopt;
}

std::string rest_of_debonding(const std::string& surface, const Vector& axis, const CurveUnits& units,
                              const fs::path& results) {
  const fs::path laws = results / "cohesive.json", angles = results / "debonding.csv";
  if (!fs::exists(laws) || !fs::exists(angles)) return {};
  return read_json(laws, "file of cohesive laws", [&](const nlohmann::ordered_json& json) -> std::string {
    const auto& all = json.at("surfaces");
    const auto found = std::ranges::find_if(all, [&](const auto& one) { return one.at("name") == surface; });
    if (found == all.end()) return {};
    const double share = number_of(found->at("debonded_area_m2")) / number_of(found->at("area_m2"));
    if (!std::isfinite(share)) return {};
    const std::string pole =
        words_of_later_pole(caps_of(read_csv(angles), static_cast<std::size_t>(found - all.begin())), axis, units);
    const std::string area = fmt::format("{:.3g} %", 100.0 * share);
    if (pole.empty()) return fmt::format("at the end {} of \"{}\" has debonded", area, surface);
    return fmt::format("\"{}\" debonds at {}; at the end {} of it has debonded", surface, pole, area);
  });
}

}  // namespace pfdm
