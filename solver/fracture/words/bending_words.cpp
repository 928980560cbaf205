#include "solver/fracture/words/bending_words.h"

#include "physics/quantity_text.h"
#include "solver/momentum/bending/bending_layers.h"
#include "solver/momentum/bending/slender_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace pfdm {
namespace {

constexpr double bearable_bending = 0.03;
constexpr double layers_for_it = 10.0;  // even ones of one material: (3 - 2/n)/n^2 is then 2.8 %

// Whether plane meshes fit cubics; else they have lines of cells, and prisms gradients of one ring.
bool fits_cubics(const FractureModel& model) {
  return model.is_isotropic() && !model.is_finite_strain() && !model.has_eigenstrain() &&
         std::ranges::all_of(model.regions, [](const RegionModel& region) { return region.material == nullptr; });
}

std::string length_words(double metres, int digits) { return quantity_text(metres, "m", digits); }

// On materials of one cell across, or else of two, of which a part of what they have about their own middles is
// missing.
std::string words_on_thin(const BendingError& worst) {
  const LayerStack& stack = worst.layers.stack;
  const bool is_lone = stack.lone > 0.0, by_cubics = worst.by == BendBy::cubics;
  return fmt::format(
      "too low (materials of {} across have {:.0f} % of it about their own middles, of which {} is missing, within a "
      "third; one is {} thick). For {:.0f} %: {} cells across each material ([mesh])",
      is_lone ? "one cell" : "two cells", 100.0 * (is_lone ? stack.lone : stack.beside + stack.between),
      by_cubics ? "0.9" : (is_lone ? "0.65" : "0.06, between other materials 0.14,"),
      length_words(stack.thinnest_thickness, 3), 100.0 * bearable_bending, by_cubics ? "two" : "three");
}

// Why nothing is known of axes that turn across the layers, and what helps.
std::string_view words_on_unknown(AxesTurn::Unknown why) {
  using enum AxesTurn::Unknown;
  if (why == lone_plies)
    return "not known (plies of one cell across with inclined axes: 9 % too low to 100 times too high, as measured). "
           "For 15 %: two cells across each ply, for 3 %: three ([mesh])";
  if (why == goes_on)
    return "not known (axes that turn across layers and go on in another region: 23 to 56 % too low, as measured). For "
           "less: one region, or more layers ([mesh])";
  return "not known (axes that turn across layers, in a body with eigenstrains or temperatures: 93 % too low to three "
         "times too high with four layers, as measured). For a quarter of it: twice the layers ([mesh])";
}

// On axes that turn across the layers.
std::string words_on_turn(const BendingError& worst) {
  const BendingLayers& at = worst.layers;
  if (at.turn.unknown != AxesTurn::Unknown::no) return std::string(words_on_unknown(at.turn.unknown));
  const double error = 100.0 * worst.error, bearable = 100.0 * bearable_bending;
  if (worst.error == at.turn.error_of_plies())
    return fmt::format(
        "up to {:.0f} % too high (plies of two cells across with inclined axes). For {:.0f} %: three ([mesh])", error,
        bearable);
  if (worst.error == at.turn.error_of_uneven())
    return fmt::format(
        "about {:.0f} % too high or too low (uneven layers of a material with inclined axes; within a factor of "
        "three). For less: even layers ([mesh])",
        error);
  constexpr double most_of_few = 3.0;
  const double by_layers = at.turn.error();
  const std::string which =
      worst.error == by_layers
          ? fmt::format("{:.0f} layers",
                        std::max(most_of_few + 1.0, std::ceil(at.n * std::sqrt(by_layers / bearable_bending))))
          : fmt::format("cells up to {} long",
                        length_words(at.thickness * AxesTurn::length_for(bearable_bending, at.shear), 2));
  return fmt::format(
      "about {:.0f} % too high or too low (axes of the material turn across the layers; within a factor of three). For "
      "{:.0f} %: {} ([mesh])",
      error, bearable, which);
}

// Words on the worst error, its reason and its remedy.
std::string words_on(const BendingError& worst, bool is_about_axis) {
  const BendingLayers& at = worst.layers;
  const double nu = worst.poisson_ratio;
  if (worst.by == BendBy::one_ring)
    return fmt::format(
        "too {} (one cell across; {}). For {:.0f} %: {:.0f} layers of cells up to {} long ([mesh])",
        worst.error > 0.0 ? "high" : "low",
        is_about_axis ? fmt::format("{:.0f} % too low by the number of layers, {:.0f} % too high by long "
                                    "cells as far as they bend along the radius",
                                    100.0 * at.lack_of_one_ring(nu), 100.0 * at.excess_of_one_ring(nu))
                      : fmt::format("measured within {}", at.stack.n_materials > 1 ? "a factor of two" : "a third"),
        100.0 * bearable_bending, std::ceil(layers_for_it * at.n / at.stack.even_layers() - 0.01),
        length_words(at.stack.even_thickness * std::sqrt(bearable_bending / (1.5 * (1.0 - nu))), 2));
  if (worst.error < 0.0) return words_on_thin(worst);
  if (worst.by == BendBy::cubics)
    return fmt::format(
        "too high or too low (cells longer than the body is thick; the error grows with the cube of their length, "
        "within a factor of two). For {:.0f} %: cells up to {} long ([mesh])",
        100.0 * bearable_bending, length_words(at.length * std::cbrt(bearable_bending / worst.error), 2));
  if (at.excess_of_uneven() >= at.excess_of_lines(nu))
    return "too high (layers of uneven thickness, within a factor of two). For less: even layers ([mesh])";
  if (at.shear > 0.0)
    return fmt::format(
        "too high or, with an odd number of cells along, too low (cells longer than the body is thick, of a material "
        "with inclined axes; within a factor of two). For {:.0f} %: cells up to {} long ([mesh])",
        100.0 * bearable_bending,
        length_words(at.thickness * (1.0 + std::pow(bearable_bending / (0.11 * std::sqrt(at.shear)), 1.0 / 1.3)), 2));
  return fmt::format(
      "too high or, with an odd number of cells along, too low (cells longer than the body is thick: 0.05 "
      "(length/thickness - 1)^1.3 sqrt((1 - nu)/(1 - 2 nu)), within a factor of two). For {:.0f} %: cells up to {} "
      "long ([mesh])",
      100.0 * bearable_bending, length_words(1.3 * at.thickness, 2));
}

std::string words_on_layers(const Mesh& mesh, Index cell, const BendingLayers& at, std::string_view cells) {
  return fmt::format("region \"{}\": {:.3g} layer{} of {} {} long across {}: where they bend, their stiffness is ",
                     mesh.region_names[mesh.region[cell]], at.n, at.n == 1.0 ? "" : "s", cells,
                     quantity_text(at.length, "m", 3), quantity_text(at.thickness, "m", 3));
}

std::string_view name_of(SlenderCells cells) {
  if (cells == SlenderCells::tetrahedra) return "tetrahedra";
  return cells == SlenderCells::polyhedra ? "polyhedra" : "prisms";
}

struct Warned {
  double error = 0.0;
  std::string words;
};

// What the formulas are wrong by, a third, is left aside.
constexpr double bearable_of_others = 0.04;

// Prisms whose gradients are those of one ring, tetrahedra and polyhedra: the error that a fifth of the surface
// exceeds.
std::optional<Warned> warn_of_others(const Mesh& mesh, const Unknowns& unknowns, std::vector<SlenderLayers> all) {
  if (all.empty()) return std::nullopt;
  const auto error_of = [&](const SlenderLayers& at) {
    return at.error(unknowns.sound[unknowns.zone[at.cell]].poisson_ratio());
  };
  const auto worst = all.begin() + count_of(all) * 4 / 5;
  std::ranges::nth_element(all, worst, {}, [&](const SlenderLayers& at) { return std::abs(error_of(at)); });
  const double error = error_of(*worst);
  if (std::abs(error) <= bearable_of_others) return std::nullopt;
  const bool is_rough = worst->of == SlenderCells::polyhedra || worst->layers.n < 2.5;
  return Warned{error, words_on_layers(mesh, worst->cell, worst->layers, name_of(worst->of)) +
                           fmt::format("about {:.0f} % too {} (as measured with regular cells; within a {}). "
                                       "Hexahedra bend as they should ([mesh])",
                                       100.0 * std::abs(error), error > 0.0 ? "high" : "low",
                                       is_rough ? "factor of two" : "third")};
}

// Prisms that fit cubics, where a fifth of the surface exceeds it: those longer than the body is thick, and materials
// of one box of prisms across.
std::optional<Warned> warn_of_plane_prisms(const Mesh& mesh, std::vector<SlenderLayers> all) {
  constexpr double longest = 1.2, longest_of_laminates = 0.75;
  if (all.empty()) return std::nullopt;
  const auto at = all.begin() + count_of(all) * 4 / 5;
  std::ranges::nth_element(all, at, {}, [](const SlenderLayers& in) { return in.layers.length / in.layers.thickness; });
  const double least = at->layers.stack.n_materials > 1 ? longest_of_laminates : longest;
  if (at->layers.length > least * at->layers.thickness)
    return Warned{1.0, words_on_layers(mesh, at->cell, at->layers, "triangles") +
                           fmt::format("not known ({}). For 5 %: cells up to {} long ([mesh])",
                                       at->layers.stack.n_materials > 1
                                           ? "long cells of a laminate: as long as the body is thick 33 % too low to 4 "
                                             "% too high, or the solution is none"
                                           : "cells longer than the body is thick: 1.5 times 23 % too low to 3 % too "
                                             "high, twice 39 % too low to 48 % too high, by nu and the diagonals",
                                       length_words((least < 1.0 ? 0.5 : 1.0) * at->layers.thickness, 2))};
  std::ranges::nth_element(all, at, {}, [](const SlenderLayers& in) { return in.lack_of_cubics(); });
  const double lack = at->lack_of_cubics();
  if (lack <= bearable_of_others) return std::nullopt;
  return Warned{
      -lack, words_on_layers(mesh, at->cell, at->layers, "triangles") +
                 fmt::format("about {:.0f} % too low (materials of one layer have {:.0f} % of it about their own "
                             "middles, of which 0.5 length/thickness is missing, within a factor of three). For {:.0f} "
                             "%: two layers across each material ([mesh])",
                             100.0 * lack, 100.0 * at->layers.stack.lone, 100.0 * bearable_bending)};
}

std::string warn_of_polygons(const Mesh& mesh, const SlenderLayers& at) {
  return words_on_layers(mesh, at.cell, at.layers, "polygons") +
         "not known (two layers of octagons as long as thick: 52 % too high). Quadrilaterals and triangles bend as "
         "they "
         "should ([mesh])";
}

std::optional<Warned> warn_of_hexahedra(const Mesh& mesh, const Unknowns& unknowns, BendBy by) {
  const auto worst = largest_bending_error(mesh, unknowns, by);
  if (!worst || std::abs(worst->error) <= bearable_bending) return std::nullopt;
  const bool is_rough = unknowns.is_axisymmetric() && worst->by == BendBy::one_ring;
  const bool is_thin = worst->by != BendBy::one_ring && worst->error < 0.0;
  if (worst->by == BendBy::lines && worst->layers.is_by_turn(worst->poisson_ratio))
    return Warned{worst->error, words_on_layers(mesh, worst->cell, worst->layers, "hexahedra") + words_on_turn(*worst)};
  return Warned{worst->error, words_on_layers(mesh, is_thin ? worst->layers.stack.thinnest : worst->cell, worst->layers,
                                              "hexahedra") +
                                  fmt::format("{} {:.0f} % {}", is_rough ? "up to" : "about",
                                              100.0 * std::abs(worst->error), words_on(*worst, is_rough))};
}

// On damage in layers across which the axes of the material turn, whose slopes know that as long as they are sound.
std::optional<std::string> warn_of_damage(const Mesh& mesh, const Unknowns& unknowns, const FractureModel& model) {
  constexpr double enough_layers = 16.0;
  if (model.is_isotropic()) return std::nullopt;
  const auto few = fewest_turned_layers(mesh, unknowns);
  if (!few || few->layers.n >= enough_layers || !model.in_cell(mesh, few->cell).damageable) return std::nullopt;
  return fmt::format(
      "region \"{}\": axes of the material turn across {:.3g} layers of cells: where they bend and crack, the peak "
      "force is 9 % too low to 23 % too high with four layers, 2 % too low to 10 % too high with eight, as measured. "
      "For less: {:.0f} layers ([mesh])",
      mesh.region_names[mesh.region[few->cell]], few->layers.n, enough_layers);
}

std::optional<std::string> larger(const std::optional<Warned>& one, const std::optional<Warned>& other) {
  if (!one && !other) return std::nullopt;
  if (!one || (other && std::abs(other->error) > std::abs(one->error))) return other->words;
  return one->words;
}

}  // namespace

std::optional<std::string> bending_warning(const Mesh& mesh, const FractureModel& model) {
  const bool is_plane = std::ranges::any_of(model.boundary, [](const auto& on) {
    return is_front_or_back(on) && on.kind != BoundaryCondition::Kind::axisymmetric;
  });
  const Unknowns unknowns = place_unknowns(mesh, elastic_body(model));
  std::vector<SlenderLayers> slender = slender_layers(mesh, unknowns);
  if (is_plane && fits_cubics(model)) {
    std::vector<SlenderLayers> of_prisms;
    for (const SlenderLayers& at : slender)
      if (at.of == SlenderCells::prisms_within) of_prisms.push_back(at);
    std::erase_if(slender, [](const SlenderLayers& at) { return at.of != SlenderCells::polyhedra; });
    if (!slender.empty()) return warn_of_polygons(mesh, slender.front());
    return larger(warn_of_hexahedra(mesh, unknowns, BendBy::cubics), warn_of_plane_prisms(mesh, std::move(of_prisms)));
  }
  const auto words =
      larger(warn_of_hexahedra(mesh, unknowns, BendBy::lines), warn_of_others(mesh, unknowns, std::move(slender)));
  return words ? words : warn_of_damage(mesh, unknowns, model);
}

}  // namespace pfdm
