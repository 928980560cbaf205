#include "physics/error.h"
#include "postproc/files/csv_table.h"
#include "postproc/records/signal_table.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace pfdm::test::this_file {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

bool is_known_unit(std::string_view text) { return text == "mm" || text == "N" || text == "kN" || text == "s"; }

CsvTable read_foreign(const std::string& text, CsvOptions options = {}) {
  const TemporaryFolder folder;
  std::ofstream(folder / "x.csv", std::ios::binary) << text;
  options.is_foreign = true;
  options.is_unit = is_known_unit;
  return read_csv(folder / "x.csv", options);
}

struct Layout {
  std::string name;
  std::string text;
  std::vector<std::string> names{"u", "f"};
  std::vector<std::string> units{"", ""};
};

class ForeignCsv : public testing::TestWithParam<Layout> {};

// All of these say the same: u is 0.5 and -1.25, f is 10 and 2000.
TEST_P(ForeignCsv, IsReadAsItIsMeant) {
  const CsvTable table = read_foreign(GetParam().text);
  EXPECT_EQ(table.names, GetParam().names);
  EXPECT_EQ(table.units, GetParam().units);
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_THAT(table.columns[0], ElementsAre(0.5, -1.25));
  EXPECT_THAT(table.columns[1], ElementsAre(10.0, 2000.0));
}

const Layout layouts[] = {
    {"commas", "u,f\n0.5,10\n-1.25,2e3\n"},
    {"semicolons", "u;f\n0.5;10\n-1.25;2000\n"},
    {"semicolons_and_decimal_commas", "u;f\n0,5;10,0\n-1,25;2,0E+03\n"},
    {"tabs_and_decimal_commas", "u\tf\r\n0,5\t10\r\n-1,25\t2000\r\n"},
    {"blanks", "u   f\n 0.5    10\n-1.25 2000.\n"},
    {"blanks_and_decimal_commas", "u f\n0,5 10\n-1,25 2000\n"},
    {"blanks_and_tabs_between_numbers_and_signs", "u f\n+0.5\t10\n-1.25  +2000\n"},
    {"byte_order_mark", "\xEF\xBB\xBFu;f\n0,5;10\n-1,25;2000\n"},
    {"separators_at_the_ends", "u;f;\n0,5;10;\n-1,25;2000;\n"},
    {"separators_at_the_ends_of_rows", "u;f\n0,5;10;\n-1,25;2000;\n"},
    {"quotes", "\"u\",\"f\"\n\"0.5\",\"10\"\n\"-1.25\",\"2000\"\n"},
    {"separator_within_quotes", "\"u, way\",f\n0.5,10\n-1.25,2000\n", {"u, way", "f"}},
    {"comma_in_a_name", "u, way;f\n0,5;10\n-1,25;2000\n", {"u, way", "f"}},
    {"lines_before_the_names", "Machine X\nspeed;1,5;mm/min\n\nu;f\n0,5;10\n-1,25;2000\n"},
    {"row_of_units", "u,f\nmm,N\n0.5,10\n-1.25,2000\n", {"u", "f"}, {"mm", "N"}},
    {"row_of_units_in_brackets", "u;f\n[mm];(kN)\n0,5;10\n-1,25;2000\n", {"u", "f"}, {"mm", "kN"}},
    {"row_of_units_below_a_title", "test 5;no;\nu;f;\n[mm];-;\n0,5;10;\n-1,25;2000;\n", {"u", "f"}, {"mm", "-"}},
    {"units_in_names", "u [mm],f (N)\n0.5,10\n-1.25,2000\n", {"u [mm]", "f (N)"}, {"mm", "N"}},
    {"brackets_that_are_no_unit", "u (left),f\n0.5,10\n-1.25,2000\n", {"u (left)", "f"}},
    {"comments", "# a, b\nu,f\n0.5,10\n# c\n-1.25,2000\n"},
};
INSTANTIATE_TEST_SUITE_P(Layouts, ForeignCsv, testing::ValuesIn(layouts),
                         [](const auto& test) { return test.param.name; });

/// Of who uses all columns.
std::string complaint(const std::string& text, const CsvOptions& options = {}) {
  return message_of<InputError>([&] {
    const CsvTable table = read_foreign(text, options);
    for (std::size_t i = 0; i < table.names.size(); ++i) table.require_numbers(i);
  });
}

TEST(ForeignCsv, IsNeverReadInOneOfTwoWays) {
  EXPECT_THAT(complaint("u;f\n1,234;5\n2,500;6\n"),
              HasSubstr("x.csv, line 2: 1,234 may be a fraction or have its thousands apart"));
  EXPECT_THAT(complaint("u;remark\n1,234;a, b\n2,500;c, d\n"), HasSubstr("line 2: 1,234 may be a fraction"));
  EXPECT_THAT(read_foreign("u;f\n1,234;5\n0,500;6\n").columns[0], ElementsAre(1.234, 0.5));
  EXPECT_THAT(read_foreign("u;f\n1,234;5\n2,5;6\n").columns[0], ElementsAre(1.234, 2.5));
  EXPECT_THAT(read_foreign("u;f\n1,234;5\n", {.marks = {.decimal = ','}}).columns[0], ElementsAre(1.234));
  EXPECT_THAT(complaint("u;f\n1,234;5\n", {.marks = {.decimal = '.'}}), HasSubstr("line 2: \"1,234\" in column \"u\""));
  EXPECT_THAT(complaint("u;f\n1.234,5;5\n"), HasSubstr("line 2: \"1.234,5\" in column \"u\" is not a number"));
  EXPECT_THAT(complaint("u,f\n0,5,1,5\n"), HasSubstr("line 2: found 4 entries in a table of 2 columns; numbers with a "
                                                     "decimal comma need another separator"));
  EXPECT_THAT(complaint("u;f\n0,5;1\n0.5;1\n"), HasSubstr("line 3: \"0.5\" in column \"u\" is not a number, as 0,5"));
  EXPECT_THAT(complaint("u;f\n0,5;1,5\n0;1;2\n"), HasSubstr("line 3: found 3 entries in a table of 2 columns"));
  EXPECT_THAT(complaint("a b,c d\n1 2,3 4\n", {.marks = {.decimal = '.'}}), HasSubstr("line 2"));
  EXPECT_THAT(complaint("u;f\n"), HasSubstr("no rows of numbers"));
  EXPECT_THAT(complaint(std::string("\xFF\xFEu\0;\0", 6)), HasSubstr("it is UTF-16; save it as UTF-8"));
}

TEST(ForeignCsv, TakesTheSeparatorThatMakesNumbers) {
  EXPECT_EQ(read_foreign("a,b c,d\n1,2 3,4\n").names, (std::vector<std::string>{"a,b", "c,d"}));
  EXPECT_EQ(read_foreign("\"a,\"\tb\n1\t2\n").names, (std::vector<std::string>{"a,", "b"}));
  EXPECT_THAT(read_foreign("u,f\n1,234\n").columns[1], ElementsAre(234.0));
  EXPECT_THAT(read_foreign("u\n1,5\n2,25\n").columns[0], ElementsAre(1.5, 2.25));
  EXPECT_THAT(read_foreign("u\n1\n2\n").columns[0], ElementsAre(1.0, 2.0));
}

struct OtherEntries {
  std::string name;
  std::string text;
  std::vector<std::string> names{"u", "f", "remark"};
};

class CsvWithOtherEntries : public testing::TestWithParam<OtherEntries> {};

// The columns u and f are those above, whatever stands beside them.
TEST_P(CsvWithOtherEntries, AreReadWhereTheyAreNumbers) {
  const CsvTable table = read_foreign(GetParam().text);
  EXPECT_EQ(table.names, GetParam().names);
  EXPECT_THAT(table.column("u"), ElementsAre(0.5, -1.25));
  EXPECT_THAT(table.column("f"), ElementsAre(10.0, 2000.0));
}

const OtherEntries other_entries[] = {
    {"text", "u,f,remark\n0.5,10,start\n-1.25,2000,end of test\n"},
    {"text_in_front_of_one_row", "remark,u,f\nstart,0.5,10\n,-1.25,2000\n", {"remark", "u", "f"}},
    {"text_in_one_row", "u,f,remark\n0.5,10,\n-1.25,2000,end\n"},
    {"text_and_numbers", "u,f,remark\n0.5,10,3\n-1.25,2000,end\n"},
    {"gaps", "u;f;remark\n0,5;10;\n-1,25;2000;7\n"},
    {"clocks",
     "remark;u;f\n01.02.2024 10:00:00,5;0,5;10,0\n01.02.2024 10:00:01,0;-1,25;2000,0\n",
     {"remark", "u", "f"}},
    {"clocks_between_tabs", "remark\tu\tf\n10:00:00\t0.5\t10\n10:00:01\t-1.25\t2000\n", {"remark", "u", "f"}},
    {"gaps_at_the_front_of_lines_with_tabs", "remark\tu\tf\n\t0.5\t10\n3\t-1.25\t2000\n", {"remark", "u", "f"}},
    {"rows_that_end_early", "u,f,remark,x\n0.5,10\n-1.25,2000,a,2\n", {"u", "f", "remark", "x"}},
    {"text_with_the_separator_in_quotes", "u,f,remark\n0.5,10,\"a, b\"\n-1.25,2000,\"c, 2\"\n"},
    {"text_with_blanks_and_numbers", "u,f,remark\n0.5,10,1 2 3 4\n-1.25,2000,1 2 3 4\n"},
    {"lines_of_one_name_and_one_number", "width;3\nlength;5\nu;f;remark\nmm;N;-\n0,5;10;a\n-1,25;2000;b\n"},
    {"lines_as_long_as_the_rows", "sample;4;x\nspeed;5;y\nu;f;remark\n0,5;10;a\n-1,25;2000;b\n"},
    {"units_below_the_names", "u,f,remark\nmm,N,\n0.5,10,a\n-1.25,2000,b\n"},
    {"a_name_twice_and_one_missing",
     "u,f,remark,,remark\n0.5,10,1,2,\n-1.25,2000,3,4,x\n",
     {"u", "f", "remark", "", "remark"}},
    {"names_that_are_numbers", "u,f,0.01\n0.5,10,1\n-1.25,2000,2\n", {"u", "f", "0.01"}},
};
INSTANTIATE_TEST_SUITE_P(Entries, CsvWithOtherEntries, testing::ValuesIn(other_entries),
                         [](const auto& test) { return test.param.name; });

TEST(ForeignCsv, IsAtFaultWhereTextIsUsed) {
  const CsvTable table = read_foreign("u,f\n0.5,10\nstop,NaN\n1,pause\n");
  EXPECT_THAT(table.faults[0], HasSubstr("x.csv, line 3: \"stop\" in column \"u\" is not a number"));
  EXPECT_THAT(table.faults[1], HasSubstr("x.csv, line 4: \"pause\" in column \"f\""));
  EXPECT_EQ(table.n_rows(), 3u);
  EXPECT_TRUE(std::isnan(table.columns[0][1]));
  EXPECT_EQ(table.columns[0][2], 1.0);
  EXPECT_TRUE(std::isnan(table.columns[1][1]));
}

TEST(ForeignCsv, MayHaveNoNames) {
  for (const char* text : {"0.5,10\n-1.25,2000\n", "digitised\n0.5 10\n-1.25 2000\n", "0,5;10\n-1,25;2000\n"}) {
    const CsvTable table = read_foreign(text);
    EXPECT_FALSE(table.has_names());
    ASSERT_EQ(table.columns.size(), 2u);
    EXPECT_THAT(table.columns[0], ElementsAre(0.5, -1.25));
    EXPECT_THAT(table.columns[1], ElementsAre(10.0, 2000.0));
    EXPECT_THAT(message_of<InputError>([&] { (void)table.find("u"); }),
                HasSubstr("there is no column \"u\": the file has 2 columns without names; give the number of one"));
  }
}

TEST(ForeignCsv, MayHaveItsThousandsApart) {
  const auto f = [](const std::string& text, char mark) {
    return read_foreign(text, {.marks = {.thousands = mark}}).columns[1];
  };
  EXPECT_THAT(f("u;f\n0,5;1.032,66\n1,5;12.345.678,5\n2;999\n", '.'), ElementsAre(1032.66, 12345678.5, 999.0));
  EXPECT_THAT(f("u,f\n0.5,\"1,032.66\"\n1.5,\"-12,345\"\n", ','), ElementsAre(1032.66, -12345.0));
  EXPECT_THAT(f("u;f\n0.5;1'032.66\n1.5;2000\n", '\''), ElementsAre(1032.66, 2000.0));
  EXPECT_THAT(f("u;f\n0,5;1 032,66\n1,5;2000\n", ' '), ElementsAre(1032.66, 2000.0));
  EXPECT_THAT(complaint("u;f\n0,5;1.03,66\n1,5;2,5\n", {.marks = {.thousands = '.'}}), HasSubstr("\"1.03,66\""));
  EXPECT_THAT(complaint("u;f\n0,5;1.032,66\n1,5;2,5\n"),
              HasSubstr("line 2: \"1.032,66\" in column \"f\" is not a number, as 0,5 or -2e6; if its thousands are "
                        "apart, set thousands = \".\""));
}

TEST(CsvTable, FindsColumnsWithOtherCapitals) {
  const CsvTable table = read_foreign("Load,u [mm],U [in]\n0.5,10,0.01\n");
  EXPECT_EQ(table.find("load"), 0u);
  EXPECT_EQ(table.find("u"), 1u);
  EXPECT_THAT(message_of<InputError>([&] { (void)read_foreign("f,f\n1,2\n").find("f"); }),
              HasSubstr("there are 2 columns that may be \"f\" (available: f, f); the number of one"));
}

TEST(CsvTable, FindsColumnsWithoutTheirUnits) {
  const CsvTable table = read_foreign("u [mm],f [N],f [kN]\n0.5,10,0.01\n");
  EXPECT_EQ(table.find("u"), 0u);
  EXPECT_EQ(table.find("f [kN]"), 2u);
  EXPECT_THAT(message_of<InputError>([&] { (void)table.find("f"); }),
              HasSubstr("there are 2 columns that may be \"f\" (available: u [mm], f [N], f [kN])"));
  EXPECT_THAT(message_of<InputError>([&] { (void)table.find("w"); }), HasSubstr("there is no column \"w\""));
}

TEST(SignalTable, CsvMayHaveNoUnits) {
  const TemporaryFolder folder;
  put(folder / "a.csv", "sep=,\ntag:,plate\nstart:,2025-01-01_10:00\n\nn,x,note\n1,0.5,a\n2,0.25,b\n");
  const SignalTable table = read_signals(folder / "a.csv", {.is_unit = is_known_unit});
  ASSERT_EQ(table.columns.size(), 3u);
  EXPECT_EQ(table.columns[1].name, "x");
  EXPECT_EQ(table.columns[1].unit, "");
  EXPECT_EQ(table.columns[1].values[1], 0.25);
  EXPECT_THAT(table.columns[2].fault, HasSubstr("line 6: \"a\" in column \"note\""));
}

TEST(SignalTable, CsvMayBeOfASpreadsheet) {
  const TemporaryFolder folder;
  put(folder / "a.csv", "\xEF\xBB\xBFrig 3\ntime;x\n[s];[m/s^2]\n0,0;1,5\n0,1;\n");
  const SignalTable table = read_signals(folder / "a.csv");
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.remark, "rig 3");
  EXPECT_EQ(table.columns[1].name, "x");
  EXPECT_EQ(table.columns[1].unit, "m/s^2");
  EXPECT_EQ(table.columns[0].values[1], 0.1);
  EXPECT_EQ(table.columns[1].values[0], 1.5);
  EXPECT_TRUE(std::isnan(table.columns[1].values[1]));
}

}  // namespace
}  // namespace pfdm::test::this_file
