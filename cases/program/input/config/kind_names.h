#pragma once
// The kinds of case by name.

#include <string_view>

namespace pfdm {

/// All kinds that there are, in the full program's order: the words of the key "kind".
inline constexpr std::string_view all_kind_names[] = {"chain",         "endochronic", "fracture",    "homogenize",
                                                      "mass_material", "plate",       "viscoelastic"};

}  // namespace pfdm
