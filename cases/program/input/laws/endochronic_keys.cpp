#include "cases/program/input/laws/endochronic_keys.h"

#include "cases/program/input/laws/law_keys.h"
#include "physics/point/hardening.h"

namespace pfdm {
namespace {

constexpr ParameterWords factor_words[] = {
    {"f_inf", "Value of the hardening function that is reached at the end."},
    {"f_0", "Value of the hardening function at the beginning."},
    {"b", "How fast the hardening function grows with the intrinsic time zeta."},
    {"zeta_0", "Intrinsic time at which the power law of hardening is scaled."},
    {"n", "Exponent of the power law of hardening."},
    {"c", "Growth of the factor with the logarithm of the rate."},
    {"m", "Exponent of the rate."},
    {"reference_rate", "Rate at which the factor of the rate is 1."},
};

const KeyTable& term_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "kernel[]",
      .sentence = "A term of the memory kernel, C exp(-alpha z).",
      .keys = {{"C", quantity(dimension::stress, range::positive), "", "Modulus of the kernel's term."},
               {"alpha", number(range::not_negative), "", "Decay of the kernel's term with the intrinsic time."}}};
  return table;
}

const KeyTable& hardening_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "hardening",
      .sentence =
          "The hardening of an endochronic law with the intrinsic time zeta, and with the rate in a table of both.",
      .keys = joined({law_keys("hardening law", hardening_laws(), "Name of the hardening law.", factor_words),
                      {{"points", list(list(number(), 2, 2)), "",
                        "Pairs of zeta and hardening function, linear in between.", "table"},
                       {"zeta", list(number()), "", "Intrinsic times of the table's columns.", "table_with_rate"},
                       {"rate", list(quantity(dimension::rate)), "", "Rates of the table's rows.", "table_with_rate"},
                       {"f", list(list(number())), "", "Values of the hardening function, a row for each rate.",
                        "table_with_rate"}}}),
      .decided_by = "law"};
  return table;
}

const KeyTable& rate_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "rate",
      .sentence = "The factor by which the strain rate changes an endochronic law; bodies creep and relax with it.",
      .keys = joined({law_keys("rate factor", rate_factors(), "Name of the rate factor.", factor_words)}),
      .decided_by = "law"};
  return table;
}

}  // namespace

std::vector<Key> kernel_keys(std::string_view otherwise) {
  return {{"kernel", keys::tables(term_keys), std::string(otherwise),
           "Terms of the endochronic law's memory kernel, a sum of exponentials of the intrinsic time."}};
}

std::vector<Key> endochronic_factor_keys(std::string_view only) {
  using namespace keys;
  return {{"hardening", table(hardening_keys), "constant", "Isotropic hardening of the endochronic law.", only},
          {"rate", table(rate_keys), "none", "Dependence of the endochronic law on the strain rate.", only},
          {"beta", number(range::fraction), "0.5",
           "Position within a step at which the hardening function is evaluated; 1/2 is of second order.", only}};
}

}  // namespace pfdm
