#include "cases/program/fracture/outcome/fracture_cohesive.h"

#include "cases/program/fracture/outcome/end_of_run.h"
#include "cases/program/fracture/outcome/fracture_files.h"
#include "cases/program/fracture/outcome/interface_chart.h"
#include "cases/program/fracture/outcome/law_source.h"
#include "cases/program/input/config/units.h"
#include "physics/angle.h"
#include "physics/error.h"
#include "physics/quantity_text.h"
#include "postproc/cohesive/cohesive_results.h"
#include "postproc/exports/export_formats.h"
#include "postproc/exports/law/given_law.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace pfdm {
namespace {

const CaseUnit metres{.si_unit = "m"}, pascals{.si_unit = "Pa"};

std::string outcome_of(const CohesiveResult& result) {
  const CohesiveFigures& f = result.figures;
  if (f.jump) {
    const auto separation = [&](std::size_t step) { return result.law.states[step].separation[0]; };
    return fmt::format("unstable at step {}: the law from {} to {} is unknown; int T ddelta at least {}", *f.jump,
                       shown_in(metres, separation(*f.jump - 1)), shown_in(metres, separation(*f.jump)),
                       quantity_text(f.energy_at_least, "J/m^2"));
  }
  if (!f.is_traced())
    return fmt::format("{} {} at the end; int T ddelta so far at least {}", f.unloaded ? "unloaded to" : "carries",
                       shown_in(pascals, f.final_traction), quantity_text(f.energy_at_least, "J/m^2"));
  const double work = f.normal_energy + f.tangential_energy;
  const std::string energy = std::isfinite(work) ? fmt::format("int T ddelta {}", quantity_text(work, "J/m^2", 6))
                                                 : fmt::format("int T ddelta at least {}, as some places are unstable",
                                                               quantity_text(f.energy_at_least, "J/m^2"));
  if (result.fits.empty()) return energy + ", too few states for a fit";
  return fmt::format("{}; nearest to \"{}\", rms {:.2g} % of the strength", energy, result.fits.front().law,
                     100.0 * result.fits.front().rms);
}

std::string extent_of(const ColumnRecord& record) {
  const std::size_t n = record.places.size(), sound = n_never_damaged(record);
  if (sound == n) return fmt::format("{} places: never damaged (d at most {:g}), no law", n, sound_damage);
  const std::string left_out = sound > 0 ? fmt::format(" ({} never damaged, left out)", sound) : "";
  return fmt::format("{} places{}, debonded area {}", n, left_out,
                     shown_in({.si_unit = "m^2"}, debonding_of(record).back().area));
}

/// The strength in shear of a record's band over that in opening: (mu/M)^(1/2) where its energy drives the damage.
std::optional<double> shear_ratio_of(const FractureCase& fracture, const ColumnRecord& record) {
  constexpr std::string_view driven_by_energy[] = {"none", "volumetric_deviatoric", "star_convex", "hybrid"};
  const auto band = std::ranges::find_if(fracture.cohesive.bands, [&](const Band& b) {
    return record.name == b.region || record.name.starts_with(b.region + "_");
  });
  if (record.is_cohesive || band == fracture.cohesive.bands.end() || fracture.model.has_strength()) return std::nullopt;
  const RegionMaterial& material =
      *std::ranges::find(fracture.materials.by_region, band->region, &RegionMaterial::region);
  if (material.varies || material.material) return std::nullopt;
  const RegionModel region = material.at(Vector::Zero());
  if (std::ranges::count(driven_by_energy, fracture.model.split_of(region).name()) == 0) return std::nullopt;
  return std::sqrt(region.elasticity.mu / region.elasticity.constrained_modulus());
}

std::string words_of_law(const CohesiveResult& result, SurfaceKind kind) {
  const CohesiveFigures& f = result.figures;
  const std::string where = kind == SurfaceKind::plane ? std::string("  mean")
                                                       : fmt::format("  {:3.0f} to {:3.0f} degrees",
                                                                     result.law.from / degree, result.law.to / degree);
  if (!(f.strength > 0.0)) return where + ": always in compression";
  return fmt::format("{}: largest normal traction {} at {}, {}; surface energy {}", where,
                     shown_in(pascals, f.strength), shown_in(metres, f.critical_separation), outcome_of(result),
                     quantity_text(f.surface_energy, "J/m^2"));
}

constexpr Dimension stiffness_per_area{"stiffness per area", "Pa/m", "1e14 Pa/m"};

/// Of an option; throws InputError that names it.
std::optional<double> option_value(const char* name, const std::optional<std::string>& text, const Dimension& due,
                                   bool zero = false) {
  if (!text) return std::nullopt;
  try {
    const double value = parse_quantity(*text, due);
    if (value < 0.0 || (value == 0.0 && !zero)) throw InputError(fmt::format("\"{}\" must be positive", *text));
    return value;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  }
}

ExportChoice choice_of(const ExportWords& words) {
  if (words.exponent && !(*words.exponent > 0.0)) throw InputError("--exponent: must be positive");
  return {.surface = words.surface,
          .angle = option_value("--angle", words.angle, dimension::angle, true),
          .stiffness = option_value("--stiffness", words.stiffness, stiffness_per_area),
          .energy = option_value("--energy", words.energy, dimension::toughness),
          .shear_strength = option_value("--shear-strength", words.shear_strength, dimension::stress),
          .shear_energy = option_value("--shear-energy", words.shear_energy, dimension::toughness),
          .exponent = words.exponent};
}

struct Export {
  std::vector<ExportFormat> formats;
  UnitSystem units;
  ExportChoice choice;
};

Export read_export(const ExportWords& words) {
  return {formats_named(words.formats), unit_system(words.units), choice_of(words)};
}

void write_law(const Export& wanted, const ExportedLaw& law, Session& session) {
  const auto files = write_exports(session.results, wanted.formats, law, wanted.units);
  session.log.say(
      fmt::format("exported law of \"{}\": strength {}, GI {}, stiffness {}; tables of {} and {} points, within {:.2g} "
                  "and {:.2g} % of the strength",
                  law.surface, shown_in(pascals, law.strength.value), quantity_text(law.energy.value, "J/m^2", 6),
                  quantity_text(law.stiffness.value, "Pa/m"), law.curve.size(), law.damage.size(),
                  100.0 * law.curve_error, 100.0 * law.damage_error));
  for (const auto& file : files) session.log.say(fmt::format("written to {}", file.string()));
}

/// The interface whose own law is asked for; null where it is one of the record's.
const InterfaceSettings* interface_asked_for(const FractureCase& fracture, const ExportWords& words) {
  const std::vector<InterfaceSettings>& interfaces = fracture.interfaces;
  if (words.surface) {
    const auto found = std::ranges::find(interfaces, *words.surface, &InterfaceSettings::name);
    if (found != interfaces.end()) return &*found;
  }
  if (interfaces.empty() || !fracture.cohesive.bands.empty() || !fracture.cohesive.planes.empty()) return nullptr;
  if (!words.surface && interfaces.size() == 1) return &interfaces.front();
  std::vector<std::string> names;
  names.reserve(interfaces.size());
  for (const InterfaceSettings& interface : interfaces) names.push_back(interface.name);
  const std::string there = fmt::format("available: {}", fmt::join(names, ", "));
  throw InputError(words.surface ? fmt::format("--surface: there is no surface \"{}\" ({})", *words.surface, there)
                                 : fmt::format("--surface: say which interface's law is to be written ({})", there));
}

GivenLaw law_of_case(const InterfaceSettings& interface, const std::string& name, const std::string& hash,
                     std::vector<std::string> source, const Session& session) {
  const auto everywhere = [&](const Parameter& parameter, const char* key) {
    if (parameter.varies)
      throw interface.where.at(key).error("a value that varies from place to place cannot be written for other codes");
    return parameter.at(Vector::Zero());
  };
  GivenLaw given{.name = interface.name, .law = interface.law, .at = {.stiffness = interface.stiffness}};
  given.at.strength = everywhere(interface.strength, "strength");
  given.at.toughness = everywhere(interface.toughness, "toughness");
  if (interface.shear_strength) given.at.shear_strength = everywhere(*interface.shear_strength, "shear_strength");
  if (interface.shear_toughness) given.at.shear_toughness = everywhere(*interface.shear_toughness, "shear_toughness");
  given.remarks = {
      fmt::format("pfdm {}, case {} ({}), [[interface]] {}: the law as the case gives it", session.version, name, hash,
                  interface.name),
      fmt::format("Frame: normal {}; opening and tension are positive; the two tangential directions are equal",
                  interface.between
                      ? fmt::format("from {} to {}", (*interface.between)[0].string(), (*interface.between)[1].string())
                      : "of the plane")};
  if (interface.law.law->name == tabulated_law().name)
    given.remarks.push_back(
        fmt::format("Table: {}; its head says what it is of", interface.where.at("table").string()));
  for (std::string& line : source) given.remarks.push_back(std::move(line));
  if (interface.strength_scatter || interface.toughness_scatter)
    given.remarks.emplace_back("Strength or toughness scatter about these values in the case; here they do not");
  return given;
}

CohesiveReport report_of(const FractureCase& fracture, const std::string& name, const std::string& hash,
                         const Session& session) {
  CohesiveReport report{.case_name = name,
                        .case_hash = hash,
                        .version = session.version,
                        .records = read_column_record(session.results, hash),
                        .results = {},
                        .curve = read_curve_record(session.results, hash),
                        .component = fracture.output.curve.component};
  for (const ColumnRecord& record : report.records) {
    report.results.push_back(evaluate(record));
    report.shear_ratios.push_back(shear_ratio_of(fracture, record));
    const auto given = std::ranges::find(fracture.interfaces, record.name, &InterfaceSettings::name);
    report.given.push_back(
        record.is_cohesive && given != fracture.interfaces.end() ? std::optional(given_figures(*given)) : std::nullopt);
  }
  return report;
}

void say_laws(const CohesiveReport& report, const Session& session, bool in_run) {
  for (std::size_t r = 0; r < report.records.size(); ++r) {
    const ColumnRecord& record = report.records[r];
    session.log.say(fmt::format("{} \"{}\", {}", record.is_cohesive ? "cohesive interface" : "cohesive law of",
                                record.name, extent_of(record)));
    if (record.is_cohesive) continue;
    for (const CohesiveResult& result : report.results[r]) {
      const std::string line = words_of_law(result, record.kind);
      in_run ? session.log.record(line) : session.log.say(line);
    }
  }
}

}  // namespace

void write_cohesive_laws(const FractureCase& fracture, const CaseFile& file, const std::string& name,
                         const std::string& hash, Session& session, bool in_run) {
  std::optional<Export> wanted;  // what is wrong with it is said before anything is written
  if (!session.exports.formats.empty()) {
    wanted = read_export(session.exports);
    if (const InterfaceSettings* interface = interface_asked_for(fracture, session.exports)) {
      const auto index = static_cast<std::size_t>(interface - fracture.interfaces.data());
      std::vector<std::string> source = source_of_law(file, index, interface->name, hash, session);
      const GivenLaw given = law_of_case(*interface, name, hash, std::move(source), session);
      return write_law(*wanted, law_to_export(given, wanted->choice), session);
    }
  } else if (!fracture.interfaces.empty() && fracture.cohesive.bands.empty() && fracture.cohesive.planes.empty() &&
             fracture.cohesive.faces.empty()) {
    throw InputError(fmt::format(
        "{}: [cohesive] names no interface, no band and no plane. The laws of [[interface]] are those that the case "
        "gives: --export FORMAT writes one for another code",
        name));
  }
  const CohesiveReport report = report_of(fracture, name, hash, session);
  write_cohesive_results(session.results, report);
  say_laws(report, session, in_run);
  session.log.say(fmt::format("written to {}", (session.results / "cohesive.json").string()));
  if (wanted) write_law(*wanted, law_to_export(report, wanted->choice), session);
}

}  // namespace pfdm
