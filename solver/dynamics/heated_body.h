#pragma once
// A body that is heated within and cooled at its surface: rho c_p dT/dt = div(k grad T) + q, by backward Euler, with an
// account of the energy. Temperatures are rises above a reference, which need not be that of the surroundings.

#include "solver/scalar/diffusion.h"

#include <memory>
#include <string>
#include <vector>

namespace pfdm {

struct HeatedMaterial {
  double conductivity = 0.0;  ///< [W/(m K)]
  double capacity = 0.0;      ///< rho c_p [J/(m^3 K)]
};

/// Conductance of layers in series [W/(m^2 K)]: of a thickness [m] of insulation, and of the air beyond it.
inline double conductance_of_insulation(double thickness, double conductivity, double beyond) {
  return 1.0 / (thickness / conductivity + 1.0 / beyond);
}

/// 4 emissivity sigma_SB T^3 [W/(m^2 K)]: of small differences from the surroundings at the temperature T [K].
double conductance_of_radiation(double emissivity, double temperature);

/// What went where since the start [J]; heat = stored + lost to within the solver's residual.
struct HeatAccount {
  double heat = 0.0;    ///< by the source
  double stored = 0.0;  ///< rho c_p times the rise, over the volume
  double lost = 0.0;    ///< through the surface
};

struct SurfaceTemperature {
  double mean = 0.0;     ///< over the area [K]
  double largest = 0.0;  ///< [K]
};

class HeatedBody {
 public:
  /// Starts at rise zero without a source. Patches that no boundary names are insulated. Throws InputError like
  /// Diffusion.
  HeatedBody(const Mesh& mesh, const HeatedMaterial& material, std::vector<DiffusionBoundary> boundary);
  HeatedBody(const HeatedBody&) = delete;
  HeatedBody& operator=(const HeatedBody&) = delete;

  /// [W/m^3] from now on.
  void set_source(CellField<double> source);
  /// Throws ComputationError if the step's equation is not solved.
  void step(double dt);

  const CellField<double>& rise() const { return rise_; }  ///< [K]
  const HeatAccount& account() const { return account_; }
  /// Of the faces of a patch, in its order [K].
  std::vector<double> face_rise(const std::string& patch) const { return face_rise(patch, rise_); }
  SurfaceTemperature surface(const std::string& patch) const { return surface(patch, rise_); }
  /// Likewise of another rise of the cells [K].
  std::vector<double> face_rise(const std::string& patch, const CellField<double>& rise) const;
  SurfaceTemperature surface(const std::string& patch, const CellField<double>& rise) const;

 private:
  const Mesh& mesh_;
  HeatedMaterial material_;
  std::vector<DiffusionBoundary> boundary_;
  CellField<double> source_, rise_;
  Diffusion diffusion_;
  HeatAccount account_;
};

}  // namespace pfdm
