#pragma once
// The damage that a fracture run left in the body and in cohesive interfaces, as pictures of a report.

#include "cases/program/fracture/case/fracture_case.h"
#include "postproc/curves/curve_csv.h"
#include "postproc/page/report_page.h"

#include <filesystem>
#include <vector>

namespace pfdm {

/// Of a body with three dimensions the planes xz and yz at the last frame, of a plate its middle
/// plane about half the way to the last frame and there, of a bar the damage along it. None without frames, or where
/// nothing but cohesive interfaces can break.
std::vector<PageBlock> damage_pictures(const FractureCase& fracture, const std::vector<CurveRow>& curve,
                                       const std::filesystem::path& results);

/// The cohesive interfaces about half the way to the last frame and there: surfaces seen from outside along an axis,
/// coloured by their damage; of strips the damage along them. None without interfaces.
std::vector<PageBlock> interface_pictures(const std::vector<CurveRow>& curve, const std::filesystem::path& results);

}  // namespace pfdm
