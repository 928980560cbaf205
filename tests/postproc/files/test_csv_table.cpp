#include "physics/error.h"
#include "postproc/files/csv_table.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

namespace pfdm::test::this_file {
namespace {

std::string complaint(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder / "x.csv") << text;
  try {
    read_csv(folder / "x.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(CsvTable, comes_back_as_it_was_written) {
  const TemporaryFolder folder;
  CsvTable table;
  table.comments = {"synthetic"};
  table.add("time_s", {0.0, 0.1, 1e-300});
  table.add("stress_xx_Pa", {1.0 / 3.0, -2e9, 5e-324});
  write_csv(folder / "x.csv", table);
  const CsvTable again = read_csv(folder / "x.csv");
  EXPECT_EQ(again.comments, table.comments);
  EXPECT_EQ(again.names, table.names);
  EXPECT_EQ(again.columns, table.columns);
  EXPECT_EQ(again.column("stress_xx_Pa")[1], -2e9);
}

TEST(CsvTable, takes_blanks_comments_and_foreign_line_ends) {
  const TemporaryFolder folder;
  std::ofstream(folder / "x.csv") << "# a\r\n a , b \r\n\r\n1, 2\r\n# b\n3,4";
  const CsvTable table = read_csv(folder / "x.csv");
  EXPECT_EQ(table.names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(table.column("b"), (std::vector<double>{2.0, 4.0}));
}

TEST(CsvTable, takes_a_byte_order_mark) {
  const TemporaryFolder folder;
  std::ofstream(folder / "x.csv") << "\xEF\xBB\xBF"
                                     "a,b\r\n1,2\r\n";
  EXPECT_EQ(read_csv(folder / "x.csv").names, (std::vector<std::string>{"a", "b"}));
  std::ofstream(folder / "x.csv") << "\xEF\xBB\xBF# of a spreadsheet\na\n1\n";
  EXPECT_EQ(read_csv(folder / "x.csv").comments, (std::vector<std::string>{"of a spreadsheet"}));
}

TEST(CsvTable, has_units_and_gaps_where_they_may_be) {
  const TemporaryFolder folder;
  std::ofstream(folder / "x.csv") << "t,a\ns,m/s^2\n0,\n1,-inf\n";
  const CsvTable table = read_csv(folder / "x.csv", {.has_units = true, .has_gaps = true});
  EXPECT_EQ(table.units, (std::vector<std::string>{"s", "m/s^2"}));
  EXPECT_TRUE(std::isnan(table.column("a")[0]));
  EXPECT_EQ(table.column("a")[1], -std::numeric_limits<double>::infinity());
  write_csv(folder / "y.csv", table);
  EXPECT_EQ(content_of(folder / "y.csv"), "t,a\ns,m/s^2\n0,nan\n1,-inf\n");
  EXPECT_THAT(complaint("t,a\ns,m/s^2\n0,1\n"), testing::HasSubstr("line 2: \"s\" in column \"t\" is not a number"));
}

TEST(CsvTable, says_what_is_wrong_and_where) {
  using testing::HasSubstr;
  EXPECT_THAT(complaint("a,b\n1,2\n3\n"), HasSubstr("line 3: found 1 entries in a table of 2 columns"));
  EXPECT_THAT(complaint("a,b\n1,x\n"), HasSubstr("line 2: \"x\" in column \"b\" is not a number"));
  EXPECT_THAT(complaint("a,b\n1,nan\n"), HasSubstr("\"nan\" in column \"b\" is not a number, as 0.5 or -2e6"));
  EXPECT_THAT(complaint("a,b\n1,\n"), HasSubstr("\"\" in column \"b\" is not a number"));
  EXPECT_THAT(complaint("1,2\n3,4\n"),
              HasSubstr("line 1: expected the names of the columns, as in time_s,strain_xx, found \"1,2\""));
  EXPECT_THAT(complaint("a,a\n3,4\n"), HasSubstr("two columns are called \"a\""));
  EXPECT_THAT(complaint("a,b\n"), HasSubstr("no rows"));
  EXPECT_THAT(complaint("a\n1\n"), HasSubstr("nothing was thrown"));
  const TemporaryFolder folder;
  EXPECT_THROW(read_csv(folder / "none.csv"), InputError);
}

}  // namespace
}  // namespace pfdm::test::this_file
