// Whole cases of every kind: keys, units, the files that they name. The first line names the case whose folder they
// are in: "# glass_bead".

#include "cases/program/input/case_files/kept_case.h"
#include "cases/program/kinds.h"
#include "tests/reliability/fuzzing/input_file.h"

#include <algorithm>

namespace pfdm::fuzzing {
namespace {

std::filesystem::path folder_of(std::string_view input) {
  const std::filesystem::path cases = PFDM_CASES_DIR;
  if (!input.starts_with("# ")) return cases;
  std::string_view name = input.substr(2, std::min<std::size_t>(input.find('\n'), 100) - 2);
  const bool is_plain = std::ranges::all_of(name, [](char c) { return c == '_' || (c >= '0' && c <= 'z'); });
  return is_plain ? cases / name : cases;
}

}  // namespace
}  // namespace pfdm::fuzzing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  const std::string_view input = text_of(data, size);
  is_read([&] {
    const std::filesystem::path folder = folder_of(input);
    const std::string text(input);
    read_case(
        {.directory = folder, .stem = "case", .text = text, .config = Config(text, (folder / "case.toml").string())});
  });
  return 0;
}
