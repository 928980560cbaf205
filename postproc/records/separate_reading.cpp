#include "postproc/records/separate_reading.h"

#include "physics/system/packed_bytes.h"
#include "physics/system/separate_process.h"

namespace pfdm {
namespace {

std::string bytes_of(const SignalTable& table) {
  BytePacker packer;
  packer.put(table.remark);
  packer.put(table.notes);
  packer.put(table.columns.size());
  for (const SignalColumn& column : table.columns) {
    packer.put(column.name);
    packer.put(column.unit);
    packer.put(column.fault);
    packer.put(std::vector<double>(column.values.begin(), column.values.end()));
  }
  return packer.take();
}

SignalTable table_in(const std::string& bytes) {
  ByteUnpacker unpacker(bytes);
  SignalTable table;
  unpacker.take(table.remark);
  unpacker.take(table.notes);
  std::size_t n = 0;
  unpacker.take(n);
  table.columns.resize(n);
  for (SignalColumn& column : table.columns) {
    unpacker.take(column.name);
    unpacker.take(column.unit);
    unpacker.take(column.fault);
    std::vector<double> values;
    unpacker.take(values);
    column.values = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  }
  return table;
}

}  // namespace

SignalTable read_separately(const std::filesystem::path& file, SignalTable (*read)(const std::filesystem::path&)) {
  return table_in(read_separately(file, file.string(), [&] { return bytes_of(read(file)); }));
}

}  // namespace pfdm
