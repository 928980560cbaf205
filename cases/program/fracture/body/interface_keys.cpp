#include "cases/program/fracture/body/body_keys.h"
#include "cases/program/fracture/body/interface_reader.h"
#include "cases/program/input/laws/law_keys.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <list>

namespace pfdm {
namespace {

constexpr Range at_least_one{1.0, std::numeric_limits<double>::infinity(), false, "at least 1"};
constexpr Range law_number{1.0, 1e6, false, "the number of one of the table's laws"};

struct ShapeWords {
  std::string_view name, sentence;
};
constexpr std::array shape_words{
    ShapeWords{"kink_over_strength", "Traction at the kink of the bilinear law over the strength."},
    ShapeWords{"share_before_kink", "Share of the toughness that is dissipated before the kink of the bilinear law."},
    ShapeWords{"alpha", "Shape of the PPR law's softening branch; 3 and more is concave."},
    ShapeWords{"peak_over_limit", "Separation at the peak over the largest separation of the PPR law."},
};

/// A range with words of its own, which live as long as the program.
Range shape_range(const ShapeParameter& parameter) {
  static std::list<std::string> words;
  words.push_back(fmt::format("between {:g} and {:g}", parameter.lower, parameter.upper));
  return {parameter.lower, parameter.upper, false, words.back()};
}

/// What sets the shapes of the laws apart.
std::vector<Key> shape_keys() {
  std::vector<Key> rows;
  for (const TractionSeparationLaw& law : interface_laws())
    for (std::size_t i = law.has_rise() ? 1 : 0; i < law.shape.size(); ++i) {
      const ShapeParameter& parameter = law.shape[i];
      const auto words = std::ranges::find(shape_words, parameter.name, &ShapeWords::name);
      rows.push_back({parameter.name, keys::number(shape_range(parameter)), fmt::format("{:g}", parameter.first),
                      words == shape_words.end() ? "" : words->sentence});
    }
  return rows;
}

const KeyTable& scatter_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "interface[].strength_scatter",
      .sentence = "A random factor of mean 1 over the faces, lognormal, with a correlation length.",
      .keys = {{"coefficient", number(range::positive), "", "Coefficient of variation of the random factor."},
               {"correlation_length", quantity(dimension::length, range::positive), "",
                "Length L of the correlation exp(-r^2/(2 L^2)) between faces."},
               {"seed", whole(range::seed), "", "Seed of the random factor."}}};
  return table;
}

const KeyTable& plane_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "interface[].plane",
      .sentence = "A plane in whose faces an interface lies.",
      .keys = {{"point", point(), "", "A point of the plane."},
               {"normal", direction(), "", "Normal of the plane, which leaves the interface's first side."}}};
  return table;
}

constexpr ParameterWords rate_words[] = {
    {"m", "Exponent of the rate of opening."},
    {"c", "Growth of the factor with the logarithm of the rate."},
    {"reference_rate", "Rate of opening v_0 to which the rate is compared."},
};

const KeyTable& interface_rate_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "interface[].rate",
      .sentence = "The factor by which an interface pulls more while its separation grows; needs a duration.",
      .keys = joined({law_keys("rate law of an interface", interface_rate_laws(), "Name of the law.", rate_words)}),
      .decided_by = "law"};
  return table;
}

const KeyTable& interface_branch_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "interface[].branches[]",
      .sentence = "A Maxwell branch beside the law of an interface, a spring and a dashpot in series.",
      .keys = {{"stiffness", quantity(dimension::interface_stiffness, range::positive), "",
                "Stiffness of the branch's spring while the bond is whole."},
               {"time", quantity(dimension::time, range::positive), "", "Relaxation time of the branch."}}};
  return table;
}

std::vector<Key> place_and_law_keys() {
  using namespace keys;
  const KeyType strength = varying(quantity(dimension::stress, range::positive)),
                toughness = varying(quantity(dimension::toughness, range::positive));
  return {
      {"name", text("plain name"), "\"interface_1\" ...", "Name of the interface in files of the results."},
      {"between", list(text("region"), 2, 2), "or plane",
       "Two regions: the interface is all faces between them; separations are told from the first."},
      {"plane", table(plane_keys), "or between", "Plane whose faces are the interface, also within a region."},
      {"where", text("formula"), "all", "Formula in x, y, z (metres): only faces where it is not zero belong to it."},
      {"law", one_of("law of an interface", interface_laws()), "",
       "Traction-separation law of the cohesive interface, such as bilinear or exponential."},
      {"table", path(), "with the law table", "CSV file of a tabulated law: columns separation_m and traction_Pa."},
      {"table_law", whole(law_number), "the only one", "Which law of a table that has several, from 1."},
      {"strength", strength, "required but by table", "Strength of the interface in opening, its largest traction."},
      {"toughness", toughness, "required but by table", "Toughness of the interface, the energy of opening per area."},
      {"stiffness", either({quantity(dimension::interface_stiffness, range::positive), choice("stiffness", {"rigid"})}),
       "\"rigid\"", "Stiffness of the law's straight rise (penalty stiffness), or rigid: 1000 times the neighbours'."},
      {"mixed_mode", one_of("mixed mode", mixed_modes()), "\"camacho_ortiz\"",
       "Rule by which opening and shear (mode I and II) act together."},
      {"shear_ratio", number(range::positive), "1",
       "Shear strength over strength, of camacho_ortiz and equal_stiffness."},
      {"shear_strength", strength, "required by the other rules", "Strength of the interface in shear, mode II."},
      {"shear_toughness", toughness, "required by the other rules", "Toughness of the interface in shear, GII."},
      {"exponent", number(at_least_one), "1", "Exponent of the mode mix by Benzeggagh and Kenane or by the power law."},
      {"friction", number(range::not_negative), "0",
       "Coulomb's coefficient of friction on the broken part of a closed interface."},
      {"rate", keys::table(interface_rate_keys), "none",
       "Dependence of the traction on the rate of opening; strength and toughness grow alike."},
      {"branches", keys::tables(interface_branch_keys), "none",
       "Up to three Maxwell branches beside the law, which vanish with debonding; need a duration."},
      {"strength_scatter", keys::table(scatter_keys), "none",
       "Random scatter of strength and shear strength over the faces."},
      {"toughness_scatter", keys::table(scatter_keys), "none",
       "Random scatter of toughness and shear toughness over the faces."},
  };
}

}  // namespace

const KeyTable& interface_keys() {
  static const KeyTable table{
      .name = "interface[]",
      .sentence =
          "A cohesive interface without thickness: faces whose two sides may part by a traction-separation law.",
      .keys = keys::joined({place_and_law_keys(), shape_keys()})};
  return table;
}

}  // namespace pfdm
