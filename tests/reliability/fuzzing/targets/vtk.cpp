// VTK's files, legacy and XML, in this process: what is made of the grid that VTK reads.

#include "mesh/files/import_mesh.h"
#include "mesh/files/vtk_file.h"
#include "tests/reliability/fuzzing/input_file.h"

namespace pfdm::fuzzing {
namespace {

void require_whole(const MeshFile& file) {
  require(file.cell_offsets.size() == file.cell_type.size() + 1);
  require(static_cast<std::size_t>(file.cell_offsets.back()) == file.cell_points.size());
  for (const Index p : file.cell_points) require(p >= 0 && static_cast<std::size_t>(p) < file.points.size());
  for (const auto& [name, values] : file.integer_arrays) require(values.size() == file.cell_type.size());
}

}  // namespace
}  // namespace pfdm::fuzzing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  std::string_view input = text_of(data, size);
  const unsigned choice = take_choice(input);
  ImportSettings settings{.file = file_of(input, choice % 2 == 0 ? "mesh.vtu" : "mesh.vtk")};
  is_read([&] {
    const auto [file, array] = read_vtk_here(settings.file, choice % 4 < 2 ? "" : "a", "mesh");
    require_whole(file);
    for (const double thickness : {0.0, 1.0}) {
      settings.thickness = thickness;
      is_read([&] { import_mesh(settings, file); });
    }
  });
  return 0;
}
