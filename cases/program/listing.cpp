#include "cases/program/listing.h"

#include "cases/program/boundary_reader.h"
#include "cases/program/case_file.h"
#include "cases/program/kinds.h"
#include "cases/program/mass_material_case.h"
#include "cases/program/mesh_recipe.h"
#include "physics/crack_geometry.h"
#include "physics/degradation.h"
#include "physics/energy_split.h"
#include "physics/hardening.h"
#include "physics/mass_material.h"
#include "physics/softening_law.h"
#include "physics/traction_separation.h"
#include "postproc/energy_release_rate.h"
#include "solver/endochronic_identification.h"

#include <fmt/format.h>

#include <set>

namespace pfdm {
namespace {

template <class Row>
void list_table(std::ostream& out, std::string_view heading, std::span<const Row> rows) {
  out << heading << '\n';
  for (const Row& row : rows) out << fmt::format("  {:<22} {}\n", row.name, row.description);
}

std::string title_of(const std::filesystem::path& directory) {
  try {
    return open_case(directory).config.root().string("title");
  } catch (const InputError& error) {
    return fmt::format("(cannot be read: {})", error.what());
  }
}

}  // namespace

void list_cases(const std::filesystem::path& cases_directory, std::ostream& out) {
  if (!std::filesystem::is_directory(cases_directory))
    throw InputError(fmt::format("{}: there is no such directory of cases", cases_directory.string()));
  std::set<std::filesystem::path> cases;
  for (const auto& entry : std::filesystem::directory_iterator(cases_directory))
    if (std::filesystem::exists(entry.path() / "case.toml")) cases.insert(entry.path());
  for (const std::filesystem::path& directory : cases)
    out << fmt::format("{:<22} {}\n", directory.filename().string(), title_of(directory));
}

void list_laws(std::ostream& out) {
  list_table(out, "kinds of case (kind)", case_kinds());
  list_table(out, "mesh generators ([mesh] generator)", mesh_generators());
  list_table(out, "cells ([mesh] cells)", cell_kinds());
  list_table(out, "crack geometric functions ([fracture] model)", crack_geometries());
  list_table(out, "degradation functions ([fracture] degradation)", degradations());
  list_table(out, "softening laws of the rational degradation ([fracture] softening)", softening_laws());
  list_table(out, "traction-separation laws that pfdm cohesive fits", traction_separation_laws());
  list_table(out, "energy splits ([fracture] split)", energy_splits());
  list_table(out, "hardening of the endochronic law ([material.hardening] law)", hardening_laws());
  list_table(out, "rate factors of the endochronic law ([material.rate] law)", rate_factors());
  list_table(out, "identification of the endochronic law ([fit] method)", identification_methods());
  list_table(out, "boundary conditions ([[boundary]] type)", boundary_types());
  list_table(out, "displacement fields (displacement = { field = ... })", displacement_fields());
  list_table(out, "energy release rate of a crack ([[output.energy_release_rate]] shape)", region_shapes());
  list_table(out, "mass-material models ([model] structure)", model_structures());
  list_table(out, "excitations ([[test]] excitation.type)", excitation_types());
  list_table(out, "identification ([fit] method)", fit_methods());
}

}  // namespace pfdm
