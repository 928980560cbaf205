#include "postproc/curves/comparison_results.h"

#include "physics/angle.h"
#include "physics/error.h"
#include "physics/quantity_text.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/json.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

SampledCurve mean_curve(const ComparedCurves& curves) { return {.name = "mean", .x = curves.x, .y = curves.measured}; }

std::vector<std::string> names_of(const std::vector<SampledCurve>& curves) {
  std::vector<std::string> names;
  names.reserve(curves.size());
  for (const SampledCurve& curve : curves) names.push_back(curve.name);
  return names;
}

Json to_json(const CurveFigures& figures) {
  return {{"initial_stiffness_N_per_m", figures.initial_stiffness},
          {"peak_force_N", figures.peak_force},
          {"displacement_at_peak_m", figures.displacement_at_peak},
          {"work_J", figures.work}};
}

/// Of the model over the measured, less 1.
Json relative_differences(const CurveFigures& model, const CurveFigures& measured) {
  return {{"initial_stiffness", model.initial_stiffness / measured.initial_stiffness - 1.0},
          {"peak_force", model.peak_force / measured.peak_force - 1.0},
          {"displacement_at_peak", model.displacement_at_peak / measured.displacement_at_peak - 1.0},
          {"work", model.work / measured.work - 1.0}};
}

void add_differences(Json& json, const ComparedCurves& curves, const std::string& unit) {
  json["range_m"] = {curves.x.front(), curves.x.back()};
  json["rms_difference_" + unit] = curves.rms;
  json["largest_difference_" + unit] = curves.largest;
  json["displacement_of_largest_difference_m"] = curves.x_of_largest;
  json["rms_difference_over_largest_measured"] = curves.rms / curves.largest_measured;
  json["share_within_two_standard_deviations"] = curves.share_in_band ? Json(*curves.share_in_band) : Json();
}

Json to_json(const ForceComparison& force) {
  Json json;
  add_differences(json, force.curves, "N");
  json["stiffness_range_m"] = {force.stiffness_from, force.stiffness_to};
  json["model"] = to_json(force.model);
  json["measured_mean"] = to_json(force.mean);
  json["relative_difference"] = relative_differences(force.model, force.mean);
  for (std::size_t i = 0; i < force.names.size(); ++i) {
    Json specimen = to_json(force.specimens[i]);
    specimen["name"] = force.names[i];
    if (i < force.preparation.size() && !force.preparation[i].empty()) specimen["preparation"] = force.preparation[i];
    json["specimens"].push_back(specimen);
  }
  return json;
}

Json to_json(const AngleComparison& angle) {
  Json json;
  add_differences(json, angle.curves, "rad");
  json["model_onset_m"] = angle.model_onset ? Json(*angle.model_onset) : Json();
  json["measured_onset_m"] = angle.mean_onset ? Json(*angle.mean_onset) : Json();
  json["specimens"] = angle.names;
  return json;
}

Json to_json(const EnergyComparison& energy) {
  Json json = {{"kind", energy.kind}};
  add_differences(json, energy.curves, "J");
  json["model_at_end_J"] = energy.curves.model.back();
  json["measured_at_end_J"] = energy.curves.measured.back();
  json["specimens"] = energy.names;
  return json;
}

CsvTable energies_table(const std::vector<EnergyComparison>& energies) {
  CsvTable table;
  for (const char* name : {"kind", "displacement_m", "model_J", "measured_J"}) table.add(name, {});
  for (std::size_t k = 0; k < energies.size(); ++k) {
    table.comments.push_back(fmt::format("kind {}: {}", k, energies[k].kind));
    const ComparedCurves& curves = energies[k].curves;
    for (std::size_t i = 0; i < curves.x.size(); ++i) {
      const double row[] = {static_cast<double>(k), curves.x[i], curves.model[i], curves.measured[i]};
      for (std::size_t c = 0; c < table.columns.size(); ++c) table.columns[c].push_back(row[c]);
    }
  }
  return table;
}

void write_curves(const std::filesystem::path& file, const ComparedCurves& curves, const std::string& quantity) {
  CsvTable table;
  table.add("displacement_m", curves.x);
  table.add("model_" + quantity, curves.model);
  table.add("measured_" + quantity, curves.measured);
  if (!curves.deviation.empty()) table.add("measured_deviation_" + quantity, curves.deviation);
  write_csv(file, table);
}

}  // namespace

ForceComparison compare_forces(const SampledCurve& model, const std::vector<SampledCurve>& specimens,
                               double stiffness_from, double stiffness_to) {
  ForceComparison force{.curves = compare_curves(model, specimens),
                        .model = {},
                        .mean = {},
                        .names = names_of(specimens),
                        .specimens = {},
                        .stiffness_from = stiffness_from,
                        .stiffness_to = stiffness_to};
  if (stiffness_from < force.curves.x.front() || stiffness_to > force.curves.x.back())
    throw InputError(fmt::format("the stiffness is requested between {}; the common range of the curves is {}",
                                 quantities_text({stiffness_from, stiffness_to}, "m", " and "),
                                 quantities_text({force.curves.x.front(), force.curves.x.back()}, "m", " to ")));
  const auto figures = [&](const SampledCurve& curve) {
    return figures_of(curve, force.curves.x.front(), force.curves.x.back(), stiffness_from, stiffness_to);
  };
  force.model = figures(model);
  force.mean = figures(specimens.size() > 1 ? mean_curve(force.curves) : specimens.front());
  for (const SampledCurve& specimen : specimens) force.specimens.push_back(figures(specimen));
  return force;
}

AngleComparison compare_angles(const SampledCurve& model, const std::vector<SampledCurve>& specimens) {
  AngleComparison angle{
      .curves = compare_curves(model, specimens), .names = names_of(specimens), .model_onset = {}, .mean_onset = {}};
  angle.model_onset = onset_of(model, degree);
  angle.mean_onset = onset_of(specimens.size() > 1 ? mean_curve(angle.curves) : specimens.front(), degree);
  return angle;
}

EnergyComparison compare_energies(const std::string& kind, const SampledCurve& model,
                                  const std::vector<SampledCurve>& specimens) {
  return {.kind = kind, .curves = compare_curves(model, specimens), .names = names_of(specimens)};
}

void write_comparison(const std::filesystem::path& results, const ComparisonReport& report) {
  Json json = {{"case", report.case_name}, {"version", report.version}, {"case_hash", report.case_hash}};
  json["force_displacement"] = to_json(report.force);
  json["debonding_angle"] = report.angle ? to_json(*report.angle) : Json();
  json["energies"] = Json::array();
  for (const EnergyComparison& energy : report.energies) json["energies"].push_back(to_json(energy));
  if (!report.energies.empty()) write_csv(results / "comparison_energies.csv", energies_table(report.energies));
  write_curves(results / "comparison.csv", report.force.curves, "force_N");
  if (report.angle) write_curves(results / "comparison_debonding.csv", report.angle->curves, "angle_rad");
  write_file(results / "comparison.json", json_text(json));
}

}  // namespace pfdm
