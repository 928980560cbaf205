#pragma once
// stress_strain.csv: mean stress and strain of a box at each step, debonded areas and energies.

#include "cases/program/fracture/body/interface_reader.h"
#include "postproc/curves/curve_csv.h"
#include "postproc/files/step_table.h"

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pfdm {

/// Row and column of component_names.
inline constexpr std::array<std::array<int, 2>, 6> component_places{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

inline constexpr const char* means_file = "stress_strain.csv";
/// Of the same box where it is linear, without a path of mean strain.
inline constexpr const char* homogenized_file = "homogenized.json";
inline constexpr const char* load_cases_file = "homogenized.csv";

std::vector<std::string> columns_of_means(const std::vector<InterfaceSettings>& interfaces);
std::vector<double> row_of_means(const StepReport& report);

/// The step as force on a side of the box and its displacement: mean stress times the side's area, and mean strain
/// times the length across it, so that their product is the work; of a shear, twice the strain. `component`: of both.
CurveRow curve_row_of_box(const StepReport& report, const Vector& size, const std::array<int, 2>& component);

/// Peak, modulus at first and last values, with units in their names.
std::map<std::string, double> figures_of_means(const StepTable& table, const std::array<int, 2>& component);

/// Puts mean strains "..._strain_zz..." and stresses "..._stress_zz_..._Pa" in place of the displacements and forces
/// that curve_row_of_box() made of them.
void name_as_means(std::map<std::string, double>& figures, const Vector& size, const std::array<int, 2>& component);

/// Strain and stress [Pa] of a component, from the file.
struct MeanCurve {
  std::vector<double> strain, stress;
};
MeanCurve read_mean_curve(const std::filesystem::path& results, const std::vector<InterfaceSettings>& interfaces,
                          const std::array<int, 2>& component);

/// Of component_names: "zz".
std::string_view name_of_component(const std::array<int, 2>& component);

}  // namespace pfdm
