// Universal files: functions over time.

#include "postproc/records/signal_table.h"
#include "tests/reliability/fuzzing/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  is_read([&] {
    const SignalTable table = read_signals_uff(file_of(text_of(data, size), "record.uff"));
    require(table.columns.size() > 1);
    const Eigen::VectorXd& times = table.columns.front().values;
    require(times.size() > 0 && times.allFinite());
    for (const SignalColumn& column : table.columns) require(column.values.size() == times.size());
  });
  return 0;
}
