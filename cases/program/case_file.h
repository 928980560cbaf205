#pragma once
// A case directory: its case.toml, read strictly, and a hash that tells whether results belong to it.

#include "cases/program/config.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace pfdm {

struct CaseFile {
  std::filesystem::path directory;
  std::string text;
  Config config;
};

/// `where` is a case directory or a .toml file in it. Throws InputError if there is none or it is no TOML.
CaseFile open_case(const std::filesystem::path& where);

/// Of what case.toml says and of the data files that it uses; 16 hexadecimal digits (FNV-1a). Left out is what a run
/// may be gone on with after a change: the title, comments, [solver] and [loading].
std::string case_hash(const CaseFile& file, std::span<const std::filesystem::path> data_files);

}  // namespace pfdm
