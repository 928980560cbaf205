#pragma once
// A fracture case up to where it would run: its mesh, its model on it, and what is to be said of them.

#include "cases/program/fracture/run/running_case.h"

namespace pfdm {

/// Makes the mesh and says how large it is and what is wrong with its cells.
Mesh made_mesh(const FractureProgram& program, Log& log);
/// Made, or found where several runs share it.
const Mesh& find_mesh(const FractureProgram& program, MeshStore& meshes, Log& log);

/// Puts the model on the mesh and says whether that resolves what is asked of it. Keeps a reference to the mesh.
FractureRun made_run(const FractureProgram& program, const Mesh& mesh, Log& log);

/// Warns of interfaces whose cells are too large for their laws.
void warn_of_interfaces(const FractureRun& run, Log& log);

/// Events of the measured curves, as the records have them. Throws InputError as events_in_records(), and for one that
/// no stage of the fit has or that the load does not reach.
std::vector<MeasuredEvent> events_of_fit(const FractureProgram& program);

/// The fields of the case on this mesh: says what counts of them and what was left out. Throws InputError as
/// read_recorded_field() and selected_field(), and for a field on a specimen without standard deviations.
MeasuredFields fields_of_fit(const FractureProgram& program, const Mesh& mesh, Log& log);

/// Says what would run: pfdm check.
void check_fracture(const FractureProgram& program, Session& session);

/// Makes the mesh and measures its quality: pfdm mesh.
void mesh_fracture(const FractureProgram& program, Session& session);

}  // namespace pfdm
