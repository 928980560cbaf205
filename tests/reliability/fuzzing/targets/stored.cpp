// What a run, fit, analysis or chain has written and a later command reads again: JSON, curves, checkpoints.

#include "cases/program/chain/chain_record.h"
#include "cases/program/input/config/result_number.h"
#include "postproc/cohesive/first_debonding.h"
#include "postproc/curves/curve_csv.h"
#include "postproc/curves/figures_summary.h"
#include "postproc/curves/summary.h"
#include "postproc/fields/checkpoint.h"
#include "postproc/fits/fit_json.h"
#include "postproc/vibration/analysis_json.h"
#include "postproc/vibration/vibration_fit.h"
#include "postproc/vibration/vibration_models.h"
#include "tests/reliability/fuzzing/input_file.h"

#include <algorithm>

namespace pfdm::fuzzing {
namespace {

const std::string hash = "0123456789abcdef";  // of the case

template <class T>
std::string bytes_of(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// With header and checksum, as no damage at random would have them.
std::string checkpoint_with(std::string_view payload) {
  constexpr std::uint32_t format = 11;
  constexpr std::uint64_t header = 20, sum_size = 8;
  std::string bytes = "PFDMCKPT" + bytes_of(format) + bytes_of(header + payload.size() + sum_size);
  bytes += payload;
  std::uint64_t sum = 0xcbf29ce484222325U;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    sum = static_cast<std::uint64_t>(static_cast<unsigned __int128>(sum) * 0x100000001b3U);
  }
  return bytes + bytes_of(sum);
}

void read(unsigned choice, std::string_view input) {
  const auto path = [&](const char* name) { return file_of(input, name); };
  switch (choice % 11) {
    case 0: read_summary(path("summary.json")); break;
    case 1: read_run_summary(path("summary.json")); break;
    case 2: vibration_findings(read_fit_json(path("fit.json")).own); break;
    case 3: read_analysis_stamp(path("analysis.json")); break;
    case 4: read_model_comparison(path("models.json")); break;
    case 5: tests_of_figures_summary(path("summary.json")); break;
    case 6: take_first_debonding(path("first.json"), 10); break;
    case 7: read_chain(path("chain.json").parent_path()); break;
    case 8: read_curve(path("force_displacement.csv")); break;
    case 9: read_checkpoint(file_of(checkpoint_with(input), "checkpoint.bin"), hash); break;
    default: {
      const std::size_t end = std::min(input.find('\n'), input.size());
      const std::string key(input.substr(0, end));
      input.remove_prefix(end);
      number_in_results(path("numbers.json").parent_path(), "numbers.json", key);
    }
  }
}

}  // namespace
}  // namespace pfdm::fuzzing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm::fuzzing;
  std::string_view input = text_of(data, size);
  const unsigned choice = take_choice(input);
  is_read([&] { read(choice, input); });
  return 0;
}
