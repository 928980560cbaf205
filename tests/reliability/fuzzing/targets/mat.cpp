// MATLAB's files, which matio reads.

#include "postproc/records/signal_table.h"
#include "tests/reliability/fuzzing/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  is_read_apart([&] {
    const SignalTable table = read_signals_mat(file_of(text_of(data, size), "record.mat"));
    require(!table.columns.empty());
  });
  return 0;
}
