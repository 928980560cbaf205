#pragma once
// Reads [experiment]: the measured curves that a fracture case is compared with.

#include "cases/program/fracture/case/event_case.h"
#include "cases/program/fracture/case/field_case.h"
#include "cases/program/input/config/config.h"
#include "postproc/curves/measured_curve.h"
#include "solver/fracture/model/energy_account.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// Debonding angles [rad] over displacements [m], measured at one pole.
struct MeasuredAngle {
  SampledCurve curve;
  std::string surface;      ///< a name of cohesive.json; empty: the first
  bool at_positive = true;  ///< pole, in the direction of the curve's displacement
};

/// Which energy of a run a measured one is compared with.
struct EnergyKind {
  std::string_view name;                                               ///< in case.toml, and of comparison_NAME.csv
  std::string_view description;                                        ///< in reports
  double (*of)(const EnergyAccount& start, const EnergyAccount& now);  ///< [J]
};
std::span<const EnergyKind> energy_kinds();

/// An energy [J] over displacements [m], such as another run's.
struct MeasuredEnergy {
  SampledCurve curve;
  const EnergyKind* kind = nullptr;
};

struct ExperimentSettings {
  std::vector<MeasuredCurve> specimens{};           ///< force [N] over displacement [m]
  double stiffness_from = 0.0, stiffness_to = 0.0;  ///< [m]
  std::vector<MeasuredAngle> angles{};              ///< all at the same pole of the same surface
  std::vector<MeasuredEnergy> energies{};
  std::vector<StatedEvent> events{};    ///< of the specimens' curves
  std::vector<FieldSettings> fields{};  ///< measured on the specimens
  ConfigTable where;                    ///< for messages
};

/// The specimens' own curves.
std::vector<SampledCurve> specimen_curves(const ExperimentSettings& experiment);

/// The record of one of the specimens with the crack lengths [m] that were read beside it as its `deviation`: NaN where
/// there is none, or none at all. Throws InputError like read_experiment.
MeasuredCurve read_fracture_test(const ConfigTable& specimen, const ConfigTable& experiment,
                                 const std::filesystem::path& case_directory);

/// What the set-up adds to each specimen's curve, alone. Throws InputError like read_experiment.
std::vector<SetUp> read_set_ups(const ConfigTable& root);

/// Nothing if there is no [experiment]. `root` is the whole case file. Throws InputError that names file and line.
std::optional<ExperimentSettings> read_experiment(const ConfigTable& root, const std::filesystem::path& case_directory);

}  // namespace pfdm
