#pragma once
// Fields of numbers: arrays of .vtu and .vtk files.

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/search/known_places.h"

namespace pfdm {

/// One component of an array of a file, at the file's points or in its cells.
struct FieldFile {
  KnownField field;
  std::vector<double> values;  ///< [entries of the array]
};

/// Reads one component (from 0; -1: the only one) of an array of a .vtu or .vtk file whose unit of length is `scale`
/// [m]. Of cells of second order and above the corners count; a mesh of faces in a plane normal to an axis is a field
/// that does not depend on that coordinate. Throws InputError naming the file and what is wrong with it.
FieldFile read_field_file(const std::filesystem::path& path, const std::string& array, int component, double scale);

}  // namespace pfdm
