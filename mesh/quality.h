#pragma once
// How well shaped the cells are: what `pfdm mesh` prints and mesh.vtu holds.

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace pfdm {

/// Of each cell; where a figure belongs to faces, the worst of the cell's interior faces.
struct CellQuality {
  CellField<double> non_orthogonality;  ///< face normal against the line between the cells' centres [degrees]
  CellField<double> skewness;      ///< from the face's centre to where that line pierces the face, over its length [-]
  CellField<double> volume_ratio;  ///< larger over smaller of the two cells [-]
  CellField<double> aspect_ratio;  ///< longest over shortest edge [-]
  CellField<double> min_dihedral_angle;  ///< smallest angle between two faces of the cell, seen from inside [degrees]
};

struct Statistic {
  double min = 0.0;
  double mean = 0.0;
  double max = 0.0;
};

using NamedCount = std::pair<std::string, Index>;

struct MeshQuality {
  Index n_points = 0;
  Index n_faces = 0;
  Index n_cells = 0;
  std::vector<NamedCount> shapes;   ///< cells of each shape there is
  std::vector<NamedCount> regions;  ///< cells
  std::vector<NamedCount> patches;  ///< faces
  double volume = 0.0;              ///< of all cells [m^3]
  Statistic cell_volume;            ///< [m^3]
  Statistic non_orthogonality;      ///< of the interior faces [degrees]
  Statistic skewness;               ///< of the interior faces [-]
  Statistic volume_ratio;           ///< of the interior faces [-]
  Statistic aspect_ratio;           ///< of the cells [-]
  Statistic min_dihedral_angle;     ///< of the cells [degrees]
};

CellQuality cell_quality(const Mesh& mesh);
MeshQuality mesh_quality(const Mesh& mesh);

/// Names a cell that is so flat, or such a needle, that equations on the mesh are hardly solved, if there is one.
std::optional<std::string> flat_cell_warning(const Mesh& mesh);

/// A table of about twelve lines for people to read.
std::string describe(const MeshQuality& quality);

}  // namespace pfdm
