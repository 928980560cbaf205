#pragma once
// The reference of keys, generated from the rows: one page for each table of the file, with the tables below it.

#include "cases/program/reference/key_tree.h"

#include <map>
#include <string>
#include <vector>

namespace pfdm {

/// Texts of the pages by file name, "mesh.md", with "README.md", which lists them by kind of case.
std::map<std::string, std::string> key_reference(const std::vector<KindKeys>& kinds);

}  // namespace pfdm
