// Vibration records in universal files; those in data/ were written by other programs.

#include "physics/error.h"
#include "postproc/records/signal_table.h"
#include "tests/postproc/example_signals.h"
#include "tests/postproc/temporary_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;

TEST(UniversalFile, IsReadAsAnotherProgramWroteIt) {
  const SignalTable text = read_signals(data / "text_even.uff");
  expect_example(text, true, 1e-11);
  EXPECT_EQ(text.columns[1].name, "base_acceleration");
  EXPECT_EQ(text.columns[2].name, "relative_acceleration");
  expect_example(read_signals(data / "text_uneven.uff"), false, 1e-11);
  expect_example(read_signals(data / "binary_uneven.uff"), false, 0.0);
  const SignalTable binary = read_signals(data / "binary_even.uff");
  expect_example(binary, true, 0.0);
  EXPECT_EQ(binary.columns[1].name, "1+Z");  // its ID lines are alike
  EXPECT_EQ(binary.columns[2].name, "2+Z");
}

/// A dataset as the specification lays it out, by fields.
struct Function {
  std::string header = "    58";
  std::string id = "base";
  int function_type = 1, data_type = 2, n = 4, spacing = 1;
  std::string direction = "         7  -2";
  std::string abscissa = "  0.00000E+00  5.00000E-01  0.00000E+00";
  std::string unit = "m/s\xc2\xb2";
  std::string values = "  1.00000E+00 -2.00000E+00  3.00000E+00  4.50000E+00\n";
  std::string end = "    -1\n";

  std::string text() const {
    std::string result = "    -1\n" + header + "\n" + id + "\nNONE\nNONE\nNONE\nNONE\n";
    result += fmt::format("{:5}{:10}{:5}{:10} {:10}{} {:10}{:10}{:4}\n", function_type, 0, 0, 0, "NONE", direction,
                          "NONE", 0, 0);
    result += fmt::format("{:10}{:10}{:10}{}\n", data_type, n, spacing, abscissa);
    result += fmt::format("{:10}{:5}{:5}{:5} {:20} {:20}\n", 17, 0, 0, 0, "time", "s");
    result += fmt::format("{:10}{:5}{:5}{:5} {:20} {:20}\n", 12, 0, 0, 0, "acceleration", unit);
    result += "         0    0    0    0 NONE                 NONE\n";
    result += "         0    0    0    0 NONE                 NONE\n";
    return result + values + end;
  }
};

class UniversalFiles : public ::testing::Test {
 protected:
  SignalTable read(const std::string& content) {
    put(folder_ / "a.unv", content);
    return read_signals(folder_ / "a.unv");
  }
  std::string refused(const std::string& content) {
    return message_of<InputError>([&] { read(content); });
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(UniversalFiles, MayHaveTouchingNumbersOtherDatasetsAndWindowsEnds) {
  Function f;
  f.values = " -1.00000D+00-2.00000D+00\n  3.00000E+00  4.50000E+00\n";
  std::string content = "    -1\n   164\n         1SI\n    -1\n" + f.text();
  Function response;
  response.function_type = 4;  // a frequency response, complex
  response.data_type = 5;
  content += response.text();
  const SignalTable table = read(content);
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.columns[0].values, Eigen::Vector4d(0.0, 0.5, 1.0, 1.5));
  EXPECT_EQ(table.columns[1].values, Eigen::Vector4d(-1.0, -2.0, 3.0, 4.5));
  EXPECT_EQ(table.columns[1].unit, "m/s^2");
  std::string windows;
  for (const char c : Function().text()) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(windows).columns[1].values, Eigen::Vector4d(1.0, -2.0, 3.0, 4.5));
}

TEST_F(UniversalFiles, NameFunctionsByWhatTellsThemApart) {
  Function first, second;
  second.direction = "         8   3";
  EXPECT_EQ(read(first.text() + second.text()).columns[1].name, "7-Y");
  EXPECT_EQ(read(first.text() + second.text()).columns[2].name, "8+Z");
  second.direction = first.direction;
  EXPECT_EQ(read(first.text() + second.text()).columns[2].name, "function_2");
  second.id = "relative";
  EXPECT_EQ(read(first.text() + second.text()).columns[2].name, "relative");
}

template <class Number>
std::string bytes_of(std::initializer_list<Number> numbers, bool big_endian) {
  std::string bytes;
  for (const Number number : numbers) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    if (big_endian == (std::endian::native == std::endian::little)) std::reverse(raw, raw + sizeof number);
    bytes.append(raw, sizeof number);
  }
  return bytes;
}

std::string binary_header(int order, int format, int n_bytes) {
  return fmt::format("    58b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", order, format, 11, n_bytes, 0, 0, 0, 0);
}

TEST_F(UniversalFiles, MayBeBinaryInEitherByteOrderAndPrecision) {
  for (const bool big : {false, true}) {
    Function f;
    f.header = binary_header(big ? 2 : 1, 2, 16);
    f.values = bytes_of<float>({1.0F, -2.0F, 3.0F, 4.5F}, big);
    EXPECT_EQ(read(f.text()).columns[1].values, Eigen::Vector4d(1.0, -2.0, 3.0, 4.5));
    f.values += "\n";  // some writers break the line
    EXPECT_EQ(read(f.text()).columns[1].values, Eigen::Vector4d(1.0, -2.0, 3.0, 4.5));
    f.data_type = 4;
    f.spacing = 0;
    f.n = 2;
    f.values = bytes_of<float>({0.5F}, big) + bytes_of<double>({-0.1}, big) + bytes_of<float>({0.75F}, big) +
               bytes_of<double>({0.2}, big);
    const SignalTable mixed = read(f.text());
    EXPECT_EQ(mixed.columns[0].values, Eigen::Vector2d(0.5, 0.75));
    EXPECT_EQ(mixed.columns[1].values, Eigen::Vector2d(-0.1, 0.2));
  }
}

TEST_F(UniversalFiles, SayWhatIsWrongWithThem) {
  EXPECT_THAT(refused("hello\n"), HasSubstr("a.unv: this is not a universal file"));
  EXPECT_THAT(refused("    -1\n    15\n    -1\n"), HasSubstr("no dataset 58 (available: 15)"));
  Function f;
  f.function_type = 4;
  EXPECT_THAT(refused(f.text()), HasSubstr("no function of type 1, a time response (found types 4)"));
  f = {};
  f.n = 5;
  EXPECT_THAT(refused(f.text()), HasSubstr("a.unv, dataset of line 1: it has 4 of 5 data values"));
  f.n = 3;
  EXPECT_THAT(refused(f.text()), HasSubstr("more than its 3 data values"));
  f.n = -3;
  EXPECT_THAT(refused(f.text()), HasSubstr("it has -3 values"));
  f = {};
  f.values = "  1.00000E+00 two\n";
  EXPECT_THAT(refused(f.text()), HasSubstr("\"two\" is not a number"));
  f.values = "  1.0 1e999 2.0 3.0\n";
  EXPECT_THAT(refused(f.text()), HasSubstr("\"1e999\" is beyond the numbers of double precision"));
  f.values = "  1.0 1e-400 two 3.0\n";  // too small is 0
  EXPECT_THAT(refused(f.text()), HasSubstr("\"two\" is not a number"));
  f = {};
  f.data_type = 5;
  EXPECT_THAT(refused(f.text()), HasSubstr("complex"));
  f.data_type = 3;
  EXPECT_THAT(refused(f.text()), HasSubstr("data type 3 is not supported"));
  f = {};
  f.abscissa = "  0.00000E+00  0.00000E+00  0.00000E+00";
  EXPECT_THAT(refused(f.text()), HasSubstr("abscissa increment is 0"));
  f = {};
  f.abscissa = "          nan  5.00000E-01  0.00000E+00";
  EXPECT_THAT(refused(f.text()), HasSubstr("value 1 of its abscissa is nan; it must be finite"));
  f = {};
  f.end = "";
  EXPECT_THAT(refused(f.text()), HasSubstr("truncated"));
  f.values = "";
  EXPECT_THAT(refused(f.text()), HasSubstr("the file ends where a data value is expected"));
  f = {};
  f.header = binary_header(1, 1, 16);
  EXPECT_THAT(refused(f.text()), HasSubstr("only IEEE 754"));
  f.header = binary_header(3, 2, 16);
  EXPECT_THAT(refused(f.text()), HasSubstr("byte order 3"));
  f.header = binary_header(1, 2, 16);
  f.values = bytes_of<float>({1.0F, 2.0F, 3.0F}, false);
  EXPECT_THAT(refused(f.text()), HasSubstr("does not follow 4 binary values"));
  Function other;
  other.id = "relative";
  other.abscissa = "  0.00000E+00  2.50000E-01  0.00000E+00";
  EXPECT_THAT(refused(Function().text() + other.text()), HasSubstr("different times"));
}

}  // namespace
}  // namespace pfdm::test::this_file
