#include "cases/program/vibration/mass_material_keys.h"

#include "cases/program/input/config/key_member.h"
#include "cases/program/studies/study_keys.h"
#include "cases/program/vibration/mass_material_case.h"
#include "cases/program/vibration/mass_material_schedule.h"
#include "cases/program/vibration/vibration_reader.h"

namespace pfdm {
namespace {

constexpr Range count{0.0, 1e6, false, "between 0 and 1000000"};
constexpr Range exponent{0.0, 4.0, false, "between 0 and 4"};
constexpr Range decibel{-20.0, 200.0, false, "between -20 and 200"};
constexpr Range less_than_half{0.0, 0.4, false, "between 0 and 0.4"};
constexpr Range open_fraction{0.0, 1.0, true, "above 0 and below 1"};
constexpr Range samples{16.0, 16777216.0, false, "between 16 and 16777216"};
constexpr Range run_number{1.0, 1e6, false, "between 1 and 1000000"};
constexpr Range relative_slope{-1.0, 1.0, false, "between -1 and 1"};
constexpr Range relative_scatter{0.0, 0.5, false, "between 0 and 0.5"};
constexpr Range one_to_three{1.0, 3.0, false, "between 1 and 3"};
constexpr Range one_to_ten{1.0, 10.0, false, "between 1 and 10"};
constexpr Range up_to_six{0.0, 6.0, false, "between 0 and 6"};
constexpr Range kernel_orders{0.0, 20.0, false, "\"auto\" or between 0 and 6 (\"ten_step\": up to 20)"};
constexpr Range overlaps{0.0, 0.95, false, "between 0 and 0.95"};

constexpr Dimension damping_dimension{"damping coefficient", "N s/m", "70 N s/m"};

KeyType frequency() { return keys::quantity(dimension::frequency, range::positive); }
KeyType duration() { return keys::quantity(dimension::time, range::positive); }
KeyType acceleration() { return keys::quantity(dimension::acceleration, range::positive); }

KeyType stiffness_type() {
  KeyType any{.kind = KeyType::Kind::either};
  for (const Dimension& due : stiffness_dimensions()) any.parts.push_back(keys::quantity(due));
  return any;
}

KeyType beta_type() {
  using namespace keys;
  return either({quantity(stiffness_dimensions()[0]), quantity(beta_on_displacement()), quantity(beta_on_stiffness())});
}

const KeyTable& vibration_kernel_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "model.kernel[]",
      .sentence = "A term of the hereditary kernel, real or a conjugate pair.",
      .keys = {
          {"alpha", quantity(beta_on_stiffness(), range::positive), "", "Decay rate of the kernel's term."},
          {"alpha_imaginary", quantity(beta_on_stiffness()), "0", "Angular frequency of a conjugate pair of terms."},
          {"beta", beta_type(), "", "Weight of the kernel's term."},
          {"beta_imaginary", beta_type(), "0", "Imaginary part of the weight of a conjugate pair."}}};
  return table;
}

const KeyTable& model_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "model",
      .sentence = "The model of the sample under the mass, m z'' + c(z') + k(z) + v = -m y''.",
      .keys = {
          {"structure", one_of("mass-material model", model_structures()), "",
           "Structure of the model by its name in the report."},
          {"mass", quantity(dimension::mass, range::positive), "",
           "Mass of the plate, what is fixed to it and a third of the sample."},
          {"stiffness", list(stiffness_type(), 1, 7), "none: only fit",
           "Stiffness coefficients k1, k2 ... of the polynomial."},
          {"damping", quantity(damping_dimension), "0", "Damping coefficient c."},
          {"young_modulus", quantity(dimension::stress, range::positive), "none",
           "Young's modulus of the sample, a bar, in place of stiffness: k1 = E A/L."},
          {"loss_factor", number(range::not_negative), "none", "Loss factor of the sample in place of damping."},
          {"damping_exponent", number(exponent), "0", "Exponent lambda of nonlinear damping c z'|z'/V|^lambda."},
          {"reference_velocity", quantity(dimension::velocity, range::positive), "\"1 m/s\"",
           "Velocity V of nonlinear damping."},
          {"kernel", tables(vibration_kernel_keys), "no terms", "Terms of the hereditary kernel (Prony series)."},
      }};
  return table;
}

const KeyTable& sample_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "sample",
      .sentence = "The sample: its size, and what the table of the schedule says of it.",
      .keys = {
          {"length", quantity(dimension::length, range::positive), "with area",
           "Length of the sample; with it results have Young's modulus."},
          {"area", quantity(dimension::area, range::positive), "with length", "Area of the sample's cross-section."},
          stored<&SampleCard::name>("name", text("name"), "Name of the sample, for the table of the schedule.", "none"),
          stored<&SampleCard::composition>("composition", text("words"), "Composition of the sample in words.", "none"),
          {"cured", text("date"), "none", "Date of day 0, as \"2016-06-13\"."},
          stored<&SampleCard::planned_random>("planned_random", whole(count), "Number of planned random tests."),
          stored<&SampleCard::planned_harmonic>("planned_harmonic", whole(count),
                                                "Number of planned harmonic tests.")}};
  return table;
}

const KeyTable& sampling_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "sampling",
      .sentence = "How simulated tests are sampled.",
      .keys = {{"rate", frequency(), "", "Samples per second of simulated tests, as \"6 kHz\"."},
               stored<&MassMaterialCase::signal_to_noise>("signal_to_noise_dB", number(decibel),
                                                          "Signal-to-noise ratio of both simulated channels in dB."),
               stored<&MassMaterialCase::noise_seed>("noise_seed", whole(count), "Seed of the noise.")}};
  return table;
}

const KeyTable& excitation_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "test[].excitation",
      .sentence = "The motion of the base in a simulated test.",
      .keys = joined({{{"type", one_of("type of excitation", excitation_types()), "", "Type of the base's motion."},
                       {"level", acceleration(), "", "Amplitude of the base's acceleration.", "swept_sine harmonic"},
                       {"density", quantity(dimension::acceleration_density, range::positive), "",
                        "Spectral density of the acceleration.", "random"},
                       {"frequency", frequency(), "", "Frequency of the sine.", "harmonic"},
                       {"from", frequency(), "", "Lower end of the excited band, or where the sweep begins.",
                        "swept_sine random measured"},
                       {"to", frequency(), "", "Upper end of the excited band, or where the sweep ends.",
                        "swept_sine random measured"},
                       {"duration", duration(), "", "Duration of the motion.", "swept_sine harmonic random"},
                       {"law", choice("law of a sweep", {"linear", "logarithmic"}), "\"linear\"",
                        "How the frequency moves in time.", "swept_sine"},
                       {"ramp", quantity(dimension::time, range::not_negative), "1 % of the duration",
                        "Time in which the motion begins and ends.", "swept_sine harmonic"},
                       {"seed", whole(count), "1", "Seed of the random motion.", "random"}},
                      record_file_keys("measured")}),
      .decided_by = "type"};
  return table;
}

const KeyTable& record_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "test[].record",
      .sentence = "The record of a test: file, columns, units and the excited band.",
      .keys = joined({record_file_keys({}),
                      {{"base_file", path(), "file", "File of the base's channel, where it is another one."},
                       {"acceleration", choice("acceleration of the mass", {"relative", "absolute"}), "\"relative\"",
                        "Whether the column relative has the mass's acceleration relative to the base or absolute."},
                       {"base_unit", text("unit"), "unit", "Unit of the base's channel, where the two differ."},
                       {"relative_unit", text("unit"), "unit", "Unit of the relative channel, where the two differ."},
                       {"from", frequency(), "that of the excitation", "Lower end of the excited band."},
                       {"to", frequency(), "that of the excitation", "Upper end of the excited band."}}})};
  return table;
}

const KeyTable& schedule_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "test[].schedule",
      .sentence = "Where a test stands in the schedule of the sample.",
      .keys = {{"level", either({acceleration(), quantity(dimension::acceleration_density, range::positive)}), "",
                "Level of the test: amplitude or rms of the acceleration, or its density."},
               {"age", quantity(dimension::time, range::not_negative), "", "Age of the sample at the test."},
               {"run", whole(run_number), "1", "Number of the run within its day."},
               {"fractured", flag(), "false", "Whether the sample broke."}}};
  return table;
}

const KeyTable& test_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "test[]",
      .sentence = "A test on the shaker, simulated or recorded.",
      .keys = {{"name", text("plain name"), "", "Name of the test, of its files in the results."},
               {"excitation", keys::table(excitation_keys), "none: the test has a record", "Motion of the base."},
               {"record", keys::table(record_keys), "that which run wrote", "Measured record of the test."},
               {"predicted", flag(), "false", "Whether the test is predicted in place of fitted."},
               {"schedule", keys::table(schedule_keys), "none", "Level, age and run of the test, for repeatability."},
               {"date", text("date"), "none", "Date of the test, as \"2016-09-14\"."}}};
  return table;
}

const KeyTable& change_keys() {
  using namespace keys;
  using C = SampleChange;
  static const KeyTable table{
      .name = "change[]",
      .sentence = "How the simulated sample changes over the schedule.",
      .keys = {
          {"of", choice("parameter that changes", {"stiffness", "damping"}), "",
           "What changes: all stiffness, or damping."},
          stored<&C::per_g0>("per_g0", number(relative_slope), "Relative change for each g0 of the level."),
          stored<&C::per_day>("per_day", number(relative_slope), "Relative change for each day of age."),
          stored<&C::per_run>("per_run", number(relative_slope), "Relative change for each run of a day."),
          stored<&C::scatter>("scatter", number(relative_scatter), "Relative standard deviation from test to test.")}};
  return table;
}

const KeyTable& identification_keys() {
  using namespace keys;
  using F = MassMaterialFit;
  static const KeyTable table{
      .name = "fit of a mass-material model",
      .sentence = "How the model is identified from the records.",
      .keys = {
          {"method", one_of("method of identification", fit_methods()), "\"output_error\"",
           "Method of identification."},
          {"structure", one_of("mass-material model", model_structures()), "that of [model]",
           "Structure of the model to identify."},
          {"models", list(one_of("mass-material model", model_structures()), 1), "none",
           "Structures that are fitted one after the other and compared."},
          {"kernel_order", either({whole(kernel_orders), choice("order", {"auto"})}), "\"auto\"",
           "Number of kernel terms, or auto: by BIC."},
          stored<&F::maximum_kernel_order>("maximum_kernel_order", whole(up_to_six),
                                           "Largest number of kernel terms that auto tries."),
          stored<&F::crop>("crop", number(less_than_half), "Fraction of each record that is left out at either end."),
          stored<&F::replicates>("replicates", whole(count), "Number of bootstrap replicates for the intervals."),
          stored<&F::confidence>("confidence", number(open_fraction), "Confidence level of the intervals."),
          stored<&F::seed>("seed", whole(count), "Seed of the bootstrap."),
          stored<&F::repeatability>("repeatability", flag(),
                                    "Whether each record is fitted by itself as well, for the spread between tests."),
          {"ogden_terms", whole(one_to_three), "none",
           "Number of terms of Ogden's model fitted to the stiffness polynomial."},
      }};
  return table;
}

const KeyTable& analysis_keys() {
  using namespace keys;
  using A = AnalysisSettings;
  using S = SegmentSettings;
  static const KeyTable table{
      .name = "analysis",
      .sentence = "How pfdm analyse looks at the records.",
      .keys = {
          stored<&S::length>("segment", whole(samples), "Samples in a segment of the averaged spectra (Welch)."),
          stored<&S::overlap>("overlap", number(overlaps), "Overlap of neighbouring segments."),
          stored<&A::spectrogram_length>("spectrogram_segment", whole(samples),
                                         "Samples in a segment of the spectrogram.",
                                         "by the sweep, or a sixteenth of the record"),
          stored<&A::harmonics>("harmonics", whole(one_to_ten),
                                "Number of multiples of the driving frequency, from 1."),
          stored<&A::bandwidth>("bandwidth", frequency(), "Half width of the filters about the multiples.",
                                "4 Hz, at most 0.4 of the lowest frequency"),
      }};
  return table;
}

}  // namespace

const std::array<Dimension, 7>& stiffness_dimensions() {
  static constexpr std::array<Dimension, 7> all{{{"stiffness", "N/m", "2.8e6 N/m"},
                                                 {"stiffness of second order", "N/m^2", "1e9 N/m^2"},
                                                 {"stiffness of third order", "N/m^3", "1e12 N/m^3"},
                                                 {"stiffness of fourth order", "N/m^4", "1e15 N/m^4"},
                                                 {"stiffness of fifth order", "N/m^5", "1e19 N/m^5"},
                                                 {"stiffness of sixth order", "N/m^6", "1e22 N/m^6"},
                                                 {"stiffness of seventh order", "N/m^7", "1e26 N/m^7"}}};
  return all;
}

const Dimension& beta_on_displacement() {
  static constexpr Dimension weight{"kernel weight on z", "N/m/s", "-1e8 N/m/s"};
  return weight;
}

const Dimension& beta_on_stiffness() {
  static constexpr Dimension rate{"rate", "s^-1", "400 s^-1"};
  return rate;
}

const KeyTable& mass_material_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "kind \"mass_material\"",
      .sentence = "A mass on a sample on a shaker: simulation and identification.",
      .keys = joined(
          {head_keys(),
           {{"model", keys::table(model_keys), "", "Model of the sample under the mass."},
            {"sample", keys::table(sample_keys), "none", "Sample: size and history."},
            {"sampling", keys::table(sampling_keys), "required by simulated tests", "Sampling of simulated tests."},
            {"test", tables(test_keys), "", "Tests on the shaker."},
            {"change", tables(change_keys), "none", "Changes of the simulated sample over the schedule."},
            {"fit", keys::table(identification_keys), "defaults", "How the model is identified."},
            {"analysis", keys::table(analysis_keys), "defaults", "How pfdm analyse looks at the records."},
            {"sweep", keys::table(sweep_keys), "none", "Parameters with which pfdm sweep runs the case."}}})};
  return table;
}

}  // namespace pfdm
