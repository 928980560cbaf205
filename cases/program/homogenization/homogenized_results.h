#pragma once
// homogenized.json and homogenized.csv: the effective stiffness and what goes with it.

#include "cases/program/fracture/outcome/mean_curve.h"
#include "cases/program/homogenization/homogenization_case.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// Loss factors of moduli [-].
struct LossFactors {
  double bulk = 0.0, shear = 0.0, young = 0.0;
};

/// What follows from a homogenisation.
struct EffectiveMaterial {
  IsotropicElasticity isotropic;                               ///< closest
  double anisotropy = 0.0;                                     ///< physics/elasticity/effective_stiffness.h
  double universal_anisotropy = 0.0;                           ///< likewise
  std::vector<double> fraction;                                ///< of the box's volume, by material
  std::vector<double> energy_share;                            ///< of the energy of all six unit strains, by material
  std::optional<double> density;                               ///< [kg/m^3]; none unless every material has one
  LossFactors loss;                                            ///< by the materials' shares of the strain energy
  std::optional<ModulusBounds> hashin_shtrikman, reuss_voigt;  ///< of uniform materials without voids
};

EffectiveMaterial effective_material(const HomogenizationCase& homogenization, const Mesh& mesh,
                                     const Homogenized& result);

/// Who made it.
struct ResultOrigin {
  std::string case_name, case_hash, version;
};

/// What homogenized.json says besides its origin.
nlohmann::ordered_json homogenized_json(const HomogenizationCase& homogenization, const Mesh& mesh,
                                        const Homogenized& result, const EffectiveMaterial& material);

/// Text of a homogenized.json with all that may be in one, and one material, which stands for all. The values mean
/// nothing.
std::string homogenized_like();

void write_homogenized(const std::filesystem::path& folder, const HomogenizationCase& homogenization, const Mesh& mesh,
                       const Homogenized& result, const EffectiveMaterial& material, const ResultOrigin& origin);

/// Headline figures with their unit in the name, for summary.json.
std::map<std::string, double> homogenized_figures(const HomogenizationCase& homogenization, const Homogenized& result,
                                                  const EffectiveMaterial& material);

struct StoredHomogenized {
  std::string case_hash;
  nlohmann::ordered_json json;
};
/// Throws InputError for what is no homogenized.json.
StoredHomogenized read_homogenized(const std::filesystem::path& path);

}  // namespace pfdm
