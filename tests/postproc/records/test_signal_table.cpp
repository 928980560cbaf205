#include "physics/error.h"
#include "postproc/records/signal_table.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <matio.h>

#include <cmath>
#include <memory>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;

SignalTable example() {
  Eigen::VectorXd t(3);
  t << 0.0, 1.0 / 3.0, 2.0 / 3.0;
  return {.remark = "synthetic: made for a test\nsecond line",
          .columns = {{"time", "s", t}, {"base_acceleration", "g0", t.array() * 1e-17 - 0.1}}};
}

TEST(SignalTable, CsvComesBackExactly) {
  const TemporaryFolder folder;
  write_signals_csv(folder / "a.csv", example());
  const SignalTable back = read_signals(folder / "a.csv");
  EXPECT_EQ(back.remark, example().remark);
  ASSERT_EQ(back.columns.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.columns[i].name, example().columns[i].name);
    EXPECT_EQ(back.columns[i].unit, example().columns[i].unit);
    EXPECT_EQ(back.columns[i].values, example().columns[i].values);
  }
  EXPECT_THAT(
      content_of(folder / "a.csv"),
      testing::StartsWith("# synthetic: made for a test\n# second line\ntime,base_acceleration\ns,g0\n0,-0.1\n"));
  EXPECT_EQ(folder.n_entries(), 1u);
}

TEST(SignalTable, CsvTakesBlanksWindowsEndsAndEmptyCells) {
  const TemporaryFolder folder;
  put(folder / "a.csv", "# remark\r\n time , x\r\n s , m/s^2\r\n0, 1\r\n\r\n1,\r\n2,nan");
  const SignalTable table = read_signals(folder / "a.csv");
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.columns[1].unit, "m/s^2");
  ASSERT_EQ(table.columns[1].values.size(), 3);
  EXPECT_EQ(table.columns[1].values[0], 1.0);
  EXPECT_TRUE(std::isnan(table.columns[1].values[1]));
  EXPECT_TRUE(std::isnan(table.columns[1].values[2]));
}

TEST(SignalTable, NamesFileAndLineOfWhatIsNoTable) {
  const TemporaryFolder folder;
  const std::string head = "time,x\ns,m/s^2\n0,1\n";
  const auto message = [&](const std::string& text) {
    put(folder / "bad.csv", text);
    return message_of<InputError>([&] { read_signals(folder / "bad.csv"); });
  };
  EXPECT_THAT(message(head + "1,2,3\n"), HasSubstr("bad.csv, line 4: found 3 entries in a table of 2 columns"));
  EXPECT_THAT(message("time,x\ns,m/s^2\n"), HasSubstr("bad.csv: it contains no rows of numbers"));
  put(folder / "text.csv", head + "1,two\n");
  EXPECT_THAT(read_signals(folder / "text.csv").columns[1].fault,
              HasSubstr("text.csv, line 4: \"two\" in column \"x\" is not a number"));
  EXPECT_THAT(message_of<InputError>([&] { read_signals(folder / "a.flac"); }), HasSubstr(".csv, .mat, .uff"));
  EXPECT_THAT(message_of<InputError>([&] { read_signals(folder / "none.csv"); }), HasSubstr("none.csv"));
}

void add_vector(mat_t* file, const char* name, std::vector<double> values) {
  std::size_t dims[] = {values.size(), 1};
  const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> variable(
      Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, values.data(), 0), &Mat_VarFree);
  Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_NONE);
}

void add_text(mat_t* file, const char* name, std::string text) {
  std::size_t dims[] = {1, text.size()};
  const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> variable(
      Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, dims, text.data(), 0), &Mat_VarFree);
  Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_NONE);
}

TEST(SignalTable, ReadsMatlabFiles) {
  const TemporaryFolder folder;
  {
    const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(
        Mat_CreateVer((folder / "a.mat").c_str(), nullptr, MAT_FT_MAT5), &Mat_Close);
    add_vector(file.get(), "base", {0.5, 0.25, -1.0});
    add_text(file.get(), "base_unit", "g0");
    add_vector(file.get(), "relative", {1.0, 2.0, 3.0});
  }
  const SignalTable table = read_signals(folder / "a.mat");
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.columns[0].name, "base");
  EXPECT_EQ(table.columns[0].unit, "g0");
  EXPECT_EQ(table.columns[0].values, Eigen::Vector3d(0.5, 0.25, -1.0));
  EXPECT_EQ(table.columns[1].unit, "");
  put(folder / "bad.mat", "no such thing");
  EXPECT_THAT(message_of<InputError>([&] { read_signals(folder / "bad.mat"); }), HasSubstr("bad.mat"));
}

/// Column-major; not written anywhere yet.
matvar_t* matrix(const char* name, std::size_t rows, std::size_t columns, std::vector<double> values) {
  std::size_t dims[] = {rows, columns};
  return Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, values.data(), 0);
}

/// rec(1), rec(2) with the fields base, a matrix of two columns, and its unit; and a matrix that is wider than long.
void write_structures(const std::filesystem::path& path) {
  const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5),
                                                          &Mat_Close);
  const char* fields[] = {"base", "base_unit"};
  std::size_t two[] = {2, 1};
  const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> rec(Mat_VarCreateStruct("rec", 2, two, fields, 2),
                                                              &Mat_VarFree);
  std::string unit = "m/s^2";
  std::size_t dims[] = {1, unit.size()};
  for (const int i : {0, 1}) {
    Mat_VarSetStructFieldByName(rec.get(), "base", static_cast<std::size_t>(i),
                                matrix("base", 3, 2, {1.0 + i, 2.0 + i, 3.0 + i, 4.0 + i, 5.0 + i, 6.0 + i}));
    Mat_VarSetStructFieldByName(rec.get(), "base_unit", static_cast<std::size_t>(i),
                                Mat_VarCreate("base_unit", MAT_C_CHAR, MAT_T_UTF8, 2, dims, unit.data(), 0));
  }
  Mat_VarWrite(file.get(), rec.get(), MAT_COMPRESSION_NONE);
  const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> wide(matrix("wide", 2, 3, {1.0, 4.0, 2.0, 5.0, 3.0, 6.0}),
                                                               &Mat_VarFree);
  Mat_VarWrite(file.get(), wide.get(), MAT_COMPRESSION_NONE);
}

TEST(SignalTable, ReadsMatricesAndStructuresOfMatlabFiles) {
  const TemporaryFolder folder;
  write_structures(folder / "s.mat");
  const SignalTable table = read_signals(folder / "s.mat");
  std::vector<std::string> names;
  for (const SignalColumn& column : table.columns) names.push_back(column.name);
  EXPECT_THAT(names, testing::ElementsAre("rec(1).base(:,1)", "rec(1).base(:,2)", "rec(2).base(:,1)",
                                          "rec(2).base(:,2)", "wide(1,:)", "wide(2,:)"));
  EXPECT_EQ(table.columns[1].values, Eigen::Vector3d(4.0, 5.0, 6.0));
  EXPECT_EQ(table.columns[2].values, Eigen::Vector3d(2.0, 3.0, 4.0));
  EXPECT_EQ(table.columns[2].unit, "m/s^2");
  EXPECT_EQ(table.columns[5].values, Eigen::Vector3d(4.0, 5.0, 6.0));
  EXPECT_EQ(table.columns[5].unit, "");
}

}  // namespace
}  // namespace pfdm::test::this_file
