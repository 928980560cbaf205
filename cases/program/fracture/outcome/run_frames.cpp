#include "cases/program/fracture/outcome/run_frames.h"

#include "cases/program/fracture/outcome/fracture_files.h"
#include "postproc/fields/frame.h"
#include "postproc/fields/point_displacement.h"
#include "postproc/fields/vtkhdf.h"
#include "postproc/fields/vtkhdf_frames.h"
#include "postproc/files/atomic_file.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr std::pair<const char*, const char*> lists_and_files[] = {{frames_file, frames_in_one_file},
                                                                   {interfaces_file, interfaces_in_one_file}};

/// Continues a list of frames up to the last step, or starts one.
PvdSeries series_of(const fs::path& file, std::string (*frame_of)(Index step), std::optional<Index> last_step) {
  if (!last_step) return PvdSeries(file);
  return {file, [=](const Frame& frame) { return frame.file <= frame_of(*last_step); }};
}

bool same_load(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

}  // namespace

RunFrames::RunFrames(const Mesh& mesh, const FractureModel& model, const FractureCase& fracture)
    : mesh_(mesh), model_(model), fracture_(fracture), writer_(mesh, fracture.output.frames.file) {}

void RunFrames::open(const fs::path& folder, std::optional<Index> last_frame) {
  folder_ = folder;
  if (last_frame) {
    unpack_from_one_file();
    remove_beyond(*last_frame);
  }
  frames_.emplace(series_of(folder_ / frames_file, frame_file, last_frame));
  if (fracture_.interfaces.empty()) return;
  make_folder(folder_ / interfaces_folder);
  interfaces_.emplace(series_of(folder_ / interfaces_file, interfaces_frame_file, last_frame));
}

void RunFrames::unpack_from_one_file() const {
  for (const auto& [list, one_file] : lists_and_files)
    if (!fs::exists(folder_ / list) && fs::exists(folder_ / one_file))
      unpack_frames(folder_ / one_file, folder_ / list, fracture_.output.frames.file.compression);
}

void RunFrames::remove_beyond(Index last_frame) const {
  std::error_code ignored;
  std::vector<fs::path> beyond;
  for (const std::string& last : {frame_file(last_frame), interfaces_frame_file(last_frame)}) {
    const fs::path file = folder_ / last;
    for (const auto& entry : fs::directory_iterator(file.parent_path(), ignored))
      if (is_frame(entry.path()) && entry.path().filename() > file.filename()) beyond.push_back(entry.path());
  }
  for (const fs::path& file : beyond) fs::remove(file, ignored);
}

bool RunFrames::are_due(const FractureState& state) const {
  if (fracture_.output.figures_only) return false;
  const auto& stops = fracture_.loading.stops;
  const Index every = fracture_.output.frames_every;
  return std::ranges::any_of(stops, [&](double stop) { return same_load(stop, state.load); }) ||
         same_load(state.load, fracture_.loading.end) || (every > 0 && state.step % every == 0);
}

/// ParaView wants times that rise; those of a restart with another [loading] may be measured in something else.
double RunFrames::time_of(Index step, double load) const {
  const double time = fracture_.output.frames.time(step, load);
  const auto& before = frames_->frames();
  if (before.empty() || time > before.back().time) return time;
  return std::max(static_cast<double>(step), std::floor(before.back().time) + 1.0);
}

void RunFrames::write(Index step, double load, const OutputFields& output) {
  const double time = time_of(step, load);
  const SplitPoints points = point_displacement(mesh_, model_.boundary, output, load);
  writer_.write(folder_ / frame_file(step), frame_fields(mesh_, output), time, &points);
  frames_->add(time, frame_file(step));
  if (interfaces_) write_interfaces(step, time, output);
}

void RunFrames::write_interfaces(Index step, double time, const OutputFields& output) {
  const InterfaceFrame frame(output.interfaces);
  VtuWriter(mesh_, frame.faces(), fracture_.output.frames.file)
      .write(folder_ / interfaces_frame_file(step), frame.fields(), time);
  interfaces_->add(time, interfaces_frame_file(step));
}

bool RunFrames::has(Index step) const {
  const auto& frames = frames_->frames();
  return !frames.empty() && frames.back().file == frame_file(step);
}

void RunFrames::put_into_one_file() const {
  if (!fracture_.output.frames.in_one_file || frames_->frames().empty()) return;
  for (const auto& [list, one_file] : lists_and_files) {
    if (!fs::exists(folder_ / list)) continue;
    write_vtkhdf(folder_ / list, folder_ / one_file);
    std::error_code ignored;
    const std::vector<Frame> frames = read_pvd(folder_ / list);
    fs::remove(folder_ / list, ignored);
    for (const Frame& frame : frames) fs::remove(folder_ / frame.file, ignored);
    fs::remove((folder_ / frames.front().file).parent_path(), ignored);  // unless there is something else in it
  }
}

}  // namespace pfdm
