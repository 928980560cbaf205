#pragma once
// The law of a cohesive interface, which its case gives, as other codes take it: nothing is extracted, and no run is
// needed.

#include "physics/interfaces/interface_law.h"
#include "postproc/exports/law/exported_law.h"

#include <string>
#include <vector>

namespace pfdm {

struct GivenLaw {
  std::string name;                    ///< of the interface, plain
  InterfaceLaw law;                    ///< as of its faces
  InterfaceStrength at;                ///< everywhere; stiffness zero: rigid at first, or the law's own rise
  std::vector<std::string> remarks{};  ///< source and frame
};

/// The bilinear set has strength, toughness, and the shear strength and toughness of the interface's rule of mixed
/// mode; the tables follow its law in opening, cut where a thousandth of the strength is left. A law that is rigid at
/// first has K in series, one with a stiffness of its own begins with it. Throws InputError for a choice of angle or
/// energy, which such a law leaves no room for, and as the other law_to_export().
ExportedLaw law_to_export(const GivenLaw& given, const ExportChoice& choice);

}  // namespace pfdm
