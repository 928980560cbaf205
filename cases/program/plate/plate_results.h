#pragma once
// The files of a run of a plate case, and what the page reads back of them. SI units, units in the names.

#include "cases/program/plate/plate_fit_case.h"
#include "postproc/curves/figures_summary.h"
#include "postproc/fields/pvd.h"
#include "postproc/fields/vtu_writer.h"
#include "solver/dynamics/modes.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfdm {

inline constexpr const char* response_file = "response.csv";
inline constexpr const char* modes_file = "modes.csv";
inline constexpr const char* temperature_file = "temperature.csv";
inline constexpr const char* surface_file = "surface_temperature.csv";

struct PlateProgram {
  CaseFile file;
  PlateCase parsed;
  std::optional<PlateFit> fit{};
  std::string name;
  std::string hash;
};

/// H1 of each point at each frequency, and the power per (m/s^2)^2.
struct ResponseTable {
  std::vector<double> frequency;                      ///< [Hz]
  std::vector<std::vector<std::complex<double>>> H1;  ///< of each point
  std::vector<double> power;                          ///< [W s^4/m^2]
};
void write_response(const std::filesystem::path& folder, const PlateCase& c, const ResponseTable& table);

/// A resonance: the frequency at which the modulus that the material has there makes the mode resonate.
struct Resonance {
  double frequency = 0.0;                  ///< [Hz]
  double loss_factor = 0.0;                ///< of the mode; twice its damping ratio
  Vector effective_mass = Vector::Zero();  ///< over the body's
};
void write_resonances(const std::filesystem::path& folder, const std::vector<Resonance>& resonances);

struct HeatingRow {
  double time = 0.0;           ///< [s]
  SurfaceTemperature surface;  ///< rise [K]
  double mean_rise = 0.0;      ///< over the volume [K]
  double largest_rise = 0.0;   ///< in a cell [K]
  double power = 0.0;          ///< mechanical, put in by the base [W]
  double correction = 0.0;     ///< of the heat source, so that it is the mechanical power, relative
  double work = 0.0;           ///< mechanical, since the start [J]
  HeatAccount account;         ///< [J]
  double resonance = 0.0;      ///< first [Hz]
};
void write_heating(const std::filesystem::path& folder, const std::vector<HeatingRow>& rows);

void write_surface(const std::filesystem::path& folder, const Mesh& mesh, const std::string& patch,
                   const std::vector<double>& rise);

/// Frames of one shape and a temperature that changes.
class PlateFrames {
 public:
  PlateFrames(std::filesystem::path folder, const Mesh& mesh);
  /// u per cell at the level of the excitation [m]. The deflection is u along the base's direction at the moment at
  /// which it is largest anywhere.
  void set_motion(const Eigen::VectorXcd& u, const Vector& direction);
  void add(double time, const CellField<double>& source, const CellField<double>& rise);

 private:
  std::filesystem::path folder_;
  VtuWriter writer_;
  PvdSeries series_;
  CellField<Vector> real_, imaginary_;
  CellField<double> deflection_;
};

}  // namespace pfdm
