#pragma once
// Reads [[interface]]: cohesive interfaces between regions, or on a plane.

#include "cases/program/input/config/expression.h"
#include "cases/program/input/fields/amount.h"
#include "physics/random_field.h"
#include "solver/fracture/model/fracture_model.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pfdm {

/// A random factor of mean 1, lognormal.
struct Scatter {
  double coefficient = 0.0;  ///< standard deviation over mean
  RandomField field;
  double factor(const Vector& x) const;
};

struct InterfacePlane {
  Vector point, normal;  ///< [m]; unit
};

struct InterfaceSettings {
  std::string name;
  ConfigTable where;  ///< in the file, for messages
  std::optional<std::array<ConfigValue, 2>> between{};
  std::optional<InterfacePlane> plane{};
  std::optional<Expression> within{};  ///< not zero where the interface is
  InterfaceLaw law{};
  Parameter strength{}, toughness{};
  std::optional<Parameter> shear_strength{}, shear_toughness{};
  double stiffness = 0.0;  ///< [Pa/m]; zero: rigid at first, or the law's own
  std::optional<Scatter> strength_scatter{}, toughness_scatter{};
};

/// The traction-separation laws, and "table".
std::span<const TractionSeparationLaw> interface_laws();

/// `root` is the whole case file; tables that are named are added to `data_files`.
std::vector<InterfaceSettings> read_interfaces(const ConfigTable& root, const std::filesystem::path& case_directory,
                                               std::vector<std::filesystem::path>& data_files);

/// The law of an interface that is the same everywhere, by the keys of [[interface]] that do not say where it is.
struct UniformInterface {
  InterfaceLaw law;
  InterfaceStrength at;  ///< with a stiffness, where the law has a straight rise
};
/// Throws InputError for values that depend on the place as well, and for a rise without a stiffness or that would take
/// all the toughness.
UniformInterface read_uniform_interface(const ConfigTable& table, const std::filesystem::path& directory);

/// Throws InputError, with file and line, for regions that the mesh does not have, an interface without a face, and
/// values that are out of range at a face.
void place_interfaces(const std::vector<InterfaceSettings>& interfaces, const Mesh& mesh, FractureModel& model);

}  // namespace pfdm
