// Messages stay readable whatever the names and files hold that they quote.

#include "cases/program/session/message_text.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

TEST(MessageText, IsOneLineWithoutControlCharacters) {
  EXPECT_EQ(message_text("one\ntwo\tthree"), "one two three");
  EXPECT_EQ(message_text("\x1b[2Jgone\x07\x7f"), "\\x1b[2Jgone\\x07\\x7f");
}

TEST(MessageText, KeepsUtf8AndShowsOtherBytes) {
  const std::string good = "Prüfkörper 2 \xE2\x89\xA5 1 \xF0\x9F\x94\xA9";
  EXPECT_EQ(message_text(good), good);
  EXPECT_EQ(message_text("l\xE4tin"), "l\\xe4tin");
  EXPECT_EQ(message_text("cut \xE2\x89"), "cut \\xe2\\x89");
}

TEST(MessageText, KeepsTheEndsOfWhatIsLong) {
  EXPECT_EQ(message_text("key \"" + std::string(50000, 'a') + "\" is unknown"),
            "key \"" + std::string(39, 'a') + " ... " + std::string(39, 'a') + "\" (50002 bytes) is unknown");
  const std::string path = "/home/" + std::string(200, 'p') + "/case.toml:3:";
  EXPECT_EQ(message_text(path + " wrong"), path + " wrong");
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "word ";
  EXPECT_LT(message_text(many).size(), 2000U);
  EXPECT_THAT(message_text(many), HasSubstr("(5000 bytes)"));
}

TEST(MessageText, CutsNoCharacter) {
  std::string word;
  for (int i = 0; i < 100; ++i) word += "\xC3\xA4";
  const std::string text = message_text(word);
  EXPECT_EQ(text.find("\\x"), std::string::npos) << text;
  EXPECT_LT(text.size(), word.size());
}

TEST(Messages, OfNamesThatAreTooLongAreShort) {
  const Outcome outcome = run({"run", std::string(5000, 'x')});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("File name too long"));
  EXPECT_LE(outcome.err.size(), 300U);
}

// Objects of JSON look their keys up one after the other.
TEST(Messages, OfAFileWithManyKeysComeAtOnce) {
  const TemporaryCase directory(
      replaced(bar_case(), "young_modulus = \"30 GPa\"", "young_modulus = { from = \"x.json\", key = \"a_Pa\" }"));
  std::string json = "{\"a_Pa\": 1e10";
  for (int i = 0; i < 300000; ++i) json += ",\"k" + std::to_string(i) + "\":0";
  directory.write("x.json", json + "}");
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("this is not a result file: it has an object of more than 10000 keys"));
  directory.write("x.json", "{\"a_Pa\": " + std::string(1000000, '1') + "}");
  const Outcome digits = run({"check", directory.path().string()});
  EXPECT_EQ(digits.status, 2);
  EXPECT_THAT(digits.err, HasSubstr("number overflow parsing"));
  EXPECT_EQ(digits.err.find("json.exception"), std::string::npos);
  EXPECT_LE(digits.err.size(), 400U);
}

TEST(Messages, QuoteNoControlCharactersOfACase) {
  const TemporaryCase directory(replaced(bar_case(), "region = \"bar\"", "region = \"b\\u001bar\""));
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_NE(outcome.status, 0);
  EXPECT_EQ(std::ranges::count(outcome.err, '\x1b'), 0) << outcome.err;
}

}  // namespace
}  // namespace pfdm::this_file
