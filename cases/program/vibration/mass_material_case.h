#pragma once
// Reads a case of kind "mass_material": the model, the vibration tests, what an identification is to do.

#include "cases/program/input/config/config.h"
#include "cases/program/vibration/mass_material_schedule.h"
#include "physics/point/mass_material.h"
#include "postproc/files/csv_table.h"
#include "solver/vibration/diagnosis/record_analysis.h"
#include "solver/vibration/simulation/vibration_excitation.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// Results have a file NAME.csv of each test, and one of its harmonics (sine) or spectra with these endings.
inline constexpr std::string_view result_endings[] = {"_harmonics", "_spectra"};

/// Where the record of a test is, and what its columns are called.
struct RecordFile {
  std::filesystem::path file;
  std::optional<std::filesystem::path> base_file;  ///< where the base has a file of its own
  std::string base = "base_acceleration";
  std::string relative = "relative_acceleration";
  std::string time = "time";
  bool names_time = false;                              ///< the case does, so that it must be there
  bool absolute = false;                                ///< `relative` holds the mass's own acceleration
  std::optional<std::string> base_unit, relative_unit;  ///< stand above those that the file states
  std::optional<std::string> time_unit;                 ///< likewise
  std::optional<double> rate;                           ///< [Hz]
  double usual_rate = 0.0;                              ///< of the case's other tests [Hz]; 0: not known
  CsvMarks marks{};                                     ///< of a CSV file
};

struct VibrationTest {
  std::string name;
  std::optional<Excitation> excitation;  ///< what run simulates
  std::optional<RecordFile> record;      ///< what fit reads; none: what run left in the results
  double band_low = 0.0;                 ///< [Hz]
  double band_high = 0.0;                ///< [Hz]
  bool predicted = false;                ///< not fitted but predicted
  std::optional<ScheduledRun> schedule;  ///< of repeated tests
  std::optional<std::string> date;       ///< "2016-09-14"
  std::optional<ConfigValue> where;
};

struct SampleSize {
  double length = 0.0;  ///< [m]
  double area = 0.0;    ///< [m^2]
};

struct MassMaterialFit {
  std::string method = "output_error";
  std::string structure;
  std::vector<std::string> models;  ///< structures to be fitted one after the other; none: `structure` alone
  std::optional<int> kernel_order;
  int maximum_kernel_order = 4;
  double crop = 0.05;
  int replicates = 500;
  double confidence = 0.95;
  std::uint64_t seed = 1;
  int ogden_terms = 0;         ///< of Ogden's model of the stiffness polynomial; 0: none
  bool repeatability = false;  ///< each record on its own as well, and how the parameters move over the schedule
};

struct MassMaterialCase {
  std::string title;
  std::string structure;
  MassMaterial model;
  bool has_parameters = false;            ///< stiffness and damping are given
  double rate = 0.0;                      ///< samples per second of what is simulated [Hz]; 0: nothing is
  std::optional<double> signal_to_noise;  ///< [dB]
  std::uint64_t noise_seed = 1;
  std::optional<SampleSize> sample;
  SampleCard card;
  std::vector<VibrationTest> tests;
  std::vector<SampleChange> changes;  ///< of the simulated sample over the schedule
  MassMaterialFit fit;
  AnalysisSettings analysis;
  std::vector<std::filesystem::path> data_files;
};

/// Structure, model and size of the sample alone, by [model] and [sample]; `root` may lack the rest of a case.
MassMaterialCase read_sample_model(const ConfigTable& root);
/// Throws InputError for a model that cannot be simulated: without stiffness, or not stable at rest.
void require_parameters(const MassMaterialCase& c);
/// What so many samples per second [Hz] resolve [Hz].
constexpr double highest_frequency(double rate) { return 0.38 * rate; }
/// Of a simulated test, sampled at `rate` [Hz]; files are seen from `directory` and named in `data_files`.
Excitation read_excitation(const ConfigTable& excitation, const std::filesystem::path& directory, double rate,
                           std::vector<std::filesystem::path>& data_files);

MassMaterialCase read_mass_material_case(const ConfigTable& root, const std::filesystem::path& case_directory);

/// [model] with these parameters, as TOML.
std::string model_text(std::string_view structure, const MassMaterial& model);

struct ExcitationType {
  std::string_view name;
  std::string_view description;
  Excitation (*read)(const ConfigTable& table, const std::filesystem::path& case_directory, double rate,
                     std::vector<std::filesystem::path>& data_files);
};
std::span<const ExcitationType> excitation_types();

struct FitMethod {
  std::string_view name;
  std::string_view description;
};
std::span<const FitMethod> fit_methods();

}  // namespace pfdm
