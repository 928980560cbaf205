#include "physics/error.h"
#include "postproc/fields/pvd.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfdm::test::this_file {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Frame first{0.0, "fields/frame_0000.vtu"};
const Frame second{1.0 / 3.0, "fields/frame_0001.vtu"};
const Frame third{2.0 / 3.0, "fields/frame_0002.vtu"};

void fill(const std::filesystem::path& path) {
  PvdSeries series(path);
  for (const Frame& frame : {first, second, third}) series.add(frame.time, frame.file);
}

TEST(Pvd, frames_come_back_with_every_digit) {
  const TemporaryFolder folder;
  fill(folder / "fields.pvd");
  EXPECT_THAT(read_pvd(folder / "fields.pvd"), ElementsAre(first, second, third));
  EXPECT_EQ(folder.n_entries(), 1u);
}

TEST(Pvd, is_what_paraview_reads) {
  const TemporaryFolder folder;
  PvdSeries(folder / "fields.pvd").add(0.5, "fields/a.vtu");
  EXPECT_EQ(content_of(folder / "fields.pvd"),
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
            "<Collection>\n"
            "<DataSet timestep=\"0.5\" part=\"0\" file=\"fields/a.vtu\"/>\n"
            "</Collection>\n</VTKFile>\n");
}

TEST(Pvd, a_new_series_forgets_an_old_run) {
  const TemporaryFolder folder;
  fill(folder / "fields.pvd");
  const PvdSeries series(folder / "fields.pvd");
  EXPECT_THAT(read_pvd(folder / "fields.pvd"), IsEmpty());
}

TEST(Pvd, a_restart_keeps_the_frames_up_to_its_own) {
  const TemporaryFolder folder;
  fill(folder / "fields.pvd");
  PvdSeries series(folder / "fields.pvd", [](const Frame& frame) { return frame.time <= second.time; });
  EXPECT_THAT(read_pvd(folder / "fields.pvd"), ElementsAre(first, second));
  series.add(0.9, "fields/b.vtu");
  EXPECT_THAT(series.frames(), ElementsAre(first, second, Frame{0.9, "fields/b.vtu"}));
  EXPECT_EQ(read_pvd(folder / "fields.pvd"), series.frames());
}

TEST(Pvd, a_restart_without_a_file_starts_from_none) {
  const TemporaryFolder folder;
  const PvdSeries series(folder / "fields.pvd", [](const Frame&) { return true; });
  EXPECT_THAT(read_pvd(folder / "fields.pvd"), IsEmpty());
}

TEST(Pvd, names_the_file_that_is_not_a_list_of_frames) {
  const TemporaryFolder folder;
  fill(folder / "fields.pvd");
  const std::string whole = content_of(folder / "fields.pvd");
  put(folder / "torn.pvd", whole.substr(0, whole.size() - 20));
  EXPECT_THAT(message_of<InputError>([&] { read_pvd(folder / "torn.pvd"); }), HasSubstr("torn.pvd"));
  std::string wrong = whole;
  wrong.replace(wrong.find("timestep=\"0\""), 12, "timestep=\"x\"");
  put(folder / "wrong.pvd", wrong);
  EXPECT_THAT(message_of<InputError>([&] { read_pvd(folder / "wrong.pvd"); }), HasSubstr("timestep=\"x\""));
  EXPECT_THAT(message_of<InputError>([&] { read_pvd(folder / "none.pvd"); }), HasSubstr("No such file"));
}

/// The file after its first `n` bytes have been written of those that add a frame: what lies beyond the foot, then over
/// it.
std::string begun(const std::string& before, const std::string& after, std::size_t n) {
  constexpr std::size_t foot = std::string_view("</Collection>\n</VTKFile>\n").size();
  const std::size_t beyond = after.size() - before.size();
  if (n <= beyond) return before + after.substr(before.size(), n);
  std::string content = before + after.substr(before.size());
  return content.replace(before.size() - foot, n - beyond, after.substr(before.size() - foot, n - beyond));
}

TEST(Pvd, a_frame_that_a_killed_run_has_begun_to_add_is_left_out) {
  const TemporaryFolder folder;
  PvdSeries series(folder / "fields.pvd");
  series.add(first.time, first.file);
  const std::string before = content_of(folder / "fields.pvd");
  series.add(second.time, second.file);
  const std::string after = content_of(folder / "fields.pvd");
  for (std::size_t n = 0; begun(before, after, n) != after; ++n) {
    put(folder / "begun.pvd", begun(before, after, n));
    ASSERT_THAT(read_pvd(folder / "begun.pvd"), ElementsAre(first)) << n;
  }
  PvdSeries(folder / "begun.pvd", [](const Frame&) { return true; }).add(second.time, second.file);
  EXPECT_EQ(content_of(folder / "begun.pvd"), after);
}

}  // namespace
}  // namespace pfdm::test::this_file
