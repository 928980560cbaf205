#include "cases/program/input/laws/prony_keys.h"

namespace pfdm {
namespace {

const KeyTable& branch_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "shear_branches[], bulk_branches[]",
      .sentence = "A branch of a viscoelastic material: spring and dashpot in series.",
      .keys = {{"modulus", quantity(dimension::stress, range::positive), "",
                "Modulus of the branch's spring, in shear or in bulk."},
               {"time", quantity(dimension::time, range::positive), "",
                "Relaxation time tau of the branch, the dashpot's viscosity over the modulus."}}};
  return table;
}

}  // namespace

std::vector<Key> prony_branch_keys(std::string_view shear_only, std::string_view bulk_only) {
  return {{"shear_branches", keys::tables(branch_keys), "none",
           "Prony series of the shear modulus beside the relaxed one of young_modulus and poisson_ratio.", shear_only},
          {"bulk_branches", keys::tables(branch_keys), "none",
           "Prony series of the bulk modulus beside the relaxed one.", bulk_only}};
}

}  // namespace pfdm
