// Vibration records in HDF5 and WAV files; those in data/ were written by other programs.

#include "physics/error.h"
#include "postproc/records/signal_table.h"
#include "tests/postproc/example_signals.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;

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
