#include "postproc/reduction/test_methods.h"

#include <cmath>

namespace pfdm {
namespace {

constexpr ReducedSpecimen specimens[] = {
    {"double_cantilever_beam", "opening, mode I: ASTM D5528, ISO 15024, ISO 25217", double_cantilever_beam_methods},
    {"end_notched_flexure", "shear, mode II: ASTM D7905", end_notched_flexure_methods},
    {"mixed_mode_bending", "mixed modes by a lever: ASTM D6671", mixed_mode_bending_methods},
    {"compact_tension", "opening of a compact specimen: ASTM E399, D5045", compact_tension_methods,
     SecantRule{.compliance = 1.0 / 0.95, .or_greater_before = true}},
};

}  // namespace

std::span<const ReducedSpecimen> reduced_specimens() { return specimens; }

std::string missing_dimensions(std::initializer_list<std::pair<std::string_view, double>> needed) {
  std::string text;
  for (const auto& [name, value] : needed)
    if (std::isnan(value)) text += (text.empty() ? "needs " : ", ") + std::string(name);
  return text;
}

}  // namespace pfdm
