#include "cases/program/kinds.h"
#include "cases/program/studies/sweep.h"

namespace pfdm {

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
