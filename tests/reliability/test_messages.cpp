// Messages stay readable whatever the names and files hold that they quote.

#include "cases/program/session/terminal/message_text.h"
#include "tests/cases/temporary_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
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

TEST(MessageText, LeavesOutTheEndOfALongList) {
  const std::string place = "/home/somebody/case.toml:3:",
                    before = place + " [mesh] \"colour\" is not known here (allowed: ";
  std::string keys = "key_0";
  for (int i = 1; i < 10; ++i) keys += ", key_" + std::to_string(i);
  EXPECT_EQ(message_text(before + keys + ")"), before + keys + ")");
  for (int i = 10; i < 60; ++i) keys += ", key_" + std::to_string(i);
  const std::string text = message_text(before + keys + ")");
  EXPECT_LE(text.size(), 290 + place.size());
  EXPECT_GE(text.size(), 250 + place.size());
  EXPECT_THAT(text, testing::StartsWith(before + keys.substr(0, 150)));
  EXPECT_THAT(text, testing::EndsWith(" more)"));
}

// Whatever word stands before it, and whatever else is in parentheses.
TEST(MessageText, LeavesOutTheEndOfTheLongestList) {
  const std::string word(500, 'k'), key = "\"" + word + "\"";
  std::string names = "name_0";
  for (int i = 1; i < 40; ++i) names += ", name_" + std::to_string(i);
  const std::string text = error_text("/home/case.toml:9: [figures] (of a: step) homogenized.json has no " + key +
                                      ": " + key + " is not there (there is: " + names + ")");
  EXPECT_LE(text.size(), 290U + 5U) << text;
  EXPECT_THAT(text, HasSubstr("(there is: name_0, "));
  EXPECT_THAT(text, testing::EndsWith(" more)"));
}

TEST(ErrorText, LeavesOutTheMiddle) {
  const std::string front = "/home/somebody/case.toml:3: the first words ", back = " and the last words";
  std::string middle;
  for (int i = 0; i < 100; ++i) middle += fmt::format(" \xC3\xA4{}", i);
  const std::string text = error_text(front + middle + back);
  EXPECT_LE(text.size(), 290U + 14U);
  EXPECT_GE(text.size(), 270U);
  EXPECT_THAT(text, testing::StartsWith(front));
  EXPECT_THAT(text, HasSubstr(" ... "));
  EXPECT_THAT(text, testing::EndsWith(back));
  EXPECT_EQ(error_text(front + back), front + back);
}

TEST(Messages, OfAFigureWithALongKeyAreShort) {
  const TemporaryCase directory(R"(kind = "chain"
title = "one step"
[[step]]
case = "block"
figures = [{ says = "modulus", file = "homogenized.json", key = ")" +
                                std::string(7000, 'a') + R"(" }]
)");
  std::filesystem::create_directory(directory.path() / "block");
  directory.write("block/case.toml", R"(kind = "homogenize"
title = "one material"
[mesh]
generator = "box_hexes"
x = [{ length = "1 mm", cells = 2 }]
y = [{ length = "1 mm", cells = 2 }]
z = [{ length = "1 mm", cells = 2 }]
region = "rubber"
[materials.rubber]
regions = ["rubber"]
young_modulus = "10 MPa"
poisson_ratio = 0.4
)");
  const Outcome outcome = run({"run", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_LE(outcome.err.size(), 300 + directory.path().string().size()) << outcome.err;
}

TEST(MessageText, QuotesLongWordsTwiceInShort) {
  const std::string word(500, 'y');
  EXPECT_LE(message_text("/home/case.toml:3: \"" + word + "\": the unit \"" + word + "\" is not known").size(), 290U);
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

TEST(Messages, NameTheCaseWhereNoLineIsKnown) {
  const std::filesystem::path glued = std::filesystem::path(PFDM_INPUTS_DIR) / "../../../cases/cohesive_dcb";
  const Outcome outcome = run({"check", glued.string(), "--set", "materials.composite.young_modulus=1e-290 GPa"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("case.toml: interface \"glue\": "));
}

TEST(Messages, QuoteNoControlCharactersOfACase) {
  const TemporaryCase directory(replaced(bar_case(), "region = \"bar\"", "region = \"b\\u001bar\""));
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_NE(outcome.status, 0);
  EXPECT_EQ(std::ranges::count(outcome.err, '\x1b'), 0) << outcome.err;
}

}  // namespace
}  // namespace pfdm::this_file
