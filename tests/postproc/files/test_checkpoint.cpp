#include "physics/error.h"
#include "postproc/fields/checkpoint.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;

const std::string hash = "9f86d081884c7d65";

FractureState awkward_state() {
  FractureState s;
  s.step = 17;
  s.load = 1.0 / 3.0;
  s.increment = 0.1;
  for (int i = 0; i < 5; ++i) s.displacement.emplace_back(std::sin(i), -0.0, 1e-310);
  s.damage = CellField<double>(std::vector<double>{0.1, 0.2, std::nextafter(1.0, 0.0)});
  s.driving_energy = CellField<double>(std::vector<double>{1e300, 0.0, -0.0});
  s.closure = CellField<double>({1.0, 1.0 / 7.0, 0.0});
  s.histories = CellHistories({0, 3, 2});
  s.histories.gradient(1) = Tensor::Constant(0.1);
  s.histories.of(1)[1] = std::nextafter(1.0, 0.0);
  s.histories.of(2)[0] = -0.0;
  s.interfaces = {{.reached = 0.1,
                   .reached_in_shear = 0.7,
                   .dissipated = 1.0 / 3.0,
                   .rubbed = -0.0,
                   .viscous = 1.0 / 7.0,
                   .overstress = 1e-310,
                   .branch = {Vector(1.0, -0.0, 2.0), Vector(3.0, 4.0, 5.0), Vector(1e-310, 6.0, 7.0)},
                   .slip = Vector(1e-9, -0.0, 3.0),
                   .opening = -0.0,
                   .shear = Vector(0.0, 1e-310, -2.0)}};
  s.boundary_force = {Vector(1, 2, 3), Vector(4, 5, 6)};
  s.energy = {std::exp(2.0), std::exp(0.5), std::exp(1.0), std::exp(-1.0), std::exp(-2.0)};
  s.heat = {.rise = CellField<double>({0.1, -0.0, 1e-310}),
            .made = CellField<double>({1.0, 2.0, 3.0}),
            .cycle = CellField<double>({4.0, 5.0, 1.0 / 3.0}),
            .transmitted = {7.0},
            .cycle_transmittance = {8.0},
            .cycle_change = 0.25,
            .account = {.made = 0.1, .stored = 0.2, .lost = -0.0},
            .duration = 3.0,
            .elapsed = 1.0 / 3.0,
            .stood_for = CellField<double>({5.0, 6.0, 7.0}),
            .stretch = 0.7,
            .felt = CellField<double>({0.2, -0.0, 1e-310})};
  s.fatigue = {.energy = CellField<double>({1e300, 0.1, -0.0}),
               .active = CellField<double>({0.3, 1.0 / 3.0, 1e-310}),
               .spent = CellField<double>({1.0, 2.0, 3.0}),
               .cycle_start = CellField<double>({4.0, 5.0, 6.0}),
               .cycle_growth = CellField<double>({7.0, 8.0, 1.0 / 7.0}),
               .computed_cycles = 3,
               .whole_cycles = 1e6 + 3.0,
               .jumped_cycles = 1e6};
  return s;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

TEST(Checkpoint, state_comes_back_bit_for_bit) {
  const TemporaryFolder folder;
  const FractureState s = awkward_state();
  write_checkpoint(folder / "c.bin", s, hash);
  const FractureState r = read_checkpoint(folder / "c.bin", hash);
  EXPECT_EQ(r.step, s.step);
  EXPECT_EQ(r.load, s.load);
  EXPECT_EQ(r.increment, s.increment);
  EXPECT_EQ(r.displacement, s.displacement);
  EXPECT_TRUE(std::signbit(r.displacement[0].y()));
  EXPECT_EQ(r.damage, s.damage);
  EXPECT_EQ(r.driving_energy, s.driving_energy);
  EXPECT_TRUE(std::signbit(r.driving_energy[2]));
  EXPECT_EQ(r.closure, s.closure);
  EXPECT_EQ(r.histories, s.histories);
  EXPECT_EQ(r.histories.of(0).size(), 0u);
  EXPECT_TRUE(same_bits(r.histories.of(1)[1], std::nextafter(1.0, 0.0)));
  EXPECT_TRUE(std::signbit(r.histories.of(2)[0]));
  EXPECT_EQ(r.interfaces, s.interfaces);
  EXPECT_EQ(r.fatigue, s.fatigue);
  EXPECT_TRUE(std::signbit(r.fatigue.energy[2]));
  EXPECT_TRUE(std::signbit(r.interfaces[0].rubbed));
  EXPECT_EQ(r.boundary_force, s.boundary_force);
  for (const EnergyEntry& entry : energy_entries)
    EXPECT_TRUE(same_bits(r.energy.*entry.value, s.energy.*entry.value)) << entry.column;
  EXPECT_EQ(r.heat, s.heat);
  EXPECT_TRUE(std::signbit(r.heat.account.lost));
  EXPECT_EQ(folder.n_entries(), 1u);
}

TEST(Checkpoint, an_empty_state_comes_back) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "c.bin", {}, "");
  EXPECT_EQ(read_checkpoint(folder / "c.bin", "").damage.size(), 0);
}

TEST(Checkpoint, finite_is_all_but_the_change_of_cycles_to_come) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  FractureState s = awkward_state();
  EXPECT_TRUE(is_finite(s));
  s.heat.cycle_change = infinity;
  EXPECT_TRUE(is_finite(s));
  s.heat.cycle_change = std::nan("");
  EXPECT_FALSE(is_finite(s));
  s = awkward_state();
  s.interfaces[0].branch[1][2] = infinity;
  EXPECT_FALSE(is_finite(s));
  s = awkward_state();
  s.histories.of(2)[0] = std::nan("");
  EXPECT_FALSE(is_finite(s));
}

TEST(Checkpoint, every_shortened_file_is_refused) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "c.bin", awkward_state(), hash);
  const std::string whole = content_of(folder / "c.bin");
  for (std::size_t n = 0; n < whole.size(); ++n) {
    put(folder / "short.bin", whole.substr(0, n));
    EXPECT_THAT(message_of<InputError>([&] { read_checkpoint(folder / "short.bin", hash); }), HasSubstr("truncated"))
        << n;
  }
  put(folder / "long.bin", whole + "x");
  EXPECT_THAT(message_of<InputError>([&] { read_checkpoint(folder / "long.bin", hash); }), HasSubstr("extended"));
}

TEST(Checkpoint, every_flipped_bit_is_noticed) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "c.bin", awkward_state(), hash);
  const std::string whole = content_of(folder / "c.bin");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ (1 << (i % 8)));
    put(folder / "damaged.bin", damaged);
    EXPECT_NE(message_of<InputError>([&] { read_checkpoint(folder / "damaged.bin", hash); }), "") << "byte " << i;
  }
}

TEST(Checkpoint, says_what_is_wrong) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& content, const std::string& wanted) {
    put(folder / "c.bin", content);
    return message_of<InputError>([&] { read_checkpoint(folder / "c.bin", wanted); });
  };
  write_checkpoint(folder / "good.bin", awkward_state(), hash);
  const std::string whole = content_of(folder / "good.bin");
  EXPECT_THAT(complaint(whole, "another"), HasSubstr("another case"));
  EXPECT_THAT(complaint(whole, "another"), HasSubstr(hash));
  std::string other = whole;
  other[8] = 19;
  EXPECT_THAT(complaint(other, hash), HasSubstr("has format 19; this program reads format 18"));
  other = whole;
  other[other.size() / 2] = static_cast<char>(other[other.size() / 2] ^ 4);
  EXPECT_THAT(complaint(other, hash), HasSubstr("checksum"));
  EXPECT_THAT(complaint("step,load,displacement_m and so on, long enough", hash), HasSubstr("is not a checkpoint"));
  EXPECT_THAT(message_of<InputError>([&] { read_checkpoint(folder / "none.bin", hash); }), HasSubstr("No such file"));
}

}  // namespace
}  // namespace pfdm::test::this_file
