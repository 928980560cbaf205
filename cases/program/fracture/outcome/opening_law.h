#pragma once
// The laws that the cohesive interfaces of a case have everywhere, as functions of the separation.

#include "cases/program/fracture/body/interface_reader.h"
#include "cases/program/studies/fit/curve_fit.h"

#include <vector>

namespace pfdm {

/// Whether strength and toughness are the same at all faces.
bool is_uniform(const InterfaceSettings& interface);

/// Of a uniform interface; a law that has a straight rise, and is given no stiffness, is stiff.
InterfaceStrength strength_everywhere(const InterfaceSettings& interface);

/// Size of the traction [Pa] of a virgin interface at a separation of this size [m].
double traction_along(const InterfaceLaw& law, const InterfaceStrength& at, const Vector& direction, double size);

/// The separation at which hardly anything is left of the traction [m].
double end_along(const InterfaceLaw& law, const InterfaceStrength& at, const Vector& direction);

/// In opening, of the case's uniform interfaces. Throws InputError for values that a run refuses.
std::vector<LawOfCase> opening_laws(const CaseFile& file);

}  // namespace pfdm
