#include "cases/program/input/config/config.h"

#include <gtest/gtest.h>

namespace pfdm::this_file {
namespace {

constexpr const char* example = R"(title = "an example"
count = 3
[mesh]
thickness = "2 um"
size = ["1 mm", "2 mm", "3 mm"]
[mesh.layers]
ratio = 1.5
[[part]]
name = "a"
[[part]]
name = "b"
broken = true
)";

template <class Body>
std::string message_of(const Body& body) {
  try {
    body();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Config, ReadsTypedValues) {
  const Config config(example, "case.toml");
  const ConfigTable root = config.root();
  EXPECT_EQ(root.string("title"), "an example");
  EXPECT_EQ(root.integer("count", range::positive), 3);
  EXPECT_DOUBLE_EQ(root.number("count", range::positive), 3.0);
  EXPECT_EQ(root.string("absent", "default"), "default");
  const ConfigTable mesh = root.table("mesh");
  EXPECT_DOUBLE_EQ(mesh.quantity("thickness", dimension::length), 2e-6);
  EXPECT_DOUBLE_EQ(mesh.at("size").list(3)[1].quantity(dimension::length), 2e-3);
  EXPECT_DOUBLE_EQ(mesh.table("layers").number("ratio", range::positive), 1.5);
  const auto parts = root.tables("part");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].string("name"), "a");
  EXPECT_EQ(parts[1].string("name"), "b");
  EXPECT_FALSE(parts[0].boolean("broken", false));
  EXPECT_TRUE(parts[1].boolean("broken", false));
  EXPECT_NO_THROW(config.reject_unknown_keys());
}

TEST(Config, TakesBareNumbersInSIUnitsInValuesOfAScriptAlone) {
  constexpr const char* text = "E = 30e9\nn = 2\nl = \"20 mm\"";
  EXPECT_THROW(Config(text, "case.toml").root().quantity("E", dimension::stress), InputError);
  const Config config(text, "Law", BareNumbers::in_si);
  EXPECT_EQ(config.root().quantity("E", dimension::stress), 30e9);
  EXPECT_EQ(config.root().quantity("n", dimension::length), 2.0);
  EXPECT_EQ(config.root().quantity("l", dimension::length), 0.02);
  EXPECT_EQ(message_of([&] { config.root().quantity("n", dimension::length, range::fraction); }),
            "Law: n: 2 must be between 0 and 1");
}

TEST(Config, NamesTheNearestKeyOfAMisspeltOne) {
  const Config config("[mesh]\nthicknes = \"2 um\"\n", "cases/x/case.toml");
  const ConfigTable mesh = config.root().table("mesh");
  EXPECT_EQ(message_of([&] { mesh.quantity("thickness", dimension::length); }),
            "cases/x/case.toml:2: [mesh] \"thicknes\" is not known here; did you mean \"thickness\"?");
  mesh.has("size");
  const std::string expected =
      "cases/x/case.toml:2: [mesh] \"thicknes\" is not known here; did you mean \"thickness\"? "
      "(allowed: size, thickness)";
  EXPECT_EQ(message_of([&] { config.reject_unknown_keys(); }), expected);
  EXPECT_EQ(message_of([&] { mesh.with_keys({"thickness", "size"}); }), expected);
  EXPECT_EQ(message_of([&] { config.reject_unknown_keys(); }), expected);
}

TEST(Config, TellsAKeyWithoutEffectFromAnUnknownOne) {
  const Config config("[mesh]\ncolour = 1\n", "case.toml");
  const ConfigTable mesh = config.root().table("mesh").with_keys({"size", "colour"});
  EXPECT_FALSE(mesh.has("size"));
  EXPECT_EQ(message_of([&] { config.reject_unknown_keys(); }),
            "case.toml:2: [mesh] \"colour\" has no effect with the other settings of this case");
  EXPECT_THROW(mesh.has("shape"), std::logic_error);
}

TEST(Config, KeepsKeysAllowedThatWereAskedForBeforeTheOthersWereNamed) {
  const Config config("[mesh]\ngenerator = \"box\"\nsize = 1\n", "case.toml");
  const ConfigTable mesh = config.root().table("mesh");
  EXPECT_EQ(mesh.string("generator"), "box");
  EXPECT_EQ(mesh.with_keys({"size"}).number("size", range::any), 1.0);
  EXPECT_EQ(mesh.string("generator"), "box");
  EXPECT_NO_THROW(config.reject_unknown_keys());
}

TEST(Config, HoldsATableThatIsReadAgainToTheKeysFirstNamed) {
  const Config config("[mesh]\nsize = 1\n", "case.toml");
  const ConfigTable mesh = config.root().table("mesh").with_keys({"size", "colour"});
  const ConfigTable again = config.root().table("mesh").with_keys({"size"});
  EXPECT_FALSE(again.has("colour"));  // still one of its keys
  EXPECT_THROW(config.root().table("mesh").with_keys({"size", "shape"}), std::logic_error);
}

TEST(Config, ListsWhatIsAllowedWhereNothingIsNear) {
  const Config config("[mesh]\ncolour = 1\n", "case.toml");
  config.root().table("mesh").has("size");
  EXPECT_EQ(message_of([&] { config.reject_unknown_keys(); }),
            "case.toml:2: [mesh] \"colour\" is not known here (allowed: size)");
}

TEST(Config, ChecksTablesInsideLists) {
  const Config config("[[part]]\nname = \"a\"\n[[part]]\nnam = \"b\"\n", "case.toml");
  for (const ConfigTable& part : config.root().tables("part")) part.has("name");
  EXPECT_NE(message_of([&] { config.reject_unknown_keys(); }).find("case.toml:4: [part] \"nam\""), std::string::npos);
}

TEST(Config, SaysWhichKeyIsMissingAndWhatIsDue) {
  const Config config("\n\n[mesh]\nsize = 1\n", "case.toml");
  const ConfigTable mesh = config.root().table("mesh");
  EXPECT_EQ(message_of([&] { mesh.quantity("thickness", dimension::length); }),
            "case.toml:3: [mesh] \"thickness\" is missing; expected a length, as in \"20 um\"");
  EXPECT_EQ(message_of([&] { mesh.string("generator"); }), "case.toml:3: [mesh] \"generator\" is missing");
}

TEST(Config, WantsUnits) {
  const Config config("size = 2.5\nlength = \"3 kg\"\nflag = true\n", "case.toml");
  const ConfigTable root = config.root();
  EXPECT_EQ(message_of([&] { root.quantity("size", dimension::length); }),
            "case.toml:1: size: 2.5 has no unit; expected a length, as in \"20 um\"");
  EXPECT_EQ(message_of([&] { root.quantity("length", dimension::length); }),
            "case.toml:2: length: \"3 kg\" is a mass; expected a length, as in \"20 um\"");
  EXPECT_EQ(message_of([&] { root.quantity("flag", dimension::length); }),
            "case.toml:3: flag: true is not a quantity; expected a length, as in \"20 um\"");
}

TEST(Config, ChecksRangesAndTypes) {
  const Config config("size = \"-2 um\"\nn = 0\nname = 3\nlist = [1, 2]\nmodel = \"AT3\"\n", "case.toml");
  const ConfigTable root = config.root();
  EXPECT_EQ(message_of([&] { root.quantity("size", dimension::length, range::positive); }),
            "case.toml:1: size: \"-2 um\" must be positive");
  EXPECT_EQ(message_of([&] { root.integer("n", range::positive); }), "case.toml:2: n: 0 must be positive");
  EXPECT_EQ(message_of([&] { root.string("name"); }), "case.toml:3: name: expected a text in quotes, found 3");
  EXPECT_EQ(message_of([&] { root.at("list").list(3); }), "case.toml:4: list: expected 3 entries, found 2");
  const std::string models[] = {"AT1", "AT2"};
  EXPECT_EQ(message_of([&] { root.at("model").one_of(models, "model"); }),
            "case.toml:5: model: \"AT3\" is not a model; did you mean \"AT1\"? (allowed: AT1, AT2)");
}

TEST(Config, GivesTheLineOfASyntaxError) {
  EXPECT_EQ(message_of([] { Config("a = 1\nb = = 2\n", "case.toml"); }).substr(0, 12), "case.toml:2:");
  EXPECT_NE(message_of([] { Config("a = 1\na = 2\n", "case.toml"); }), "no error");
  EXPECT_NE(message_of([] { Config("a = 2001-01-01\n", "case.toml"); }), "no error");
}

// Each part of a dotted key is a table within the one before: 30,000 of them overflow the stack of what reads them.
TEST(Config, RefusesKeysOfTooManyParts) {
  std::string many = "a";
  for (int i = 0; i < 30000; ++i) many += i % 3 == 0 ? ".a" : i % 3 == 1 ? " . 'b c'" : ".\"d\"";
  for (const std::string& text : {many + " = 1", "[" + many + "]", "[[" + many + "]]", "x = [{ " + many + " = 1 }]"})
    EXPECT_EQ(message_of([&] { Config("# a\nt = \"\"\"\nx\"\"\"\n" + text + "\n", "case.toml"); }),
              "case.toml:4: a key has more than 32 parts with dots between them");
  for (const char* ends_in_quotes : {"\"\"\"x\"\"\"\"", "'''x'''''"})
    EXPECT_EQ(message_of([&] { Config("t = " + std::string(ends_in_quotes) + "\n" + many + " = 1\n", "case.toml"); }),
              "case.toml:2: a key has more than 32 parts with dots between them");
  const std::string in_values = "a.b = 1\nt = '''" + many + "'''  # " + many + "\nx = [1.5, 2.5]\n";
  EXPECT_EQ(message_of([&] { Config(in_values, "case.toml"); }), "no error");
}

}  // namespace
}  // namespace pfdm::this_file
