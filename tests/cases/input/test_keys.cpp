// Rows of keys: each says what it is; the schema for editors and the reference of the repository are made of them.

#include "cases/program/input/case_files/off_defaults.h"
#include "cases/program/input/config/heat_units.h"
#include "cases/program/kinds.h"
#include "cases/program/reference/key_reference.h"
#include "cases/program/reference/key_schema.h"
#include "cases/program/reference/key_words.h"
#include "cases/program/reference/unit_patterns.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace pfdm::this_file {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<KindKeys> all_keys() {
  std::vector<KindKeys> kinds;
  for (const CaseKind& kind : case_kinds()) kinds.push_back({kind.name, kind.keys()});
  return kinds;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

TEST(Keys, SayWhatTheyAre) {
  std::size_t n = 0;
  for_each_key(all_keys(), [&](const PlacedKey& placed) {
    const Key& key = *placed.key;
    const auto n_words = 1 + std::ranges::count(key.sentence, ' ');
    EXPECT_TRUE(key.sentence.ends_with('.') && n_words >= 2 && n_words <= 25) << placed.path << ": " << key.sentence;
    EXPECT_FALSE(words_of(key.type).empty()) << placed.path;
    EXPECT_FALSE(placed.table->sentence.empty()) << placed.path;
    ++n;
  });
  EXPECT_GT(n, 500u);
}

void expect_sound(const KeyType& type, const std::string& path) {
  if (type.kind == KeyType::Kind::quantity) {
    ASSERT_NE(type.due, nullptr) << path;
    const std::string example(type.due->example);
    if (type.due->si_unit == "1") return;  // "0.3" of a plain number
    EXPECT_NO_THROW(parse_quantity(example, *type.due)) << path;
    EXPECT_NE(unit_pattern(*type.due), ".+") << path << ": editors know no units of this dimension";
    EXPECT_TRUE(std::regex_match(example, std::regex(quantity_pattern(*type.due, range::any))))
        << path << ": " << example;
  }
  EXPECT_TRUE(type.kind != KeyType::Kind::choice || !type.words.empty()) << path;
  for (const KeyType& part : type.parts) expect_sound(part, path);
}

TEST(Keys, HaveTypesWithExamplesThatHold) {
  for_each_key(all_keys(), [](const PlacedKey& placed) { expect_sound(placed.key->type, placed.path); });
}

/// Where a table's rows depend on a key, each of its words has some.
TEST(Keys, AreDecidedByKeysThatThereAre) {
  std::set<const KeyTable*> seen;
  for_each_key(all_keys(), [&](const PlacedKey& placed) {
    const KeyTable& table = *placed.table;
    if (table.decided_by.empty() || !seen.insert(&table).second) return;
    const auto row = std::ranges::find(table.keys, table.decided_by, &Key::name);
    ASSERT_NE(row, table.keys.end()) << table.name;
    const std::vector<std::string>& words = row->type.as(KeyType::Kind::choice)->words;
    for (const Key& key : table.keys) {
      std::istringstream only{std::string(key.only)};
      for (std::string word; only >> word;)
        EXPECT_EQ(std::ranges::count(words, word), 1) << table.name << ": " << key.name;
    }
  });
}

TEST(Keys, ThatAReaderAsksForHaveARow) {
  using namespace keys;
  static const KeyTable rows{
      .name = "x", .sentence = "A table.", .keys = {{"size", number(), "1", "How large it is."}}};
  const Config config("size = 2\n", "case.toml");
  const ConfigTable table = config.root().with_keys(rows);
  EXPECT_EQ(table.number("size"), 2.0);
  EXPECT_THROW(table.find("colour"), std::logic_error);
  EXPECT_THROW(table.quantity("size"), std::logic_error);
}

struct UnitCase {
  const Dimension& due;
  std::vector<std::string> right, wrong;
};

/// What UDUNITS says of a unit the pattern says too; of these, which people write.
TEST(Keys, HavePatternsThatAgreeWithTheUnitsLibrary) {
  const UnitCase cases[] = {
      {dimension::stress,
       {"75 MPa", "1.5 GPa", "3 N/mm^2", "2e3 kN/m2", "1 J/m^3", "14 psi", "2 bar", "10 Msi"},
       {"75 um", "1 N", "3 J/m^2", "4 g"}},
      {dimension::length, {"20 um", "0.02 mm", "1 inch", "3 m", "5 nm", "+2 cm"}, {"20 MPa", "3 s", "1 m^2", "2 mm/s"}},
      {dimension::toughness,
       {"10 J/m^2", "2.7 kJ/m^2", "0.01 N/mm", "4 dyn/cm", "3 N/m", "5 mJ/mm^2"},
       {"10 J", "2 N", "1 Pa", "3 J/m^3"}},
      {dimension::acceleration, {"5 g0", "-9.81 m/s^2", "3 mm/s2"}, {"5 g", "2 m/s", "1 Hz"}},
      {dimension::acceleration_density, {"0.05 g0^2/Hz", "3 m^2/s^4/Hz"}, {"0.05 g0/Hz", "1 g0^2"}},
      {dimension::time, {"1 ms", "7 day", "2 min", "3 h"}, {"1 mm", "2 Hz"}},
      {dimension::frequency, {"2 kHz", "3 1/s", "4 s^-1"}, {"2 s", "1 rad"}},
      {dimension::rate, {"1e-4 1/s", "2 s-1", "1e-4/s"}, {"1 s", "3 m/s"}},
      {dimension::temperature, {"20 degC", "293.15 K"}, {"20 J", "3 1/K"}},
      {dimension::density, {"1030 kg/m^3", "1.03 g/cm^3", "2 g/cm3", "62 lbm/ft^3"}, {"1 kg", "3 kg/m^2"}},
      {dimension::compliance, {"2 um/kN", "1e-6 m/N"}, {"2 kN/um", "1 m"}},
      {dimension::interface_stiffness, {"1e12 Pa/m", "3 MPa/mm", "2 N/mm^3"}, {"1e12 Pa", "3 N/m"}},
      {dimension::viscosity, {"1 kPa s", "2 Pa.s"}, {"1 kPa", "3 s"}},
      {dimension::angle, {"30 degree", "0.5 rad", "1 arc_minute"}, {"30 K", "1 m"}},
      {dimension::velocity, {"1 mm/s", "2 m/s"}, {"1 m", "2 m/s^2"}},
      {dimension::energy, {"1 mJ", "3 N m", "2 uJ"}, {"1 J/m", "2 W"}},
      {dimension::force, {"10 N", "2 kN", "1 lbf", "3 kp"}, {"10 Pa", "2 N/m"}},
      {dimension::mass, {"50 g", "3 kg"}, {"50 N", "1 m"}},
      {dimension::heat_flux, {"100 W/m^2", "2 kW m-2"}, {"100 W", "2 J/m^2"}},
      {dimension::molar_energy, {"60 kJ/mol", "6e4 J/mol"}, {"60 kJ", "2 J/kg"}},
      {dimension::area, {"4 mm^2", "1 cm2"}, {"4 mm", "1 m^3"}},
  };
  for (const auto& [due, right, wrong] : cases) {
    const std::regex pattern(quantity_pattern(due, range::any));
    for (const std::string& text : right) {
      EXPECT_NO_THROW(parse_quantity(text, due)) << text;
      EXPECT_TRUE(std::regex_match(text, pattern)) << text << " as " << due.name;
    }
    for (const std::string& text : wrong) {
      EXPECT_THROW(parse_quantity(text, due), InputError) << text;
      EXPECT_FALSE(std::regex_match(text, pattern)) << text << " as " << due.name;
    }
  }
}

TEST(Keys, HavePatternsThatKnowTheRange) {
  const std::regex positive(quantity_pattern(dimension::length, range::positive)),
      not_negative(quantity_pattern(dimension::length, range::not_negative));
  for (const char* text : {"1 um", "0.05 mm", "1e-3 m", "10 um", ".5 mm"})
    EXPECT_TRUE(std::regex_match(text, positive)) << text;
  for (const char* text : {"0 um", "0.0 mm", "-1 m"}) EXPECT_FALSE(std::regex_match(text, positive)) << text;
  EXPECT_TRUE(std::regex_match("0 um", not_negative));
  EXPECT_FALSE(std::regex_match("-1 um", not_negative));
}

const KeyTable& layer_keys() {
  using namespace keys;
  static const KeyTable table{.name = "layers",
                              .sentence = "Layers.",
                              .keys = {{"name", text("name"), "", "Name."},
                                       {"thickness", quantity(dimension::length), "\"0.2 mm\"", "Thickness."}}};
  return table;
}

const KeyTable& oven_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "",
      .sentence = "An oven.",
      .keys = {{"title", text("line"), "", "Title."},
               {"air", quantity(dimension::temperature), "\"293.15 K\"", "Air."},
               {"inside", quantity(dimension::temperature), "\"293.15 K\"", "Inside."},
               {"steps", whole(range::count), "10", "Steps."},
               {"axis", direction(), "[0, 0, 1]", "Axis."},
               {"other_axis", direction(), "[0, 0, 1]", "Other axis."},
               {"heat", varying(quantity(dimension::force)), "that of the file", "Heat."},
               {"least", number(), "0: none", "Least."},
               {"most", number(), "0: none", "Most."},
               {"path", text("path"), "or table", "Path."},
               {"side", either({quantity(dimension::length), choice("side", {"free"})}), "\"free\"", "Side."},
               {"layers", tables(&layer_keys), "none", "Layers."}}};
  return table;
}

TEST(KeysOffDefaults, AreThoseWithAnotherValue) {
  const Config config(R"(title = "an oven"
air = "20 degC"
inside = "21 degC"
steps = 12
axis = [0, 0, 1.0]
other_axis = [0, 1, 0]
heat = { expr = "x", unit = "N" }
least = 0.0
most = 1e-9
path = "a"
side = "free"
layers = [{ name = "a", thickness = "200 um" }, { name = "b", thickness = "<b>2 mm" }]
)",
                      "case.toml");
  for (const ConfigTable& layer : config.root().with_keys(oven_keys()).tables("layers")) layer.has("name");
  std::vector<std::string> found;
  for (const OffDefault& key : off_defaults(config))
    found.push_back(fmt::format("{}: {}, not {}", key.path, key.value, key.otherwise));
  EXPECT_THAT(found,
              testing::ElementsAre("inside: \"21 degC\", not \"293.15 K\"", "steps: 12, not 10",
                                   "other_axis: [0, 1, 0], not [0, 0, 1]",
                                   "heat: { expr = \"x\", unit = \"N\" }, not that of the file",
                                   "most: 1e-9, not 0: none", "layers[1].thickness: \"<b>2 mm\", not \"0.2 mm\""));
}

TEST(KeysOffDefaults, CutsLongValuesBetweenCharacters) {
  std::string text = "layers = [{ name = \"a\", thickness = \"";
  for (int i = 0; i < 101; ++i) text += "µ";
  const Config config(text + "\" }]\n", "case.toml");
  config.root().with_keys(oven_keys()).tables("layers");
  const std::vector<OffDefault> found = off_defaults(config);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].value.size(), 199u + 4u);  // the quote, 99 of two bytes, " ..."
  EXPECT_TRUE(found[0].value.ends_with("µ ..."));
}

TEST(KeySchema, OfTheRepositoryIsThatOfTheRows) {
  EXPECT_EQ(text_of(fs::path(PFDM_CASES_DIR) / "case.schema.json"), key_schema(all_keys()))
      << "pfdm help --schema > cases/case.schema.json";
}

TEST(KeyReference, OfTheRepositoryIsThatOfTheRows) {
  const auto pages = key_reference(all_keys());
  const fs::path folder = fs::path(PFDM_CASES_DIR) / "reference";
  for (const auto& [name, text] : pages)
    EXPECT_TRUE(text_of(folder / name) == text) << name << ": pfdm help --reference cases/reference";
  for (const auto& entry : fs::directory_iterator(folder))
    EXPECT_TRUE(pages.contains(entry.path().filename().string())) << entry.path() << " is no page of the reference";
}

}  // namespace
}  // namespace pfdm::this_file
