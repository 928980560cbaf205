#include "cases/program/kinds.h"

#include "cases/program/chain/chain_program.h"
#include "cases/program/fracture/fracture_program.h"
#include "cases/program/homogenization/homogenization_program.h"
#include "cases/program/plate/plate_program.h"
#include "cases/program/point/endochronic_program.h"
#include "cases/program/studies/sweep.h"
#include "cases/program/vibration/mass_material_program.h"

namespace pfdm {
namespace {

constexpr CaseKind table[] = {
    {"chain", "jobs of other cases one after the other, which take numbers from each other's results",
     read_chain_program},
    {"endochronic", "one material point of endochronic plasticity under mixed control", read_endochronic_program},
    {"fracture", "phase-field fracture of a solid under load", read_fracture_program},
    {"homogenize", "effective linear stiffness of a meshed composite by six load cases", read_homogenization_program},
    {"mass_material", "mass on a sample on a shaker: simulation and identification", read_mass_material_program},
    {"plate", "viscoelastic plate or other body on a shaker: modes, frequency response, heating", read_plate_program},
};

}  // namespace

std::span<const CaseKind> case_kinds() { return table; }

RunnableCase read_case(const CaseFile& file) {
  const CaseKind& kind = choose(file.config.root().at("kind"), case_kinds(), "kind of case");
  RunnableCase runnable = kind.read(file);
  if (const auto settings = read_sweep(file))
    runnable.sweep = [file, settings](Session& session) { run_sweep(file, *settings, session); };
  else
    runnable.sweep = job_without_table(
        file, "sweep", "a method and [[sweep.parameters]] that name values with those they take", "glass_bead_radius");
  file.config.reject_unknown_keys();
  return runnable;
}

}  // namespace pfdm
