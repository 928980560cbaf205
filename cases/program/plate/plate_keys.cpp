#include "cases/program/plate/plate_keys.h"

#include "cases/program/fracture/body/mesh/mesh_keys.h"
#include "cases/program/input/config/csv_keys.h"
#include "cases/program/input/config/heat_units.h"
#include "cases/program/input/config/key_member.h"
#include "cases/program/plate/plate_case.h"
#include "cases/program/plate/plate_fit_case.h"
#include "cases/program/studies/study_keys.h"

#include <vector>

namespace pfdm {
namespace {

constexpr Range loss_range{0.0, 2.0, true, "above 0 and below 2"};
constexpr Range counts{2.0, 100000.0, false, "between 2 and 100000"};
constexpr Range mode_count{1.0, 100.0, false, "between 1 and 100"};
constexpr Range frame_count{1.0, 1000.0, false, "between 1 and 1000"};
constexpr Range relative_range{0.0, 1.0, true, "above 0 and below 1"};
constexpr Range starts_range{1.0, 1000.0, false, "between 1 and 1000"};

std::vector<Key> patch_keys() {
  using namespace keys;
  return {{"patch", text("patch"), "or patches", "Name of the patch of the mesh."},
          {"patches", list(text("patch"), 1), "or patch", "Names of the patches of the mesh."}};
}

const KeyTable& modulus_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "material.modulus",
      .sentence = "Where the complex modulus over frequency is: a CSV file or a fit.",
      .keys = {{"csv", path(), "or fit", "CSV file with the columns frequency_Hz, storage_Pa and loss_Pa."},
               {"fit", path(), "or csv",
                "File fit.json of a mass-material case with a sample, whose Young's modulus is taken."}}};
  return table;
}

const KeyTable& temperature_keys() {
  using namespace keys;
  static const KeyTable table{.name = "material.temperature",
                              .sentence = "How modulus and loss factor change with temperature.",
                              .keys = {{"reference", quantity(dimension::temperature, range::positive), "",
                                        "Temperature at which modulus and loss factor are as given."},
                                       {"modulus", quantity(dimension::per_temperature), "0",
                                        "Relative change of the storage modulus per kelvin."},
                                       {"loss_factor", quantity(dimension::per_temperature), "0",
                                        "Relative change of the loss factor per kelvin."}}};
  return table;
}

const KeyTable& material_of_plate_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "material of a plate",
      .sentence = "The viscoelastic material of the body.",
      .keys = {
          {"density", quantity(dimension::density, range::positive), "", "Mass density of the body."},
          {"poisson_ratio", number(range::poisson_ratio), "", "Poisson's ratio, real and constant."},
          {"young_modulus", quantity(dimension::stress, range::positive), "or modulus",
           "Storage modulus E' at all frequencies."},
          {"loss_factor", number(loss_range), "or modulus", "Loss factor E''/E' (damping) at all frequencies."},
          {"modulus", keys::table(modulus_keys), "none",
           "Complex modulus over frequency from a file, in place of the two."},
          {"conductivity", quantity(dimension::conductivity, range::positive), "required with [heating]",
           "Thermal conductivity."},
          {"specific_heat", quantity(dimension::specific_heat, range::positive), "required with [heating]",
           "Specific heat capacity."},
          {"temperature", keys::table(temperature_keys), "none",
           "Changes of modulus and loss factor with temperature."},
      }};
  return table;
}

const KeyTable& support_keys() {
  using namespace keys;
  static const KeyTable table{.name = "support[]",
                              .sentence = "How patches of the body are held; patches that none names are free.",
                              .keys = joined({patch_keys(),
                                              {{"type", one_of("type of support", support_types()), "",
                                                "Type of support: clamped, pinned or symmetry."}}})};
  return table;
}

const KeyTable& base_keys() {
  using namespace keys;
  const KeyType frequency = quantity(dimension::frequency, range::positive);
  static const KeyTable table{
      .name = "base",
      .sentence = "The motion of the base that shakes the body.",
      .keys = {
          {"motion", one_of("motion of the base", base_motions()), "",
           "Motion of the base: harmonic, sweep or random."},
          {"direction", choice("axis", {"x", "y", "z"}), "\"z\"", "Direction of the base's motion."},
          {"level", quantity(dimension::acceleration, range::positive), "of random none",
           "Amplitude of the base's acceleration, as \"2 g0\"."},
          {"density", quantity(dimension::acceleration_density, range::positive), "required by random",
           "Spectral density of a random acceleration, one-sided, as \"0.05 g0^2/Hz\"."},
          {"frequency", either({frequency, choice("frequency", {"resonance"})}), "\"resonance\"",
           "Frequency of a harmonic motion, or the resonance of the largest power."},
          {"from", frequency, "required by sweep and random", "Lower end of the frequency band."},
          {"to", frequency, "required by sweep and random", "Upper end of the frequency band."},
          {"law", choice("law of a sweep", {"linear", "logarithmic"}), "\"linear\"",
           "How the frequency of a sweep moves in time."},
      }};
  return table;
}

const KeyTable& response_point_keys() {
  using namespace keys;
  static const KeyTable table{.name = "response.points[]",
                              .sentence = "A place where the frequency response is wanted.",
                              .keys = {{"name", text("plain name"), "", "Name of the place in the results."},
                                       {"at", point(), "", "The place; the nearest cell or surface face is taken."}}};
  return table;
}

const KeyTable& response_keys() {
  using namespace keys;
  const KeyType frequency = quantity(dimension::frequency, range::positive);
  static const KeyTable table{
      .name = "response",
      .sentence = "The frequency response and the modes that are computed.",
      .keys = {
          {"from", frequency, "", "Lowest frequency of the response."},
          {"to", frequency, "", "Highest frequency of the response."},
          stored<&PlateCase::n_frequencies>("frequencies", whole(counts), "Number of frequencies, in equal ratios."),
          stored<&PlateCase::n_modes>("modes", whole(mode_count),
                                      "Number of modes (eigenfrequencies) that are computed."),
          {"points", tables(response_point_keys), "", "Places where the frequency response function H1 is wanted."}}};
  return table;
}

const KeyTable& heating_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "heating",
      .sentence = "How long the body is heated by its damping, and where its temperature is told.",
      .keys = {
          {"duration", quantity(dimension::time, range::positive), "", "Duration of the motion that heats the body."},
          {"step", quantity(dimension::time, range::positive), "a 240th of the duration",
           "Time step of the heat equation."},
          {"surroundings", quantity(dimension::temperature, range::positive), "\"293.15 K\"",
           "Temperature at the start and of the surroundings."},
          {"surface", text("patch"), "", "Patch whose temperatures are told."}}};
  return table;
}

const KeyTable& cooling_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "cooling[]",
      .sentence = "How heat leaves the body through patches; others are insulated perfectly.",
      .keys = joined({patch_keys(),
                      {{"type", one_of("type of cooling", cooling_types()), "",
                        "Type: convection, insulation, conductance or a temperature."},
                       {"coefficient", quantity(dimension::heat_transfer, range::positive),
                        "required but by temperature", "Heat transfer coefficient to the surroundings."},
                       {"emissivity", number(range::fraction), "no radiation",
                        "Emissivity of the surface, for radiation beside convection."},
                       {"thickness", quantity(dimension::length, range::positive), "required by insulation",
                        "Thickness of the insulation."},
                       {"conductivity", quantity(dimension::conductivity, range::positive), "required by insulation",
                        "Thermal conductivity of the insulation."},
                       {"temperature", quantity(dimension::temperature, range::positive), "required by temperature",
                        "Temperature at which the patch is held."}}})};
  return table;
}

const KeyTable& plate_output_keys() {
  static const KeyTable table{
      .name = "output of a plate",
      .sentence = "What a run writes.",
      .keys = {stored<&PlateCase::n_frames>("frames", keys::whole(frame_count),
                                            "Number of frames of the fields after the first.")}};
  return table;
}

const KeyTable& measured_response_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit.responses[]",
      .sentence = "A measured frequency response.",
      .keys = joined({{{"name", text("plain name"), "", "Name of the measured response."}},
                      csv_keys(),
                      {{"point", text("name"), "", "Name of one of the response's points, where it was measured."},
                       {"frequency", keys::table(column_keys), "", "Column of the frequency."},
                       {"magnitude", keys::table(column_keys), "", "Column of the magnitude of H1."},
                       {"phase", keys::table(column_keys), "not measured", "Column of the phase of H1."},
                       {"deviation", number(relative_range), "",
                        "Standard deviation of the magnitude, relative, and of the phase in radians."}}})};
  return table;
}

const KeyTable& measured_rise_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit.temperatures[]",
      .sentence = "A measured rise of the surface's temperature.",
      .keys = joined(
          {{{"name", text("plain name"), "", "Name of the measured temperatures."}},
           csv_keys(),
           {{"of", choice("rise of the surface", {"mean", "largest"}), "",
             "Whether the mean or the largest rise of the surface was measured."},
            {"time", keys::table(column_keys), "", "Column of the time."},
            {"rise", keys::table(column_keys), "", "Column of the temperature's rise."},
            {"deviation", quantity(dimension::temperature, range::positive), "", "Standard deviation of the rise."}}})};
  return table;
}

const KeyTable& plate_fit_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit of a plate",
      .sentence = "Values that are estimated from measured responses and temperatures.",
      .keys = {fit_parameters_key(),
               {"responses", tables(measured_response_keys), "none", "Measured frequency responses."},
               {"temperatures", tables(measured_rise_keys), "none", "Measured temperatures."},
               {"starts", whole(starts_range), "1", "Number of descents: the first from the first guess."},
               finer_key("of up to nine layers of hexahedra five thirds of them, else none")}};
  return table;
}

}  // namespace

const KeyTable& plate_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "kind \"plate\"",
      .sentence = "A viscoelastic plate or other body on a shaker: modes, frequency response, heating.",
      .keys =
          joined({head_keys(),
                  {{"mesh", keys::table(mesh_keys), "", "Mesh of the body: generator or imported file."},
                   {"material", keys::table(material_of_plate_keys), "", "Viscoelastic material of the body."},
                   {"support", tables(support_keys), "", "How patches of the body are held."},
                   {"base", keys::table(base_keys), "", "Motion of the base."},
                   {"response", keys::table(response_keys), "", "Frequency response and modes."},
                   {"heating", keys::table(heating_keys), "none", "Heating by damping."},
                   {"cooling", tables(cooling_keys), "insulated", "How heat leaves the body."},
                   {"output", keys::table(plate_output_keys), "defaults", "What is written."},
                   {"fit", keys::table(plate_fit_keys), "none", "Values that pfdm fit estimates."},
                   {"sweep", keys::table(sweep_keys), "none", "Parameters with which pfdm sweep runs the case."}}})};
  return table;
}

}  // namespace pfdm
