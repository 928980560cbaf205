#include "cases/program/fracture/outcome/energy_release_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace pfdm {
namespace {

constexpr std::string_view headline_endings[] = {"_G_J_per_m2", "_K1_Pa_sqrt_m", "_K2_Pa_sqrt_m",
                                                 "_phase_angle_degree"};

constexpr double bearable_damaged_share = 0.05;  // of the integrand of an energy release rate

std::optional<std::string> doubt_about(const EnergyRelease& release, const std::string& region) {
  if (std::isnan(release.G))
    return fmt::format(
        "energy release rate \"{}\": around ({:.4g}, {:.4g}, {:.4g}) m the ring reaches beyond the body; no value",
        region, release.tip.x(), release.tip.y(), release.tip.z());
  if (release.damaged_share > bearable_damaged_share)
    return fmt::format(
        "energy release rate \"{}\": {:.0f} % of it comes from damaged cells (d > 0.1); it is that of the far field "
        "only where the ring between inner and outer lies in undamaged material",
        region, 100.0 * release.damaged_share);
  return std::nullopt;
}

std::string no_intensity(const std::string& region, std::string_view why) {
  return fmt::format("energy release rate \"{}\": no stress intensities: {}", region, why);
}

}  // namespace

std::vector<std::string> energy_release_columns(const std::vector<TipRegion>& regions) {
  std::vector<std::string> names{"step", "load"};
  for (const TipRegion& region : regions) {
    std::vector<const char*> columns{"tip_x_m", "tip_y_m", "tip_z_m", "G_J_per_m2", "damaged_share"};
    if (region.reference_length > 0.0)
      columns.insert(columns.end(), {"K1_Pa_sqrt_m", "K2_Pa_sqrt_m", "phase_angle_degree"});
    for (const char* what : columns) names.push_back(fmt::format("{}_{}", region.name, what));
  }
  return names;
}

EnergyReleaseTable::EnergyReleaseTable(const std::filesystem::path& folder, const std::vector<TipRegion>& regions,
                                       std::optional<Index> last_step)
    : regions_(regions), table_(folder / energy_release_file, energy_release_columns(regions), last_step) {}

std::vector<std::string> EnergyReleaseTable::add(const Mesh& mesh, const FractureModel& model,
                                                 const FractureState& state, const OutputFields& output,
                                                 std::vector<bool>& said_of) {
  std::vector<std::string> warnings;
  std::vector<double> row{static_cast<double>(state.step), state.load};
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    const TipRegion& region = regions_[i];
    const EnergyRelease release = energy_release_rate(mesh, output, region);
    row.insert(row.end(), {release.tip.x(), release.tip.y(), release.tip.z(), release.G, release.damaged_share});
    std::optional<std::string> doubt = doubt_about(release, region.name);
    if (region.reference_length > 0.0) {
      const StressIntensity intensity = stress_intensity(mesh, model, output, region);
      row.insert(row.end(), {intensity.K1, intensity.K2, intensity.phase_angle * 180.0 / std::numbers::pi});
      if (!doubt && std::isnan(intensity.K1)) doubt = no_intensity(region.name, intensity.why_none);
    }
    if (said_of[i]) continue;
    if (doubt) warnings.push_back(*doubt);
    said_of[i] = doubt.has_value();
  }
  table_.append(std::move(row));
  return warnings;
}

std::map<std::string, double> EnergyReleaseTable::figures() const {
  std::map<std::string, double> figures;
  if (table_.rows().empty()) return figures;
  const std::vector<std::string>& names = table_.names();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::ranges::any_of(headline_endings, [&](std::string_view end) { return names[i].ends_with(end); }))
      figures["final_" + names[i]] = table_.rows().back()[i];
  return figures;
}

}  // namespace pfdm
