#include "physics/error.h"
#include "postproc/curves/curve_csv.h"
#include "tests/postproc/temporary_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace pfdm::test::this_file {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

CurveRow awkward_row(Index step) {
  const double x = std::sin(1.0 + step) / 3.0;
  return {step,
          0.1 * step,
          1e-9 * x,
          Vector(x, -1e5 * x, 1e-320),
          {1e-7 * x * x, 0.1, 1.0 / 3.0, 1e-3 * x, 1e-4 * x},
          0.999999999999999,
          3e-17,
          12 + step};
}

void append(CurveFile& file, const CurveRow& row) {
  file.add(row);
  file.write();
}

void fill(const std::filesystem::path& path, Index n_rows) {
  CurveFile file(path);
  for (Index step = 0; step < n_rows; ++step) append(file, awkward_row(step));
}

TEST(CurveCsv, has_the_header_of_the_interface_and_a_row_per_step) {
  const TemporaryFolder folder;
  CurveFile file(folder / "c.csv");
  append(file, {1,
                0.05,
                1e-6,
                Vector(0.5, 0, -2),
                {1e-9, 2e-9, 3e-9, 4e-9, 5e-9, 6e-9, 7e-9, 8e-9, 9e-9, 1e-8},
                0.25,
                1e-12,
                7});
  EXPECT_EQ(content_of(folder / "c.csv"),
            "step,load,displacement_m,force_x_N,force_y_N,force_z_N,elastic_energy_J,fracture_energy_J,external_work_J,"
            "max_damage,damaged_volume_m3,staggered_iterations,viscous_dissipation_J,plastic_dissipation_J,"
            "interface_energy_J,interface_dissipation_J,strength_dissipation_J,eigenstrain_work_J,"
            "interface_viscous_dissipation_J\n"
            "1,0.05,1e-06,0.5,0,-2,1e-09,2e-09,3e-09,0.25,1e-12,7,4e-09,5e-09,6e-09,7e-09,8e-09,9e-09,1e-08\n");
  EXPECT_EQ(folder.n_entries(), 1u);
}

TEST(CurveCsv, numbers_come_back_exactly) {
  const TemporaryFolder folder;
  fill(folder / "c.csv", 4);
  EXPECT_THAT(read_curve(folder / "c.csv"),
              ElementsAre(awkward_row(0), awkward_row(1), awkward_row(2), awkward_row(3)));
}

TEST(CurveCsv, a_torn_last_line_is_left_out) {
  const TemporaryFolder folder;
  fill(folder / "c.csv", 2);
  const std::string whole = content_of(folder / "c.csv");
  const std::string complete_number = "2,0.2,1,1,1,1,1,1,1,1,1,3,1,1,1,12";  // of 123, perhaps
  for (const std::string torn : {"2", "2,0.1,3", complete_number.c_str()}) {
    put(folder / "torn.csv", whole + torn);
    EXPECT_THAT(read_curve(folder / "torn.csv"), ElementsAre(awkward_row(0), awkward_row(1))) << torn;
  }
  put(folder / "torn.csv", "step,lo");
  EXPECT_THAT(read_curve(folder / "torn.csv"), IsEmpty());
}

TEST(CurveCsv, a_restart_keeps_the_rows_up_to_its_step) {
  const TemporaryFolder folder;
  fill(folder / "c.csv", 4);
  put(folder / "c.csv", content_of(folder / "c.csv") + "4,0.4,1e-");
  CurveFile file(folder / "c.csv", 1);
  EXPECT_THAT(read_curve(folder / "c.csv"), ElementsAre(awkward_row(0), awkward_row(1)));
  append(file, awkward_row(2));
  EXPECT_THAT(read_curve(folder / "c.csv"), ElementsAre(awkward_row(0), awkward_row(1), awkward_row(2)));
  EXPECT_EQ(read_curve(folder / "c.csv"), file.rows());
}

TEST(CurveCsv, a_restarted_file_equals_an_unbroken_one) {
  const TemporaryFolder folder;
  fill(folder / "unbroken.csv", 6);
  fill(folder / "broken.csv", 5);
  CurveFile file(folder / "broken.csv", 2);
  for (Index step = 3; step < 6; ++step) append(file, awkward_row(step));
  EXPECT_EQ(content_of(folder / "broken.csv"), content_of(folder / "unbroken.csv"));
}

TEST(CurveCsv, newer_energies_of_earlier_builds_are_zero) {
  const TemporaryFolder folder;
  const std::string header = curve_header();
  const auto without = [&](const std::string& column) { return header.substr(0, header.find("," + column)) + "\n"; };
  const std::string row = "1,0.05,1e-06,0.5,0,-2,1e-09,2e-09,3e-09,0.25,1e-12,7,0,0,0,0,0,9e-09";
  put(folder / "c.csv", without("interface_viscous_dissipation_J") + row + "\n");
  const std::vector<CurveRow> rows = read_curve(folder / "c.csv");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].energy.eigenstrain_work, 9e-09);
  EXPECT_EQ(rows[0].energy.interface_viscous_dissipation, 0.0);
  put(folder / "c.csv", without("interface_viscous_dissipation_J") + row + ",0\n");
  EXPECT_THAT(message_of<InputError>([&] { read_curve(folder / "c.csv"); }), HasSubstr("c.csv, line 2:"));
  put(folder / "c.csv", without("eigenstrain_work_J"));
  EXPECT_THAT(message_of<InputError>([&] { read_curve(folder / "c.csv"); }), HasSubstr("c.csv, line 1:"));
}

TEST(CurveCsv, names_file_and_line_of_what_is_not_a_row) {
  const TemporaryFolder folder;
  const std::string header = curve_header() + "\n";
  const std::string good = "1,0.05,1e-06,0.5,0,-2,1e-09,2e-09,3e-09,0.25,1e-12,7,0,0,0,0,0,0,0\n";
  for (const std::string bad : {"1,2\n", "x,0.05,1e-06,0.5,0,-2,1e-09,2e-09,3e-09,0.25,1e-12,7,0,0,0,0,0,0,0\n",
                                "1,0.05,1e-06,0.5,0,-2 N,1e-09,2e-09,3e-09,0.25,1e-12,7,0,0,0,0,0,0,0\n",
                                "1,0.05,1e-06,0.5,0,-2,1e-09,2e-09,3e-09,0.25,1e-12,7,0,0,0,0,0,0,0,8\n",
                                "1,0.05,1e-06,0.5,0,-2,1e-09,2e-09,3e-09,0.25,1e-12,7.5,0,0,0,0,0,0,0\n", "\n"}) {
    put(folder / "bad.csv", header + good + bad + good);
    EXPECT_THAT(message_of<InputError>([&] { read_curve(folder / "bad.csv"); }), HasSubstr("bad.csv, line 3:")) << bad;
  }
  put(folder / "other.csv", "separation_m,traction_Pa\n");
  EXPECT_THAT(message_of<InputError>([&] { read_curve(folder / "other.csv"); }), HasSubstr("other.csv, line 1:"));
  EXPECT_THAT(message_of<InputError>([&] { read_curve(folder / "none.csv"); }), HasSubstr("none.csv"));
}

TEST(CurveCsv, a_row_is_seen_from_one_patch_and_direction) {
  StepReport report;
  report.step = 3;
  report.load = 0.3;
  report.reaction = {Vector(1, 2, 3), Vector(4, 5, 6)};
  report.patch_displacement = {Vector(10, 20, 30), Vector(40, 50, 60)};
  report.energy = {1, 2, 3, 8, 10};
  report.max_damage = 0.5;
  report.damaged_volume = 7;
  report.staggered_iterations = 9;
  EXPECT_EQ(curve_row(report, 1, 2), (CurveRow{3, 0.3, 60, Vector(4, 5, 6), {1, 2, 3, 8, 10}, 0.5, 7, 9}));
}

}  // namespace
}  // namespace pfdm::test::this_file
