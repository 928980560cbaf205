// Surfaces of triangles: STL, text or binary, and OBJ.

#include "mesh/surfaces/surface_file.h"
#include "tests/reliability/fuzzing/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  std::string_view input = text_of(data, size);
  const char* const name = take_choice(input) % 2 == 0 ? "surface.stl" : "surface.obj";
  is_read([&] {
    std::size_t n_merged = 0;
    const TriangleSurface surface = read_surface_file(file_of(input, name), &n_merged);
    for (const auto& triangle : surface.triangles)
      for (const Index p : triangle) require(p >= 0 && static_cast<std::size_t>(p) < surface.points.size());
  });
  return 0;
}
