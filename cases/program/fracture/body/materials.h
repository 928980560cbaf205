#pragma once
// The materials of a case and the regions that they fill.

#include "cases/program/fracture/body/mesh/mesh_recipe.h"
#include "cases/program/input/config/config.h"
#include "solver/fracture/model/fracture_model.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct RegionMaterial {
  std::string region;
  ConfigValue where;                               ///< where the region was given its material
  std::function<RegionModel(const Vector& x)> at;  ///< at x [m]; throws InputError where a parameter is out of range
  bool varies = false;                             ///< from place to place
  std::string elastic_law;                         ///< equal texts are equal elasticities and histories
  std::shared_ptr<const Material> material;        ///< null: linear elastic
  EnergySplit split;                               ///< of its own, if one is chosen
  bool has_fatigue = false;                        ///< whether its toughness falls by fatigue
  std::optional<double> given_toughness{};         ///< of a band whose toughness was corrected, as given [J/m^2]
};

struct NamedElasticity {
  std::string material;
  std::optional<IsotropicElasticity> elasticity;  ///< none where it varies
};

struct Materials {
  std::vector<NamedElasticity> by_name;
  std::vector<RegionMaterial> by_region;
  std::vector<Band> bands;               ///< the mesh generator's and those that [regions.*] tell of
  bool corrects_toughness = true;        ///< of bands, for their neighbours
  std::vector<std::string> remarks;      ///< what was made of the numbers given, to be said in the log
  std::vector<std::string> idle_keys{};  ///< warnings of keys that change nothing

  bool has_fatigue() const { return std::ranges::any_of(by_region, &RegionMaterial::has_fatigue); }
  /// The elasticity of the material that `name` holds; throws InputError naming those there are, or if it varies.
  const IsotropicElasticity& elasticity(const ConfigValue& name) const;
};

/// A strength model of all damageable materials, and how its delta is found.
struct StrengthChoice {
  const StrengthLaw* law = nullptr;  ///< null: none
  std::optional<double> delta{};     ///< as given; else the law's own
  double mesh_size = 0.0;            ///< that the law's own takes into account [m]; 0: none
};

/// What [fracture] and the mesh say about all materials.
struct MaterialDefaults {
  const CrackGeometry* crack = nullptr;
  std::vector<Band> bands{};                ///< whose toughness is corrected for their neighbours'
  bool corrects_toughness = true;           ///< else it is taken as given
  std::optional<double> ell;                ///< of those that give no length of their own [m]
  Degradation degradation{};                ///< of materials that name none
  const SofteningLaw* softening = nullptr;  ///< likewise; for degradations that need a strength
  StrengthChoice strength{};
  bool loads_from_start = false;  ///< plain eigenstrains do not grow with the load
  /// Rows of keys of cases without damage, laws of materials and overrides by region: materials have their elasticity,
  /// and keys that the caller reads. Null: of all others.
  const KeyTable& (*elastic_keys)() = nullptr;
};

/// Reads [materials.*] and, on top of them, [regions.*]. `root` is the whole case file.
Materials read_materials(const ConfigTable& root, const MaterialDefaults& defaults);

/// Gives the model its regions, and its cells where a material varies. Throws InputError for a region without a
/// material, a material whose region is not in the mesh, and a parameter that is out of range in a cell.
void place_materials(const Materials& materials, const Mesh& mesh, FractureModel& model);

}  // namespace pfdm
