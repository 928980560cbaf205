#pragma once
// What `pfdm cohesive --export` was given, as it was typed.

#include <optional>
#include <string>
#include <vector>

namespace pfdm {

struct ExportWords {
  std::vector<std::string> formats{};  ///< none: no export
  std::string units = "SI";
  std::optional<std::string> surface{}, angle{}, stiffness{}, energy{}, shear_strength{}, shear_energy{};
  std::optional<double> exponent{};
};

}  // namespace pfdm
