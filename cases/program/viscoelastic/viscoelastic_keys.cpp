#include "cases/program/viscoelastic/viscoelastic_keys.h"

#include "cases/program/input/config/csv_keys.h"
#include "cases/program/input/config/heat_units.h"
#include "cases/program/input/laws/prony_keys.h"
#include "cases/program/input/laws/temperature_shift_reader.h"
#include "cases/program/point/endochronic_case_keys.h"
#include "cases/program/studies/study_keys.h"

namespace pfdm {
namespace {

constexpr Range increments_range{1.0, 1e6, false, "between 1 and 1000000"};
constexpr Range branches_range{1.0, 15.0, false, "between 1 and 15"};
constexpr Range points_range{1.0, 1000.0, false, "between 1 and 1000"};
constexpr Range noise_range{0.0, 1.0, true, "above 0 and below 1"};

KeyType deformation() { return keys::choice("deformation", {"tension", "shear"}); }

const KeyTable& bulk_material_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "material of tests on the bulk material",
      .sentence = "The viscoelastic law, by the keys of law = \"prony\" of fracture cases.",
      .keys = joined({{{"young_modulus", quantity(dimension::stress, range::positive), "",
                        "Young's modulus E at rest for ever, the relaxed one."},
                       {"poisson_ratio", number(range::poisson_ratio), "",
                        "Poisson's ratio nu at rest for ever, the relaxed one."}},
                      prony_branch_keys(),
                      {temperature_shift_row("How the times of all branches depend on the temperature; of fits to "
                                             "tests with a temperature.")}})};
  return table;
}

const KeyTable& history_segment_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "loading.segments[] of viscoelastic material",
      .sentence = "A segment of the loading: a strain or a stress over time.",
      .keys = {
          {"duration", quantity(dimension::time, range::positive), "that of the CSV file", "Duration of the segment."},
          {"increments", whole(increments_range), "those of the CSV file",
           "Number of rows of the results; the response is exact where the load is linear in between."},
          {"spacing", choice("spacing", {"even", "logarithmic"}), "\"even\"",
           "How the rows are spread over the segment; logarithmic over six decades of its time."},
          {"strain", either({number(), quantity(dimension::number), keys::table(control_value_keys)}), "or stress",
           "Strain, of shear the engineering one: reached linearly at the end, or over time."},
          {"stress", either({quantity(dimension::stress), keys::table(control_value_keys)}), "or strain",
           "Stress: reached linearly at the end, or over time."}}};
  return table;
}

const KeyTable& history_loading_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "loading of viscoelastic material",
      .sentence = "A strain or a stress over time, from material at rest.",
      .keys = {{"deformation", deformation(), "\"tension\"",
                "Uniaxial stress with its strain, or shear stress with the engineering shear strain."},
               {"segments", tables(history_segment_keys), "",
                "Segments of the loading, one after the other; all of strain or all of stress."}}};
  return table;
}

const KeyTable& frequency_sweep_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "frequency_sweep",
      .sentence = "Frequencies at which the complex moduli are written, as of dynamic mechanical analysis (DMA).",
      .keys = {{"from", quantity(dimension::frequency, range::positive), "", "Lowest frequency, in cycles per second."},
               {"to", quantity(dimension::frequency, range::positive), "", "Highest frequency, in cycles per second."},
               {"points_per_decade", whole(points_range), "10", "Number of frequencies in each decade."}}};
  return table;
}

const KeyTable& frequency_column_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit.experiments[].frequency",
      .sentence = "The column of the frequency.",
      .keys = {
          {"column", column_type(), "", "Column of the CSV file: its name, or its number from 1."},
          {"unit", text("unit"), "that of the file",
           "Unit of the frequency, \"Hz\" with any prefix or \"rad/s\"; required where the file does not say it."}}};
  return table;
}

const KeyTable& temperature_column_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit.experiments[].temperature",
      .sentence = "The column of the temperature.",
      .keys = {{"column", column_type(), "", "Column of the CSV file: its name, or its number from 1."},
               {"unit", text("unit"), "that of the file",
                "Unit of the temperature, as \"degC\" or \"K\"; required where the file does not say it."}}};
  return table;
}

const KeyTable& bulk_test_keys() {
  using namespace keys;
  const KeyType column = keys::table(test_column_keys);
  static const KeyTable table{
      .name = "fit.experiments[] of viscoelastic material",
      .sentence = "A measured test on material at rest before: strain and stress over time, or DMA over frequency.",
      .keys = joined(
          {{{"name", text("name"), "", "Name of the test."}},
           csv_keys(),
           {{"deformation", deformation(), "\"tension\"",
             "Uniaxial stress with its strain, or shear stress with the engineering shear strain."},
            {"time", text("column"), "\"time_s\"", "Name of the column of the time."},
            {"time_unit", text("unit"), "\"s\"", "Unit of the column of the time."},
            {"ramp", quantity(dimension::time, range::not_negative), "0 s",
             "Time before the first row within which the load rose linearly from zero; 0: it was there at once."},
            {"controlled", choice("quantity that a test controls", {"strain", "stress"}), "\"strain\"",
             "Whether the test followed the strain or the stress, as creep tests do."},
            {"strain", column, "of tests over time", "Column of the strain, of shear the engineering one."},
            {"stress", column, "of tests over time", "Column of the stress."},
            {"frequency", keys::table(frequency_column_keys), "of DMA", "Column of the frequency."},
            {"temperature",
             either({quantity(dimension::temperature, range::positive), keys::table(temperature_column_keys)}), "none",
             "Temperature of the test, of DMA also a column; for materials with a temperature_shift."},
            {"storage_modulus", column, "none", "Column of the storage modulus E' or G'."},
            {"loss_modulus", column, "none", "Column of the loss modulus E'' or G''."},
            {"loss_factor", column, "none", "Column of the loss factor tan delta."}}})};
  return table;
}

const KeyTable& bulk_fit_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit of viscoelastic material",
      .sentence = "What of the Prony series is estimated, and from which tests.",
      .keys = {
          {"estimate",
           list(choice("part of the law that can be estimated",
                       {"young_modulus", "shear_branches", "temperature_shift", "poisson_ratio"})),
           "all but poisson_ratio",
           "Parts of the law that are estimated; bulk branches are not, a temperature_shift by tests at several "
           "temperatures."},
          {"branches", list(whole(branches_range), 2, 2), "those of [material]",
           "Least and largest number of shear branches that are tried."},
          {"times", choice("kind of relaxation times", {"free", "fixed"}), "\"free\"",
           "Times that are estimated, or fixed ones: of [material], or spread over the window of the data."},
          {"bounds",
           names(list(either({number(range::any), quantity(dimension::stress, range::positive),
                              quantity(dimension::time, range::positive),
                              quantity(dimension::temperature_difference, range::positive),
                              quantity(dimension::molar_energy, range::positive)}),
                      2, 2)),
           "wide", "Bounds of parameters by name, as young_modulus, modulus_1, time_1, C1, C2, activation_energy."},
          {"experiments", tables(bulk_test_keys), "", "Measured tests, fitted together."}}};
  return table;
}

}  // namespace

const KeyTable& test_column_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit.experiments[].storage_modulus",
      .sentence = "A column of a test, and how noisy it is.",
      .keys = joined({column_keys().keys,
                      {{"noise",
                        either({number(range::positive), quantity(dimension::stress, range::positive),
                                quantity(dimension::number, range::positive)}),
                        "the scatter about the fit", "Standard deviation of what was measured.", "measured"},
                       {"relative_noise", either({number(noise_range), quantity(dimension::number, noise_range)}),
                        "none", "Standard deviation in parts of the value, as 0.02 or \"2 %\".", "measured"}}}),
      .decided_by_reader = true};
  return table;
}

const KeyTable& viscoelastic_case_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "kind \"viscoelastic\"",
      .sentence = "Linear viscoelastic material in tests on the bulk: relaxation, creep, any strain, DMA.",
      .keys = joined(
          {head_keys(),
           {{"material", keys::table(bulk_material_keys), "", "Prony series of the material."},
            {"loading", keys::table(history_loading_keys), "none", "A strain or a stress over time."},
            {"frequency_sweep", keys::table(frequency_sweep_keys), "none",
             "Frequencies at which the complex moduli are written."},
            {"fit", keys::table(bulk_fit_keys), "none", "What of the Prony series is estimated from which tests."},
            {"sweep", keys::table(sweep_keys), "none", "Parameters with which pfdm sweep runs the case."}}})};
  return table;
}

}  // namespace pfdm
