// Vibration records in universal, HDF5 and WAV files; those in data/ were written by other programs.

#include "physics/error.h"
#include "postproc/records/signal_table.h"
#include "tests/postproc/temporary_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace pfdm::test::this_file {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path data = PFDM_TEST_DATA;

double base(int i) { return 0.5 * std::sin(0.7 * i); }
double relative(int i) { return -2.0 * std::cos(0.3 * i); }

void expect_example(const SignalTable& table, bool even, double accuracy) {
  ASSERT_EQ(table.columns.size(), 3u);
  EXPECT_EQ(table.columns[0].name, "time");
  EXPECT_EQ(table.columns[0].unit, "s");
  EXPECT_EQ(table.columns[1].unit, "m/s^2");
  ASSERT_EQ(table.columns[2].values.size(), 9);
  for (int i = 0; i < 9; ++i) {
    const double t = i / 100.0;
    EXPECT_NEAR(table.columns[0].values[i], even ? t : t * t + 0.25, 1e-5);
    EXPECT_NEAR(table.columns[1].values[i], base(i), accuracy);
    EXPECT_NEAR(table.columns[2].values[i], relative(i), accuracy);
  }
}

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
  f = {};
  f.data_type = 5;
  EXPECT_THAT(refused(f.text()), HasSubstr("complex"));
  f.data_type = 3;
  EXPECT_THAT(refused(f.text()), HasSubstr("data type 3 is not supported"));
  f = {};
  f.abscissa = "  0.00000E+00  0.00000E+00  0.00000E+00";
  EXPECT_THAT(refused(f.text()), HasSubstr("abscissa increment is 0"));
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

TEST(Hdf5, IsReadAsAnotherProgramWroteIt) {
  const SignalTable table = read_signals(data / "records.h5");
  EXPECT_EQ(table.remark, "synthetic: made by h5py for a test");
  ASSERT_EQ(table.columns.size(), 3u);  // neither the picture nor the text
  const auto column = [&](const std::string& name) {
    const auto found = std::ranges::find(table.columns, name, &SignalColumn::name);
    return found == table.columns.end() ? SignalColumn{"none of that name", "", Eigen::VectorXd::Zero(9)} : *found;
  };
  EXPECT_EQ(column("time").unit, "s");
  EXPECT_EQ(column("run_1/base").unit, "g0");
  EXPECT_EQ(column("run_1/relative").unit, "");
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(column("time").values[i], static_cast<double>(static_cast<float>(i / 100.0)));
    EXPECT_EQ(column("run_1/base").values[i], base(i));
    EXPECT_EQ(column("run_1/relative").values[i], std::round(100.0 * relative(i)));
  }
}

TEST(Hdf5, SaysWhatIsWrongWithAFile) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of<InputError>([&] { read_signals(folder / "none.h5"); }), HasSubstr("none.h5"));
  put(folder / "bad.hdf5", "no such thing");
  EXPECT_THAT(message_of<InputError>([&] { read_signals(folder / "bad.hdf5"); }),
              HasSubstr("not a readable HDF5 file"));
  std::string half = content_of(data / "records.h5");
  half.resize(half.size() / 2);
  put(folder / "half.h5", half);
  EXPECT_THAT(message_of<InputError>([&] { read_signals(folder / "half.h5"); }), HasSubstr("half.h5"));
}

TEST(Wav, IsReadAsAnotherProgramWroteIt) {
  const SignalTable table = read_signals(data / "float.wav"), integers = read_signals(data / "integer.wav");
  EXPECT_EQ(table.remark, "synthetic: made by SciPy for a test");
  ASSERT_EQ(table.columns.size(), 3u);
  EXPECT_EQ(table.columns[0].name, "time");
  EXPECT_EQ(table.columns[0].unit, "s");
  EXPECT_EQ(table.columns[1].name, "channel_1");
  EXPECT_EQ(table.columns[2].name, "channel_2");
  EXPECT_EQ(table.columns[2].unit, "");
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(table.columns[0].values[i], i / 100.0, 1e-15);
    EXPECT_EQ(table.columns[1].values[i], static_cast<double>(static_cast<float>(base(i))));
    EXPECT_EQ(table.columns[2].values[i], static_cast<double>(static_cast<float>(relative(i))));
    EXPECT_EQ(integers.columns[1].values[i], std::round(32768.0 * base(i) / 4.0) / 32768.0);
    EXPECT_EQ(integers.columns[2].values[i], std::round(32768.0 * relative(i) / 4.0) / 32768.0);
  }
}

TEST(Wav, SaysWhatIsWrongWithAFile) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& content) {
    put(folder / "bad.wav", content);
    return message_of<InputError>([&] { read_signals(folder / "bad.wav"); });
  };
  EXPECT_THAT(message_of<InputError>([&] { read_signals(folder / "none.wav"); }), HasSubstr("none.wav"));
  EXPECT_THAT(refused("no such thing"), HasSubstr("bad.wav: not a WAV file"));
  EXPECT_THAT(refused(content_of(data / "float.wav").substr(0, 100)), HasSubstr("bad.wav: the file is cut short"));
  std::string empty = content_of(data / "integer.wav").substr(0, 44);
  std::fill(empty.begin() + 40, empty.end(), '\0');
  EXPECT_THAT(refused(empty), HasSubstr("bad.wav: the file has no samples"));
  std::string law = content_of(data / "integer.wav");
  law.replace(20, 16, std::string("\x07\0\x02\0\x64\0\0\0\xc8\0\0\0\x02\0\x08\0", 16));
  EXPECT_THAT(refused(law), HasSubstr("neither integers nor floating-point numbers"));
  const std::string aiff(
      "FORM\0\0\0\x32"
      "AIFFCOMM\0\0\0\x12\0\x01\0\0\0\x02\0\x10\x40\x0e\xac\x44\0\0\0\0\0\0"
      "SSND\0\0\0\x0c\0\0\0\0\0\0\0\0\0\x01\0\x02",
      58);
  EXPECT_THAT(refused(aiff), HasSubstr("bad.wav: not a WAV file"));
}

/// float.wav with something before the samples.
std::string with_chunk(const std::string& chunk) {
  std::string content = content_of(data / "float.wav");
  return content.insert(content.find("data"), chunk);
}

TEST(Wav, WhatIsCutIsRefusedWhateverComesBeforeTheSamples) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& content) {
    put(folder / "bad.wav", content);
    return message_of<InputError>([&] { read_signals(folder / "bad.wav"); });
  };
  std::string list = "LIST" + std::string("\xdc\x09\0\0INFO", 8);  // 2524 bytes: 4 and 63 entries of 40
  for (int i = 0; i < 63; ++i) list.append("ICMT\x20\0\0\0", 8).append(31, 'x').append(1, '\0');
  std::string cut = with_chunk(list);
  const std::size_t samples = cut.find("data") + 8;
  put(folder / "whole.wav", cut);
  EXPECT_EQ(read_signals(folder / "whole.wav").columns[0].values.size(), 9);
  EXPECT_THAT(refused(cut.substr(0, samples + 36)), HasSubstr("its header promises 72 bytes of samples, 36 are there"));
  std::string large = with_chunk("");
  large.replace(0, 8, "RF64\xff\xff\xff\xff");
  large.insert(12, std::string("ds64\x1c\0\0\0\xd6\0\0\0\0\0\0\0\x48\0\0\0\0\0\0\0\x09", 25) + std::string(11, '\0'));
  large.replace(large.find("data") + 4, 4, "\xff\xff\xff\xff");
  EXPECT_THAT(refused(large), HasSubstr("bad.wav: RF64 files are not read"));
}

// Its length was not known when the header was written.
TEST(Wav, OfAStreamIsReadToItsEnd) {
  const TemporaryFolder folder;
  std::string stream = content_of(data / "float.wav");
  const std::size_t samples = stream.find("data") + 8;
  stream.resize(samples + 72);
  stream.replace(4, 4, "\xff\xff\xff\xff");
  stream.replace(samples - 4, 4, "\xff\xff\xff\xff");
  put(folder / "stream.WAV", stream);
  const SignalTable table = read_signals(folder / "stream.WAV");
  ASSERT_EQ(table.columns.size(), 3u);
  ASSERT_EQ(table.columns[1].values.size(), 9);
  EXPECT_EQ(table.columns[1].values[8], static_cast<double>(static_cast<float>(base(8))));
  put(folder / "stream.WAV", stream.substr(0, samples + 70));
  EXPECT_THAT(message_of<InputError>([&] { read_signals(folder / "stream.WAV"); }), HasSubstr("within a sample"));
}

}  // namespace
}  // namespace pfdm::test::this_file
