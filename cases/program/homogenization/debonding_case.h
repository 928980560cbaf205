#pragma once
// Reads a case of kind "homogenize" with a path of mean strain or stress: a box whose interfaces debond, or whose
// materials break, as a fracture case without patches that are loaded.

#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/input/case_files/case_file.h"

namespace pfdm {

/// Whether the case is one: [homogenization] has a path.
bool has_mean_path(const ConfigTable& root);

/// `root` is the whole case file. Throws InputError for all that can be told without the mesh.
FractureCase read_debonding_case(const ConfigTable& root, const std::filesystem::path& case_directory,
                                 MeshOf mesh = MeshOf::the_case);

/// One with all that its file says. Throws InputError for whatever is wrong with it, unknown keys included.
FractureCase read_whole_debonding_case(const CaseFile& file, MeshOf mesh);

}  // namespace pfdm
