// Lists of frames (.pvd): others' that fields are read from, and those of a run that goes on.

#include "cases/program/input/fields/frame_list.h"
#include "postproc/fields/pvd.h"
#include "tests/reliability/fuzzing/input_file.h"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  const auto path = file_of(text_of(data, size), "frames.pvd");
  is_read([&] {
    const std::vector<ListedFrame> frames = read_frame_list(path);
    for (std::size_t i = 0; i < frames.size(); ++i)
      require(std::isfinite(frames[i].time) && (i == 0 || frames[i - 1].time < frames[i].time));
  });
  is_read([&] { read_pvd(path); });
  return 0;
}
