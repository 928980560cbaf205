#pragma once
// Frames out of the one file of a run (vtkhdf.h), read by HDF5 alone: VTK 9.1 knows no steps in such files.

#include "postproc/fields/pvd.h"
#include "postproc/fields/vtu_writer.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace pfdm {

/// The path that stands for a frame in such a file, as those of .vtu files do: FILE.vtkhdf/NUMBER, from 0.
std::filesystem::path frame_in_one_file(const std::filesystem::path& file, std::size_t number);
/// Whether a path is of that kind.
bool is_in_one_file(const std::filesystem::path& frame);

/// Times and names of the frames in a file; the names are those of the files that they were made of. Throws InputError
/// if it cannot be read or is not one of ours, like the next one.
std::vector<Frame> frames_in(const std::filesystem::path& file);

/// Writes the frames as files of their own by their names, which start at the folder of `list`, and then the list,
/// whole or not at all.
/// Throws ComputationError if one cannot be written.
void unpack_frames(const std::filesystem::path& file, const std::filesystem::path& list, Compression compression);

}  // namespace pfdm
