#include "postproc/files/utf8.h"

#include <gtest/gtest.h>

#include <string_view>

namespace pfdm::test::this_file {
namespace {

TEST(Utf8, KnowsCharactersOfEachLength) {
  EXPECT_EQ(utf8_length("a"), 1u);
  EXPECT_EQ(utf8_length("\xC3\xA4x"), 2u);
  EXPECT_EQ(utf8_length("\xE2\x89\xA5"), 3u);
  EXPECT_EQ(utf8_length("\xF0\x9F\x94\xA9"), 4u);
  EXPECT_EQ(utf8_length(std::string_view("\0", 1)), 1u);
}

TEST(Utf8, RefusesWhatIsNone) {
  for (const char* bytes : {"", "\xE4tin", "\xC3", "\xE2\x89", "\x80", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80",
                            "\xF0\x80\x80\x80", "\xF4\x90\x80\x80", "\xFF"})
    EXPECT_EQ(utf8_length(bytes), 0u) << bytes;
}

}  // namespace
}  // namespace pfdm::test::this_file
