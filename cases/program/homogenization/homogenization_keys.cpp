#include "cases/program/homogenization/homogenization_keys.h"

#include "cases/program/fracture/body/body_keys.h"
#include "cases/program/fracture/body/mesh/mesh_keys.h"
#include "cases/program/fracture/case/run_keys.h"
#include "cases/program/homogenization/homogenization_case.h"
#include "cases/program/input/config/key_member.h"
#include "cases/program/studies/study_keys.h"
#include "physics/elasticity/mandel.h"
#include "solver/homogenization/homogenization.h"
#include "solver/momentum/solution/preconditioner.h"

#include <fmt/format.h>

#include <string_view>

namespace pfdm {
namespace {

// Below, rounding would be solved for; above, the errors of the averages are no longer those of the mesh.
constexpr Range solvable{1e-12, 1e-4, false, "between 1e-12 and 1e-4"};

constexpr Range strain_range{-1.0, 1.0, true, "above -1 and below 1"};

std::string_view sentence_of_component(std::string_view key) {
  if (key.starts_with("stress")) return "Mean stress of this component at the point of the path.";
  if (key.starts_with("gamma"))
    return "Mean shear strain of engineering at the point of the path, above -1 and below 1.";
  return "Mean strain of this component (of the tensor) at the point of the path, above -1 and below 1.";
}

const KeyTable& path_keys() {
  static const KeyTable table = [] {
    KeyTable rows{
        .name = "homogenization.path[]",
        .sentence = "A point of the path: mean strains and stresses; components that are not named are free of stress.",
        .keys = {}};
    for (const std::string& key : mean_component_keys())
      rows.keys.push_back({key,
                           key.starts_with("stress")
                               ? keys::quantity(dimension::stress)
                               : keys::either({keys::number(strain_range), keys::quantity(dimension::number)}),
                           "free of stress", sentence_of_component(key)});
    return rows;
  }();
  return table;
}

const KeyTable& homogenization_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "homogenization",
      .sentence = "Boundary condition of the box, and the path along which it is strained.",
      .keys = {{"boundary", one_of("boundary condition of a homogenisation", homogenization_loadings()), "\"periodic\"",
                "Boundary condition of the box (RVE): periodic, uniform displacement or uniform traction."},
               {"path", list(keys::table(path_keys), 1), "none: effective linear stiffness",
                "Points of mean strain and stress along which the box is loaded while it breaks."}}};
  return table;
}

const KeyTable& composite_solver_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "solver of a composite",
      .sentence = "Tolerance and linear solver of the six load cases.",
      .keys = {stored<&HomogenizationSettings::tolerance>(
                   "tolerance", number(solvable), "Relative residual of the momentum balance of each load case."),
               {"linear", one_of("linear solver", linear_solvers()), "\"automatic\"",
                "Linear solver of the momentum balance."}}};
  return table;
}

}  // namespace

const std::vector<std::string>& mean_component_keys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all;
    for (const char* what : {"strain", "stress"})
      for (const std::string_view name : component_names) all.push_back(fmt::format("{}_{}", what, name));
    for (std::size_t k = 3; k < 6; ++k) all.push_back(fmt::format("gamma_{}", component_names[k]));
    return all;
  }();
  return keys;
}

const KeyTable& composite_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "kind \"homogenize\"",
      .sentence = "Effective linear stiffness of a meshed composite.",
      .keys =
          joined({head_keys(),
                  {{"mesh", keys::table(mesh_keys), "", "Mesh of the box: generator or imported file."},
                   {"materials", names(keys::table(composite_material_keys)), "",
                    "Materials by name, each of one region or more."},
                   {"homogenization", keys::table(homogenization_keys), "defaults", "Boundary condition of the box."},
                   {"solver", keys::table(composite_solver_keys), "defaults", "Tolerance and linear solver."},
                   {"sweep", keys::table(sweep_keys), "none", "Parameters with which pfdm sweep runs the case."}}})};
  return table;
}

const KeyTable& debonding_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "kind \"homogenize\" with a path",
      .sentence = "Stress-strain curve of a meshed composite while it debonds.",
      .keys = joined(
          {head_keys(),
           {{"mesh", keys::table(mesh_keys), "", "Mesh of the box: generator or imported file."},
            {"materials", names(keys::table(material_keys)), "", "Materials by name, each of one region or more."},
            {"regions", names(keys::table(region_keys)), "none",
             "What single regions have otherwise than their material."},
            {"fracture", keys::table(fracture_model_keys), "only interfaces break", "Phase-field model of fracture."},
            {"initial", keys::table(initial_damage_keys), "none", "Cracks and damage before the first step."},
            {"interface", tables(interface_keys), "none", "Cohesive interfaces without thickness."},
            {"homogenization", keys::table(homogenization_keys), "", "Boundary condition and path of the box."},
            {"loading", keys::table(loading_keys), "defaults", "Load parameter and its increments."},
            {"solver", keys::table(solver_keys), "defaults", "Tolerances and linear solver."},
            {"output", keys::table(box_output_keys), "defaults", "Fields that are written."},
            {"cohesive", keys::table(cohesive_keys), "defaults", "Surfaces whose cohesive laws are extracted."},
            {"sweep", keys::table(sweep_keys), "none", "Parameters with which pfdm sweep runs the case."}}})};
  return table;
}

}  // namespace pfdm
