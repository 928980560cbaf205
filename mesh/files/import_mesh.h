#pragma once
// Meshes made elsewhere, from unstructured VTK files (.vtu, or .vtk of the legacy format) and from Gmsh's: tetrahedra,
// wedges, pyramids, hexahedra, voxels, prisms of five and six sides, and polyhedra. Triangles, quadrilaterals and
// polygons may name patches; alone and in one plane they become a layer of cells.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mesh/files/mesh_file.h"
#include "mesh/patch_rules.h"

namespace pfdm {

struct ImportSettings {
  std::filesystem::path file;
  double scale = 1.0;  ///< the file's unit of length [m]

  /// Cell array of whole numbers that tells the regions; empty: the first there is of "region", "material",
  /// "gmsh:physical", "medit:ref", "cell_tags" and "CellEntityIds", or without any one region, "body".
  std::string region_array;
  std::map<Index, std::string> region_names;  ///< names of its numbers; else the file's, else region_<number>

  /// Cell array whose numbers, on the file's faces, tell the patches; empty: the same as for the regions.
  std::string face_array;
  std::map<Index, std::string> face_sets;  ///< number -> patch; besides those that the file names

  /// Patches by position [m], for boundary faces in no face set. Without patches and face sets: xmin ... zmax, as far
  /// as the mesh has faces on these planes of its bounding box.
  std::vector<PatchRule> patches;

  double merge_tolerance = 0.0;  ///< points closer than this become one [m]; 0: all stay
  double thickness = 0.0;        ///< of the one layer of cells that a flat mesh is made into [m]; 0: it is refused
};

/// Cells in mirrored order (writers disagree about wedges) are put right. Throws InputError, naming the file and what
/// is wrong with it: unreadable, no volume cells, a cell of another type, a cell without positive volume, a number or
/// an array that is not there.
Mesh import_vtk(const ImportSettings& settings);
/// The same of what is in the file, whatever its format.
Mesh import_mesh(const ImportSettings& settings, MeshFile file);
/// The same from a .msh file, whose physical groups are the regions and patches (gmsh_file.h), a surface group without
/// a name patch_<number>; cells whose faces do not match are refused as well (matching.h).
Mesh import_gmsh(const ImportSettings& settings);

}  // namespace pfdm
