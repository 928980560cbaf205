#include "postproc/cohesive/cohesive_results.h"

#include "physics/angle.h"
#include "physics/error.h"
#include "postproc/cohesive/flat_surface.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/json.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

// 15 and not 14.999999999999998.
double degrees(double angle) { return std::round(angle / degree * 1e9) / 1e9; }

/// Columns of a table of laws; the first of `numbers` tell which law it is.
class LawTable {
 public:
  explicit LawTable(std::vector<std::string> numbers) {
    for (const char* name : {"separation_m", "traction_Pa", "separation_1_m", "traction_1_Pa", "separation_2_m",
                             "traction_2_Pa", "surface_energy_J_per_m2", "largest_damage"})
      table_.add(name, {});
    for (std::string& name : numbers) table_.add(std::move(name), {});
    for (const char* name : {"polar_angle_from_deg", "polar_angle_to_deg", "step", "load"}) table_.add(name, {});
  }

  void add(const CohesiveLaw& law, const std::vector<double>& numbers, const std::vector<CurveRow>& curve) {
    for (std::size_t step = 0; step < law.states.size(); ++step) {
      const ColumnSample& s = law.states[step];
      std::size_t i = 0;
      const auto put = [&](double value) { table_.columns[i++].push_back(value); };
      for (Index k = 0; k < 3; ++k) {
        put(s.separation[k]);
        put(s.traction[k]);
      }
      put(s.surface_energy);
      put(s.largest_damage);
      for (const double number : numbers) put(number);
      put(degrees(law.from));
      put(degrees(law.to));
      put(static_cast<double>(step));
      put(curve[step].load);
    }
  }

  const CsvTable& table() const { return table_; }

 private:
  CsvTable table_;
};

Json to_json(const CohesiveFit& fit) {
  Json json = {{"law", fit.law},
               {"rms_misfit_over_strength", fit.rms},
               {"largest_misfit_over_strength", fit.largest},
               {"bayesian_information", fit.information}};
  for (std::size_t j = 0; j < fit.parameters.size(); ++j) {
    const FitEstimate& e = fit.result.estimates[j];
    json["parameters"].push_back({{"name", fit.parameters[j].name},
                                  {"unit", fit.parameters[j].unit},
                                  {"estimate", e.value},
                                  {"at_bound", e.at_bound}});
  }
  return json;
}

Json to_json(const CohesiveResult& result) {
  const CohesiveFigures& f = result.figures;
  Json json = {{"polar_angle_from_deg", degrees(result.law.from)},
               {"polar_angle_to_deg", degrees(result.law.to)},
               {"places", result.law.places.size()},
               {"area_m2", result.law.area},
               {"strength_Pa", f.strength},
               {"critical_separation_m", f.critical_separation},
               {"final_separation_m", f.final_separation},
               {"final_traction_Pa", f.final_traction},
               {"initial_stiffness_Pa_per_m", f.initial_stiffness},
               {"largest_tangential_traction_Pa", f.largest_tangential},
               {"mode_mixity_at_strength_deg", f.mixity_at_strength / degree},
               {"fracture_energy_J_per_m2", f.normal_energy + f.tangential_energy},
               {"fracture_energy_normal_J_per_m2", f.normal_energy},
               {"fracture_energy_tangential_J_per_m2", f.tangential_energy},
               {"fracture_energy_at_least_J_per_m2", f.energy_at_least},
               {"surface_energy_J_per_m2", f.surface_energy},
               {"bulk_separation_at_strength_m", f.bulk_separation},
               {"traced", f.is_traced()}};
  json["jump_at_step"] = f.jump ? Json(*f.jump) : Json();
  json["best_fit"] = result.fits.empty() ? Json() : Json(result.fits.front().law);
  json["fits"] = Json::array();
  for (const CohesiveFit& fit : result.fits) json["fits"].push_back(to_json(fit));
  return json;
}

/// Null where it varies from place to place.
Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json to_json(const GivenFigures& given) {
  return {{"law", given.law},
          {"mixed_mode", given.mixed_mode},
          {"strength_Pa", number_or_null(given.strength)},
          {"toughness_J_per_m2", number_or_null(given.toughness)},
          {"shear_strength_Pa", number_or_null(given.shear_strength)},
          {"shear_toughness_J_per_m2", number_or_null(given.shear_toughness)}};
}

/// Means over the faces of an interface whose law is given: where they open one after the other these follow no law.
Json mean_to_json(const CohesiveResult& result) {
  const CohesiveFigures& f = result.figures;
  return {{"polar_angle_from_deg", degrees(result.law.from)},
          {"polar_angle_to_deg", degrees(result.law.to)},
          {"faces", result.law.places.size()},
          {"area_m2", result.law.area},
          {"largest_mean_traction_Pa", f.strength},
          {"mean_separation_there_m", f.critical_separation},
          {"largest_mean_separation_m", f.final_separation},
          {"final_mean_traction_Pa", f.final_traction},
          {"largest_mean_tangential_traction_Pa", f.largest_tangential},
          {"work_of_tractions_at_least_J_per_m2", f.energy_at_least},
          {"dissipated_J_per_m2", f.surface_energy}};
}

Json surface_to_json(const CohesiveReport& report, std::size_t r) {
  const ColumnRecord& record = report.records[r];
  Json surface = {{"name", record.name}, {"kind", name_of(record.kind)}, {"law_is_given", record.is_cohesive}};
  surface["is_flat"] = is_flat(record.kind, record.places);
  if (r < report.given.size() && report.given[r]) surface["given_law"] = to_json(*report.given[r]);
  surface["places"] = record.places.size();
  surface["never_damaged_places"] = n_never_damaged(record);
  surface["area_m2"] = record.area();
  surface["debonded_area_m2"] = debonding_of(record).back().area;
  surface["laws"] = Json::array();
  if (record.is_cohesive) surface["means_over_faces"] = Json::array();
  for (const CohesiveResult& result : report.results[r])
    if (record.is_cohesive)
      surface["means_over_faces"].push_back(mean_to_json(result));
    else
      surface["laws"].push_back(to_json(result));
  return surface;
}

Json to_json(const CohesiveReport& report) {
  Json json = {{"case", report.case_name}, {"version", report.version}, {"case_hash", report.case_hash}};
  for (std::size_t r = 0; r < report.records.size(); ++r) json["surfaces"].push_back(surface_to_json(report, r));
  return json;
}

CsvTable debonding_table(const CohesiveReport& report) {
  CsvTable table;
  for (const char* name : {"surface", "step", "load", "displacement_m", "force_N", "debonded_area_m2",
                           "debonding_angle_plus_deg", "debonding_angle_minus_deg"})
    table.add(name, {});
  for (std::size_t r = 0; r < report.records.size(); ++r) {
    const std::vector<Debonding> history = debonding_of(report.records[r]);
    for (std::size_t step = 0; step < history.size(); ++step) {
      const CurveRow& row = report.curve[step];
      const Debonding& d = history[step];
      const double values[] = {static_cast<double>(r), static_cast<double>(step),   row.load,
                               row.displacement,       row.force[report.component], d.area,
                               degrees(d.angle_plus),  degrees(d.angle_minus)};
      for (std::size_t i = 0; i < table.columns.size(); ++i) table.columns[i].push_back(values[i]);
    }
  }
  return table;
}

// Names of the surfaces behind their numbers.
std::vector<std::string> surface_remarks(const CohesiveReport& report) {
  std::vector<std::string> lines;
  for (std::size_t r = 0; r < report.records.size(); ++r) {
    const ColumnRecord& record = report.records[r];
    lines.push_back(fmt::format("surface {}: {}", r, record.name));
    if (const std::size_t sound = n_never_damaged(record); sound > 0)
      lines.back() += fmt::format("; {} of {} places never damaged (d at most {:g}): no law", sound,
                                  record.places.size(), sound_damage);
    if (record.is_cohesive)
      lines.back() +=
          "; faces of a cohesive interface, whose law the case gives: means over faces, which open one after the "
          "other, "
          "are no law; surface_energy_J_per_m2: what they dissipated, largest_damage: that over their toughness";
  }
  return lines;
}

// What the columns of a table of laws mean.
constexpr const char* law_remarks[] = {
    "traction against separation of a surface; a row for each load step (step, load) of each law; all in SI units",
    "frame: n, the normal, from the particle outwards (of a plane: the normal given in [cohesive]); 1, the tangent of",
    "growing polar angle, away from the direction of the load; 2 = n x 1. Components are those of the outer side (of a",
    "plane: the side that n points to) against the inner one",
    "separation_m, traction_Pa: along n; opening and tension are > 0. Those with _1_: along 1; with _2_: along 2",
    "traction: at the middle of the column (of a plane: on it). separation: of the whole column, beyond elastic strain",
    "energy per area: int traction_Pa d separation_m, plus those of 1 and 2; surface_energy_J_per_m2: what damage took",
    "largest_damage: of the column's cells, 0 to 1",
    "polar_angle_from_deg, polar_angle_to_deg: of n from the direction of the load, in degrees; the law is the mean",
    "of the places between them, in bins of 15 degrees",
    "pfdm cohesive CASE --export FORMAT writes a law as input of other codes",
};

void write_table(const std::filesystem::path& file, CsvTable table, std::vector<std::string> remarks) {
  table.comments = std::move(remarks);
  write_csv(file, table);
}

}  // namespace

std::vector<CohesiveResult> evaluate(const ColumnRecord& record) {
  std::vector<CohesiveResult> results;
  for (CohesiveLaw& law : averaged_laws(record)) {
    CohesiveResult result{.law = std::move(law), .figures = {}, .fits = {}};
    result.figures = figures_of(record, result.law);
    if (result.figures.is_traced() && !record.is_cohesive) {
      std::vector<double> separation, traction;
      for (const ColumnSample& s : result.law.states) {
        separation.push_back(s.separation[0]);
        traction.push_back(s.traction[0]);
      }
      result.fits = fit_laws(separation, traction);
    }
    results.push_back(std::move(result));
  }
  return results;
}

void write_cohesive_results(const std::filesystem::path& results, const CohesiveReport& report) {
  LawTable averaged({"surface"}), places({"surface", "place"});
  for (std::size_t r = 0; r < report.records.size(); ++r) {
    const ColumnRecord& record = report.records[r];
    if (record.steps.size() != report.curve.size())
      throw InputError(fmt::format("{}: the columns of \"{}\" have {} steps, the curve has {}; run the case again",
                                   results.string(), record.name, record.steps.size(), report.curve.size()));
    const auto surface = static_cast<double>(r);
    for (const CohesiveResult& result : report.results[r]) averaged.add(result.law, {surface}, report.curve);
    for (std::size_t p = 0; p < record.places.size(); ++p)
      if (was_damaged(record, p)) places.add(law_at_place(record, p), {surface, static_cast<double>(p)}, report.curve);
  }
  const std::vector<std::string> surfaces = surface_remarks(report);
  std::vector<std::string> laws = surfaces;
  laws.insert(laws.end(), std::begin(law_remarks), std::end(law_remarks));
  laws.push_back(
      fmt::format("made by pfdm {} from the run of case {} ({})", report.version, report.case_name, report.case_hash));
  write_table(results / "cohesive_law.csv", averaged.table(), laws);
  write_table(results / "cohesive_law_places.csv", places.table(), laws);
  std::vector<std::string> debonding = surfaces;
  debonding.emplace_back(
      "debonding angles, in degrees: polar angle of the cap of the debonded area about the pole along (plus) and "
      "against "
      "(minus) the load");
  write_table(results / "debonding.csv", debonding_table(report), debonding);
  write_file(results / "cohesive.json", json_text(to_json(report)));
}

}  // namespace pfdm
