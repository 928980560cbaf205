// HDF5 files.

#include "postproc/records/signal_table.h"
#include "tests/reliability/fuzzing/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  is_read([&] {
    const SignalTable table = read_signals_hdf5(file_of(text_of(data, size), "record.h5"));
    require(!table.columns.empty());
  });
  return 0;
}
