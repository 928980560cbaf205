// Meshes of Gmsh, as solids and as flat meshes that become a layer of cells.

#include "mesh/files/import_mesh.h"
#include "tests/reliability/fuzzing/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  ImportSettings settings{.file = file_of(text_of(data, size), "mesh.msh")};
  for (const double thickness : {0.0, 1.0}) {
    settings.thickness = thickness;
    is_read([&] { import_gmsh(settings); });
  }
  return 0;
}
