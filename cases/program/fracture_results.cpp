#include "cases/program/fracture_results.h"

#include "cases/program/report_parts.h"
#include "mesh/quality.h"
#include "postproc/atomic_file.h"
#include "postproc/checkpoint.h"
#include "postproc/cohesive_results.h"
#include "postproc/comparison_results.h"
#include "postproc/frame.h"
#include "postproc/point_displacement.h"
#include "postproc/slice.h"
#include "postproc/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr const char* checkpoint_file = "checkpoint.bin";
constexpr const char* frames_file = "fields.pvd";
constexpr const char* frames_folder = "fields";
constexpr const char* columns_folder = "columns";
constexpr const char* energy_release_file = "energy_release_rate.csv";

constexpr double bearable_damaged_share = 0.05;  // of the integrand of an energy release rate

constexpr double seconds_at_stake = 2.0;  // that a killed run may lose, of those that leave figures only

/// Of a step, relative to the results; in the order of the steps, so are the names.
std::string frame_file(Index step) { return fmt::format("{}/step_{:06}.vtu", frames_folder, step); }

/// Otherwise a run that dies early would leave an older run's files beside its own.
void remove_earlier_run(const fs::path& directory) {
  std::error_code ignored;  // what cannot be removed will not be writable either, and that is said then
  for (const char* file : {checkpoint_file, curve_file, frames_file, summary_file, energy_release_file})
    fs::remove(directory / file, ignored);
  for (const char* file : cohesive_files) fs::remove(directory / file, ignored);
  for (const char* file : comparison_files) fs::remove(directory / file, ignored);
  remove_columns(directory / columns_folder);
  remove_report(directory);
  for (const auto& entry : fs::directory_iterator(directory / frames_folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("step_") && name.ends_with(".vtu")) fs::remove(entry.path(), ignored);
  }
}

fs::path prepared(const fs::path& directory, bool goes_on) {
  make_folder(directory / frames_folder);
  std::error_code ignored;
  if (goes_on)
    fs::remove(directory / summary_file, ignored);
  else
    remove_earlier_run(directory);
  return directory;
}

Index patch_number(const Mesh& mesh, const std::string& name) {
  return static_cast<Index>(&mesh.patch(name) - mesh.patches.data());
}

void require_results(const fs::path& results, const std::string& case_hash) {
  const fs::path checkpoint = results / checkpoint_file;
  if (!fs::exists(checkpoint) || !fs::exists(results / curve_file))
    throw InputError(fmt::format("{}: there are no results; pfdm run makes them", results.string()));
  read_checkpoint(checkpoint, case_hash);  // refuses another case's
}

std::vector<std::string> energy_release_columns(const std::vector<TipRegion>& regions) {
  std::vector<std::string> names{"step", "load"};
  for (const TipRegion& region : regions)
    for (const char* what : {"tip_x_m", "tip_y_m", "tip_z_m", "G_J_per_m2", "damaged_share"})
      names.push_back(fmt::format("{}_{}", region.name, what));
  return names;
}

std::optional<std::string> doubt_about(const EnergyRelease& release, const std::string& region) {
  if (std::isnan(release.G))
    return fmt::format(
        "energy release rate \"{}\": around ({:.4g}, {:.4g}, {:.4g}) m the ring reaches beyond the body; no value",
        region, release.tip.x(), release.tip.y(), release.tip.z());
  if (release.damaged_share > bearable_damaged_share)
    return fmt::format(
        "energy release rate \"{}\": {:.0f} % of it comes from damaged cells (d > 0.1); it is that of the far field "
        "only where the ring between inner and outer lies in sound material",
        region, 100.0 * release.damaged_share);
  return std::nullopt;
}

bool same_load(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

}  // namespace

void write_mesh(const fs::path& results, const Mesh& mesh) {
  make_folder(results);
  const CellQuality quality = cell_quality(mesh);
  VtuWriter(mesh).write(results / "mesh.vtu",
                        {{"material", &mesh.region},
                         {"volume", &mesh.cell_volume},
                         {"non_orthogonality", &quality.non_orthogonality},
                         {"skewness", &quality.skewness},
                         {"volume_ratio", &quality.volume_ratio},
                         {"aspect_ratio", &quality.aspect_ratio},
                         {"min_dihedral_angle", &quality.min_dihedral_angle}},
                        0.0);
}

std::optional<FractureState> find_checkpoint(const fs::path& results, const std::string& case_hash) {
  const fs::path file = results / checkpoint_file;
  if (!fs::exists(file)) return std::nullopt;
  return read_checkpoint(file, case_hash);
}

bool is_complete(const fs::path& results) { return fs::exists(results / summary_file); }

std::vector<CurveRow> read_curve_record(const fs::path& results, const std::string& case_hash) {
  require_results(results, case_hash);
  return read_curve(results / curve_file);
}

std::vector<ColumnRecord> read_column_record(const fs::path& results, const std::string& case_hash) {
  require_results(results, case_hash);
  std::vector<ColumnRecord> records = read_columns(results / columns_folder);
  if (records.empty())
    throw InputError(
        fmt::format("{}: the run recorded no columns: name the surfaces in [cohesive] of case.toml, and run it again "
                    "(particles with layers are recorded without)",
                    results.string()));
  return records;
}

std::vector<ColumnRecord> find_column_record(const fs::path& results) { return read_columns(results / columns_folder); }

std::optional<RunSummary> find_summary(const fs::path& results) {
  if (!fs::exists(results / summary_file)) return std::nullopt;
  return read_run_summary(results / summary_file);
}

std::vector<StoredStep> stored_steps(const fs::path& results) {
  if (!fs::exists(results / frames_file)) return {};
  std::vector<StoredStep> steps;
  for (const Frame& frame : read_pvd(results / frames_file)) {
    const std::string name = fs::path(frame.file).stem().string();
    const auto step = parse_int(std::string_view(name).substr(std::min(name.find('_') + 1, name.size())));
    if (!step) throw InputError(fmt::format("{}: \"{}\" is no frame of ours", (results / frames_file).string(), name));
    steps.push_back({*step, results / frame.file});
  }
  return steps;
}

FractureResults::FractureResults(fs::path directory, const Mesh& mesh, const FractureModel& model,
                                 const FractureCase& fracture, const std::vector<ColumnSet>& columns,
                                 std::string case_hash, const std::optional<FractureState>& last)
    : directory_(prepared(directory, last.has_value())),
      mesh_(mesh),
      fracture_(fracture),
      model_(model),
      case_hash_(std::move(case_hash)),
      curve_patch_(patch_number(mesh, fracture.output.curve.patch)),
      curve_(last ? CurveFile(directory_ / curve_file, last->step) : CurveFile(directory_ / curve_file)),
      frames_(last ? PvdSeries(directory_ / frames_file,
                               [last](const Frame& frame) { return frame.file <= frame_file(last->step); })
                   : PvdSeries(directory_ / frames_file)),
      writer_(mesh, fracture.output.frames.file),
      damage_(as_size(mesh.n_cells()), 0.0) {
  if (!columns.empty())
    columns_.emplace(directory_ / columns_folder, columns, fracture.cohesive.axis,
                     last ? std::optional(last->step) : std::nullopt);
  if (const auto& tips = fracture.output.tips; !tips.empty())
    energy_release_.emplace(directory_ / energy_release_file, energy_release_columns(tips),
                            last ? std::optional(last->step) : std::nullopt);
  warned_of_tip_.assign(fracture.output.tips.size(), false);
  if (!last) return;
  last_step_ = last->step;
  last_load_ = last->load;
  damage_ = last->damage;
}

std::vector<std::string> FractureResults::step_done(const FractureState& state, const StepReport& report,
                                                    const Output& output) {
  std::vector<std::string> warnings;
  last_step_ = state.step;
  last_load_ = state.load;
  damage_ = state.damage;
  curve_.add(curve_row(report, curve_patch_, fracture_.output.curve.component));
  if (may_wait()) {
    waits_ = true;
    return warnings;
  }
  curve_.write();
  const bool frame = frame_is_due(state);
  if (frame || columns_ || energy_release_) {
    const OutputFields fields = output();
    if (frame) write_frame(state.step, state.load, fields);
    if (columns_) columns_->append(state.step, mesh_, model_, fields);
    if (energy_release_) add_energy_release(state, fields, warnings);
  }
  write_checkpoint(directory_ / checkpoint_file, state, case_hash_);
  since_written_ = {};
  waits_ = false;
  return warnings;
}

void FractureResults::add_energy_release(const FractureState& state, const OutputFields& output,
                                         std::vector<std::string>& warnings) {
  std::vector<double> row{static_cast<double>(state.step), state.load};
  for (std::size_t i = 0; i < fracture_.output.tips.size(); ++i) {
    const TipRegion& region = fracture_.output.tips[i];
    const EnergyRelease release = energy_release_rate(mesh_, output, region);
    row.insert(row.end(), {release.tip.x(), release.tip.y(), release.tip.z(), release.G, release.damaged_share});
    if (warned_of_tip_[i]) continue;
    const std::optional<std::string> doubt = doubt_about(release, region.name);
    if (doubt) warnings.push_back(*doubt);
    warned_of_tip_[i] = doubt.has_value();
  }
  energy_release_->append(std::move(row));
}

/// Many short runs would spend more time on flushing to the disk than on computing.
bool FractureResults::may_wait() const {
  return fracture_.output.figures_only && since_written_.seconds() < seconds_at_stake;
}

void FractureResults::write_what_waits(const FractureState& state) {
  if (!waits_) return;
  curve_.write();
  write_checkpoint(directory_ / checkpoint_file, state, case_hash_);
  waits_ = false;
}

bool FractureResults::frame_is_due(const FractureState& state) const {
  if (fracture_.output.figures_only) return false;
  const auto& stops = fracture_.loading.stops;
  const Index every = fracture_.output.frames_every;
  return std::ranges::any_of(stops, [&](double stop) { return same_load(stop, state.load); }) ||
         same_load(state.load, fracture_.loading.end) || (every > 0 && state.step % every == 0);
}

void FractureResults::write_frame(Index step, double load, const OutputFields& output) {
  double time = fracture_.output.frames.time(step, load);
  // ParaView wants times that rise; those of a restart with another [loading] may be measured in something else.
  if (const auto& before = frames_.frames(); !before.empty() && !(time > before.back().time))
    time = std::max(static_cast<double>(step), std::floor(before.back().time) + 1.0);
  const SplitPoints points = point_displacement(mesh_, model_.boundary, output, load);
  writer_.write(directory_ / frame_file(step), frame_fields(mesh_, output), time, &points);
  frames_.add(time, frame_file(step));
}

void FractureResults::write_last_frame(const Output& output) {
  const auto& frames = frames_.frames();
  if (fracture_.output.figures_only) return;
  if (frames.empty() || frames.back().file != frame_file(last_step_)) write_frame(last_step_, last_load_, output());
}

std::map<std::string, double> FractureResults::damaged_areas() const {
  const auto& through = fracture_.output.slices_through;
  if (!through) return {};
  return {{"damaged_area_yz_m2", damaged_area(mesh_, damage_, *through, Vector::UnitX())},
          {"damaged_area_xz_m2", damaged_area(mesh_, damage_, *through, Vector::UnitY())},
          {"damaged_area_xy_m2", damaged_area(mesh_, damage_, *through, Vector::UnitZ())}};
}

std::map<std::string, double> FractureResults::last_energy_release() const {
  std::map<std::string, double> figures;
  if (!energy_release_ || energy_release_->rows().empty()) return figures;
  const std::vector<std::string>& names = energy_release_->names();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].ends_with("_G_J_per_m2")) figures["final_" + names[i]] = energy_release_->rows().back()[i];
  return figures;
}

void FractureResults::write_summary(RunSummary summary) const {
  summary.case_hash = case_hash_;
  summary.cells = mesh_.n_cells();
  summary.steps = last_step_;
  summary.figures = headlines(curve_.rows(), fracture_.output.curve.component);
  summary.other_figures = damaged_areas();
  summary.other_figures.merge(last_energy_release());
  pfdm::write_summary(directory_ / summary_file, summary);
}

}  // namespace pfdm
