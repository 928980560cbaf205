#pragma once
// All frames of a run in one file, VTKHDF 2.0 with steps, as VTK 9.3 and ParaView 5.12 read it:
// https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format. Any HDF5 library reads it too. The points and
// cells of a frame stand in the file once for all frames that follow with the same ones, and so do fields that stay.

#include <filesystem>

namespace pfdm {

/// Group with the names of the frames, for who reads them back (vtkhdf_frames.h); others do not look into it.
inline constexpr const char* frame_names_group = "/pfdm";

/// The extension of the file, ".vtkhdf".
inline constexpr const char* vtkhdf_extension = ".vtkhdf";

/// Writes the frames that a list (pvd.h) names into `file`, whole or not at all: points [m], cells, and the fields of
/// cells and points that the first frame has, with their unit as the attribute "units". Throws InputError if a frame
/// cannot be read, lacks one of these fields or has polyhedra, which the format of 2.0 does not know; ComputationError
/// if the file cannot be written.
void write_vtkhdf(const std::filesystem::path& list, const std::filesystem::path& file);

}  // namespace pfdm
