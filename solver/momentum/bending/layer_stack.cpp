#include "solver/momentum/bending/layer_stack.h"

#include <cmath>
#include <cstddef>

namespace pfdm {
namespace {

constexpr double one_layer = 1.5, two_layers = 2.5;  // of cells, at most

// Layers of one material side by side, from a height on; their stiffness about their own middle.
struct Material {
  Index cell = -1;
  double from = 0.0, thickness = 0.0, modulus = 0.0, count = 0.0;

  double own() const { return modulus * std::pow(thickness, 3) / 12.0; }
  double about(double height) const {
    return own() + modulus * thickness * std::pow(from + 0.5 * thickness - height, 2);
  }
};

std::vector<Material> materials_of(const std::vector<StackLayer>& layers) {
  std::vector<Material> all;
  Index zone = -1;
  double from = 0.0;
  for (const StackLayer& in : layers) {
    if (all.empty() || in.zone != zone) all.push_back({.cell = in.cell, .from = from, .modulus = in.modulus});
    from += in.thickness;
    all.back().thickness += in.thickness;
    all.back().count += in.count;
    zone = in.zone;
  }
  return all;
}

// The bending stiffness about the neutral axis, its height, and sum of E' t.
struct Stiffness {
  double bending = 0.0, height = 0.0, axial = 0.0;
};

Stiffness stiffness_of(const std::vector<Material>& materials) {
  Stiffness found;
  for (const Material& in : materials) {
    found.axial += in.modulus * in.thickness;
    found.height += in.modulus * in.thickness * (in.from + 0.5 * in.thickness);
  }
  found.height /= found.axial;
  for (const Material& in : materials) found.bending += in.about(found.height);
  return found;
}

void add_thin_materials(const std::vector<Material>& materials, const Stiffness& of, LayerStack& stack) {
  double largest = 0.0;
  bool is_lone = false;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    const Material& in = materials[k];
    if (in.count > two_layers) continue;
    const bool one = in.count < one_layer, at_surface = k == 0 || k + 1 == materials.size();
    (one ? stack.lone : (at_surface ? stack.beside : stack.between)) += in.own() / of.bending;
    (one ? stack.of_lone : stack.of_pairs) += in.about(of.height) / of.bending;
    if ((is_lone && !one) || (is_lone == one && in.own() <= largest)) continue;
    is_lone = one;
    largest = in.own();
    stack.thinnest = in.cell;
    stack.thinnest_thickness = in.thickness;
  }
}

}  // namespace

double LayerStack::even_layers() const { return 1.0 / std::sqrt(layers); }

LayerStack layer_stack(std::vector<StackLayer> layers, bool is_mirrored) {
  if (is_mirrored) layers.insert(layers.end(), layers.rbegin(), layers.rend());
  const std::vector<Material> materials = materials_of(layers);
  const Stiffness stiffness = stiffness_of(materials);
  LayerStack stack{.even_thickness = std::sqrt(12.0 * stiffness.bending / stiffness.axial),
                   .n_materials = static_cast<int>(materials.size())};
  double own = 0.0;  // of prisms: of the boxes that they are parts of
  for (const StackLayer& in : layers) own += in.modulus * in.thickness * std::pow(in.thickness / in.count, 2) / 12.0;
  stack.layers = own / stiffness.bending;
  if (materials.size() > 1) add_thin_materials(materials, stiffness, stack);
  return stack;
}

}  // namespace pfdm
