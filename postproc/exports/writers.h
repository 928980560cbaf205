#pragma once
// The writers of the formats: the input after the head. The law is in the units given. Each file cites what its layout
// was taken from.

#include "postproc/exports/law/exported_law.h"
#include "postproc/exports/law/unit_systems.h"

#include <string>

namespace pfdm {

std::string abaqus_input(const ExportedLaw& law, const UnitSystem& units);
std::string akantu_input(const ExportedLaw& law, const UnitSystem& units);
std::string lsdyna_input(const ExportedLaw& law, const UnitSystem& units);
std::string moose_input(const ExportedLaw& law, const UnitSystem& units);
std::string optistruct_input(const ExportedLaw& law, const UnitSystem& units);
std::string solids4foam_input(const ExportedLaw& law, const UnitSystem& units);
std::string table_input(const ExportedLaw& law, const UnitSystem& units);

}  // namespace pfdm
