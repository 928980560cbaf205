// Case files as TOML: values read, written anew in their places, set from the command line.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/input/case_files/case_override.h"
#include "tests/reliability/fuzzing/input_file.h"

#include <algorithm>
#include <vector>

namespace pfdm::fuzzing {
namespace {

constexpr std::size_t most_values = 20;  // that are written anew
const std::string new_value = "\"new\"";

bool is_single(const TomlValue& value) {
  return !std::holds_alternative<TomlArray>(value.value) && !std::holds_alternative<TomlTable>(value.value);
}

std::vector<const TomlValue*> single_values(const TomlValue& root) {
  std::vector<const TomlValue*> values;
  for_each_value(root, [&](const std::string&, const TomlValue& value) {
    if (is_single(value)) values.push_back(&value);
  });
  return values;
}

/// Each value can be written anew, and all others stay.
void require_replaceable(const std::string& text, const TomlValue& root) {
  const std::vector<const TomlValue*> values = single_values(root);
  for (std::size_t k = 0; k < std::min(values.size(), most_values); ++k) {
    const TomlValue changed = parse_toml(with_value(text, *values[k], new_value), "changed.toml");
    const std::vector<const TomlValue*> now = single_values(changed);
    require(now.size() == values.size());
    for (std::size_t i = 0; i < now.size(); ++i)
      require(written(*now[i]) == (i == k ? new_value : written(*values[i])));
  }
}

void require_quotable(const TomlValue& root) {
  for (const TomlValue* value : single_values(root))
    if (const auto* text = std::get_if<std::string>(&value->value))
      require(std::get<std::string>(value_at(parse_toml("x = " + quoted_toml(*text), "x.toml"), "x").value) == *text);
}

void read(const std::string& text) {
  const TomlValue root = parse_toml(text, "case.toml");
  try {
    require_replaceable(text, root);
    require_quotable(root);
  } catch (const InputError&) {
    require(false);
  }
  const CaseFile file{.directory = "case", .text = text, .config = Config(text, "case/case.toml")};
  const std::string line = text.substr(0, text.find('\n'));
  if (line.starts_with('#') && file.config.root().has("kind")) {
    const std::string word = line.substr(1);
    with_overrides(file, std::vector{word});
  }
}

}  // namespace
}  // namespace pfdm::fuzzing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm::fuzzing;
  std::string_view input = text_of(data, size);
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (input.starts_with(byte_order_mark)) input.remove_prefix(byte_order_mark.size());  // as open_case() does
  is_read([&] { read(std::string(input)); });
  return 0;
}
