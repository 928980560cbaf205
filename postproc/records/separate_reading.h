#pragma once
// Files of foreign formats read in a process of their own: what is damaged may crash the library that reads it.

#include "postproc/records/signal_table.h"

namespace pfdm {

/// What `read` returns for the file, and throws; InputError that names the file where it crashes or takes more time or
/// memory than a file of that size can need.
SignalTable read_separately(const std::filesystem::path& file, SignalTable (*read)(const std::filesystem::path&));

}  // namespace pfdm
