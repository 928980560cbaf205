#pragma once
// Reads a case of kind "plate": a viscoelastic body on a shaker, and how it is cooled.

#include "cases/program/fracture/body/mesh/mesh_recipe.h"
#include "cases/program/input/config/config.h"
#include "solver/dynamics/base_response.h"
#include "solver/dynamics/heated_body.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// Storage modulus and loss factor at a frequency [Hz].
struct ModulusAt {
  double frequency = 0.0;
  double storage = 0.0;      ///< E' [Pa]
  double loss_factor = 0.0;  ///< E''/E' [-]
};

struct PlateMaterial {
  double density = 0.0;            ///< [kg/m^3]
  double poisson_ratio = 0.0;      ///< real
  std::vector<ModulusAt> modulus;  ///< one row: at all frequencies; more, ascending: linear in the logarithm of f
  double reference = 0.0;          ///< temperature of these values [K]
  double modulus_slope = 0.0;      ///< relative change of E' with temperature [1/K]
  double loss_slope = 0.0;         ///< of the loss factor
  HeatedMaterial heat;

  /// c E with E the first row's storage modulus, at a temperature [K].
  Harmonic at(double frequency, double temperature) const;
  double young_modulus() const { return modulus.front().storage; }
  bool depends_on_temperature() const { return modulus_slope != 0.0 || loss_slope != 0.0; }
};

struct ResponsePoint {
  std::string name;
  Vector at = Vector::Zero();  ///< [m]
};

struct PlateExcitation {
  std::string type;                 ///< "harmonic", "sweep" or "random"
  double level = 0.0;               ///< amplitude of the acceleration [m/s^2], or its density [m^2/s^4/Hz]
  std::optional<double> frequency;  ///< of a harmonic motion [Hz]; none: at resonance
  double from = 0.0, to = 0.0;      ///< of the others [Hz]
  bool logarithmic = false;         ///< sweep
};

struct PlateHeating {
  double duration = 0.0;                    ///< [s]
  double step = 0.0;                        ///< [s]
  double surroundings = 0.0;                ///< temperature at the start, and of the air [K]
  std::string surface;                      ///< patch that the camera sees
  std::vector<DiffusionBoundary> boundary;  ///< of the rise above the surroundings
};

struct PlateCase {
  std::string title;
  MeshRecipe mesh;
  PlateMaterial material;
  std::vector<BoundaryCondition> supports;
  Vector direction = Vector::UnitZ();  ///< of the base's motion
  double from = 0.0, to = 0.0;         ///< of the frequency response [Hz]
  int n_frequencies = 200;
  int n_modes = 6;
  std::vector<ResponsePoint> points;
  PlateExcitation excitation;
  std::optional<PlateHeating> heating;
  int n_frames = 4;
  std::vector<std::filesystem::path> data_files;
};

/// Throws InputError.
PlateCase read_plate_case(const ConfigTable& root, const std::filesystem::path& case_directory);

struct PlateWord {
  std::string_view name;
  std::string_view description;
};
std::span<const PlateWord> support_types();
std::span<const PlateWord> base_motions();
std::span<const PlateWord> cooling_types();

}  // namespace pfdm
