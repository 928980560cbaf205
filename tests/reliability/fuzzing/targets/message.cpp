// Messages with whatever names and files hold: one line, UTF-8, no control characters, no longer than promised.

#include "cases/program/session/terminal/message_text.h"
#include "postproc/files/utf8.h"
#include "tests/reliability/fuzzing/input_file.h"

#include <algorithm>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  const std::string message = message_text(text_of(data, size));
  constexpr std::size_t longest = 2000;
  require(message.size() <= longest);
  for (std::string_view rest = message; !rest.empty();) {
    const std::size_t length = utf8_length(rest);
    const auto first = static_cast<unsigned char>(rest.front());
    require(length > 0 && first >= 0x20U && first != 0x7FU);
    rest.remove_prefix(length);
  }
  return 0;
}
