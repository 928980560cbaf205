#include "cases/program/homogenization/homogenized_results.h"

#include "postproc/files/atomic_file.h"
#include "postproc/files/csv_table.h"
#include "postproc/files/json.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

// What each material adds to the stiffness.
std::vector<MandelMatrix> stiffness_by_material(const HomogenizationCase& homogenization, const Mesh& mesh,
                                                const Homogenized& result) {
  std::vector<MandelMatrix> parts;
  for (const CompositeMaterial& material : homogenization.by_name) {
    parts.emplace_back(MandelMatrix::Zero());
    for (const std::string& region : material.regions) parts.back() += result.of_region[mesh.region_index(region)];
  }
  return parts;
}

// Strain energy fractions, to first order in the loss: the imaginary part of the stiffness is the sum of the materials'
// parts times their factors. E = 9KG / (3K + G).
LossFactors loss_factors(const HomogenizationCase& homogenization, const std::vector<MandelMatrix>& parts) {
  MandelMatrix stored = MandelMatrix::Zero(), lost = MandelMatrix::Zero();
  for (std::size_t m = 0; m < parts.size(); ++m) {
    stored += parts[m];
    lost += homogenization.by_name[m].loss_factor * parts[m];
  }
  const IsotropicElasticity real = closest_isotropic(stored), imaginary = closest_isotropic(lost);
  const double K = real.bulk_modulus(), G = real.mu;
  const LossFactors loss{.bulk = imaginary.bulk_modulus() / K, .shear = imaginary.mu / G};
  return {loss.bulk, loss.shear, (G * loss.bulk + 3.0 * K * loss.shear) / (3.0 * K + G)};
}

Json to_json(const ModulusBounds& bounds) {
  return {{"bulk_modulus_lower_Pa", bounds.bulk_lower},
          {"bulk_modulus_upper_Pa", bounds.bulk_upper},
          {"shear_modulus_lower_Pa", bounds.shear_lower},
          {"shear_modulus_upper_Pa", bounds.shear_upper}};
}

Json phases(const HomogenizationCase& homogenization, const EffectiveMaterial& material) {
  Json list = Json::array();
  for (std::size_t m = 0; m < homogenization.by_name.size(); ++m)
    list.push_back({{"material", homogenization.by_name[m].name},
                    {"volume_fraction", material.fraction[m]},
                    {"energy_share", material.energy_share[m]},
                    {"loss_factor", homogenization.by_name[m].loss_factor}});
  return list;
}

double worst_residual(const Homogenized& result) {
  return std::ranges::max_element(result.cases, {}, &LoadCase::residual)->residual;
}

CsvTable load_cases(const Homogenized& result) {
  CsvTable table;
  table.comments = {"six load cases, one in a row: means over the box; shear strains are those of the tensor",
                    "constitutive: mean of C : eps with the mean strain of each cell"};
  for (const auto& [what, unit, of] :
       {std::tuple("strain", "", &LoadCase::strain), std::tuple("stress", "_Pa", &LoadCase::stress),
        std::tuple("constitutive_stress", "_Pa", &LoadCase::constitutive_stress)})
    for (int k = 0; k < n_components; ++k) {
      std::vector<double> values;
      for (const LoadCase& one : result.cases) values.push_back((one.*of)[k] / mandel_factor(k));
      table.add(fmt::format("{}_{}{}", what, component_names[k], unit), std::move(values));
    }
  return table;
}

}  // namespace

EffectiveMaterial effective_material(const HomogenizationCase& homogenization, const Mesh& mesh,
                                     const Homogenized& result) {
  const std::vector<MandelMatrix> parts = stiffness_by_material(homogenization, mesh, result);
  EffectiveMaterial material{.isotropic = closest_isotropic(result.stiffness),
                             .anisotropy = anisotropy(result.stiffness),
                             .universal_anisotropy = universal_anisotropy(result.stiffness),
                             .fraction = {},
                             .energy_share = {},
                             .density = 0.0,
                             .loss = loss_factors(homogenization, parts),
                             .hashin_shtrikman = {},
                             .reuss_voigt = {}};
  const double all = result.energy_stiffness().trace();
  for (std::size_t m = 0; m < parts.size(); ++m) {
    const CompositeMaterial& one = homogenization.by_name[m];
    double fraction = 0.0;
    for (const std::string& region : one.regions) fraction += result.fraction[mesh.region_index(region)];
    material.fraction.push_back(fraction);
    material.energy_share.push_back(parts[m].trace() / all);
    if (!one.density) material.density.reset();
    if (material.density) *material.density += fraction * *one.density;
  }
  if (const std::vector<Phase> known = phases_of(homogenization, mesh, result); !known.empty()) {
    material.hashin_shtrikman = hashin_shtrikman(known);
    material.reuss_voigt = reuss_voigt(known);
  }
  return material;
}

std::map<std::string, double> homogenized_figures(const HomogenizationCase& homogenization, const Homogenized& result,
                                                  const EffectiveMaterial& material) {
  std::map<std::string, double> figures{{"young_modulus_Pa", material.isotropic.young_modulus()},
                                        {"poisson_ratio", material.isotropic.poisson_ratio()},
                                        {"bulk_modulus_Pa", material.isotropic.bulk_modulus()},
                                        {"shear_modulus_Pa", material.isotropic.mu},
                                        {"anisotropy", material.anisotropy},
                                        {"stiffness_asymmetry", result.asymmetry},
                                        {"energy_difference", result.energy_difference()},
                                        {"constitutive_difference", result.constitutive_difference()}};
  for (std::size_t m = 0; m < homogenization.by_name.size(); ++m)
    figures["volume_fraction_" + homogenization.by_name[m].name] = material.fraction[m];
  if (material.density) figures["density_kg_per_m3"] = *material.density;
  if (material.loss.young > 0.0) figures["young_modulus_loss_factor"] = material.loss.young;
  return figures;
}

Json homogenized_json(const HomogenizationCase& homogenization, const Mesh& mesh, const Homogenized& result,
                      const EffectiveMaterial& material) {
  const IsotropicElasticity& closest = material.isotropic;
  Json json = {{"boundary", homogenization.settings.loading->name},
               {"cells", mesh.n_cells()},
               {"volume_m3", result.volume},
               {"notation", "Voigt: stress = stiffness times strain, shear strains of engineering (2 eps_yz ...)"},
               {"components", component_names},
               {"stiffness_Pa", pfdm::to_json(Eigen::MatrixXd(voigt_stiffness(result.stiffness)))},
               {"compliance_per_Pa", pfdm::to_json(Eigen::MatrixXd(voigt_compliance(result.stiffness)))},
               {"isotropic",
                {{"young_modulus_Pa", closest.young_modulus()},
                 {"poisson_ratio", closest.poisson_ratio()},
                 {"bulk_modulus_Pa", closest.bulk_modulus()},
                 {"shear_modulus_Pa", closest.mu},
                 {"anisotropy", material.anisotropy},
                 {"universal_anisotropy", material.universal_anisotropy}}},
               {"loss_factors",
                {{"young_modulus", material.loss.young},
                 {"bulk_modulus", material.loss.bulk},
                 {"shear_modulus", material.loss.shear}}},
               {"phases", phases(homogenization, material)},
               {"errors",
                {{"stiffness_asymmetry", result.asymmetry},
                 {"energy_difference", result.energy_difference()},
                 {"constitutive_difference", result.constitutive_difference()},
                 {"residual", worst_residual(result)}}}};
  if (material.density) json["density_kg_per_m3"] = *material.density;
  if (material.hashin_shtrikman)
    json["bounds"] = {{"hashin_shtrikman", to_json(*material.hashin_shtrikman)},
                      {"reuss_voigt", to_json(*material.reuss_voigt)}};
  return json;
}

std::string homogenized_like() {
  HomogenizationCase homogenization;
  homogenization.by_name.emplace_back();
  homogenization.settings.loading = &homogenization_loadings().front();
  EffectiveMaterial material;
  material.fraction = material.energy_share = {0.0};
  material.density = 0.0;
  material.hashin_shtrikman.emplace();
  material.reuss_voigt.emplace();
  Homogenized result;
  result.stiffness.setIdentity();
  return json_text(homogenized_json(homogenization, Mesh{}, result, material));
}

void write_homogenized(const std::filesystem::path& folder, const HomogenizationCase& homogenization, const Mesh& mesh,
                       const Homogenized& result, const EffectiveMaterial& material, const ResultOrigin& origin) {
  Json json = {{"case", origin.case_name}, {"case_hash", origin.case_hash}, {"version", origin.version}};
  json.update(homogenized_json(homogenization, mesh, result, material));
  write_file(folder / homogenized_file, json_text(json));
  write_csv(folder / load_cases_file, load_cases(result));
}

StoredHomogenized read_homogenized(const std::filesystem::path& path) {
  return read_json(path, "result of a homogenisation",
                   [](const Json& json) { return StoredHomogenized{.case_hash = json.at("case_hash"), .json = json}; });
}

}  // namespace pfdm
