// A foreign library's crash ends a process of its own.

#include "physics/system/separate_process.h"

#include <gtest/gtest.h>
#include <Eigen/Core>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "physics/error.h"
#include "physics/system/packed_bytes.h"

namespace pfdm::this_file {
namespace {

TEST(SeparateProcess, ReturnsItsBytes) {
  const std::string many(1000000, '\0');  // more than a pipe holds
  EXPECT_EQ(computed_separately([&] { return many + "end"; }), many + "end");
  EXPECT_EQ(computed_separately([] { return std::string(); }), "");
}

TEST(SeparateProcess, SurvivesACrash) {
  EXPECT_EQ(computed_separately([]() -> std::string {
              std::raise(SIGKILL);
              return "alive";
            }),
            std::nullopt);
  EXPECT_EQ(computed_separately([]() -> std::string { std::quick_exit(0); }), std::nullopt);
}

TEST(SeparateProcess, PassesErrorsOn) {
  const auto message_of_input = [] {
    try {
      computed_separately([]() -> std::string { throw InputError("line 3"); });
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message_of_input(), "line 3");
  EXPECT_THROW(computed_separately([]() -> std::string { throw std::out_of_range("7"); }), ComputationError);
}

TEST(SeparateProcess, EndsAtItsLimits) {
  EXPECT_EQ(computed_separately(
                []() -> std::string {
                  std::atomic<std::size_t> rounds = 0;
                  while (true) ++rounds;
                },
                {.seconds = 1.0}),
            std::nullopt);
  const auto large = [] { return std::string(std::size_t{1} << 28, 'x'); };
  EXPECT_EQ(computed_separately(large, {.bytes = std::size_t{1} << 26}), std::nullopt);
  EXPECT_EQ(computed_separately(large, {.seconds = 60.0, .bytes = std::size_t{1} << 31}), large());
}

TEST(PackedBytes, ComeOutAsTheyWentIn) {
  const std::map<std::string, std::vector<int>> map{{"one", {1}}, {"none", {}}, {"two", {1, 2}}};
  const std::vector<Eigen::Vector3d> points{{1, 2, 3}, {4, 5, 6}};
  const std::vector<std::string> texts{"", std::string("a\0b", 3)};
  BytePacker packer;
  packer.put(map);
  packer.put(points);
  packer.put(texts);
  packer.put(true);
  const std::string bytes = packer.take();
  std::remove_const_t<decltype(map)> map_out;
  std::remove_const_t<decltype(points)> points_out;
  std::remove_const_t<decltype(texts)> texts_out;
  bool flag = false;
  ByteUnpacker unpacker(bytes);
  unpacker.take(map_out);
  unpacker.take(points_out);
  unpacker.take(texts_out);
  unpacker.take(flag);
  EXPECT_EQ(map_out, map);
  EXPECT_EQ(points_out, points);
  EXPECT_EQ(texts_out, texts);
  EXPECT_TRUE(flag);
}

}  // namespace
}  // namespace pfdm::this_file
