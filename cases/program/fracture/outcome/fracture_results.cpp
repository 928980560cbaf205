#include "cases/program/fracture/outcome/fracture_results.h"

#include "cases/program/fracture/outcome/fracture_files.h"
#include "cases/program/fracture/outcome/heat_results.h"
#include "cases/program/fracture/outcome/mean_curve.h"
#include "cases/program/session/earlier_results.h"
#include "mesh/quality.h"
#include "postproc/fields/checkpoint.h"
#include "postproc/fields/slice.h"
#include "postproc/fields/vtu_writer.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <optional>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr double seconds_at_stake = 2.0;  // that a killed run may lose, of those that leave figures only

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

FractureResults::Files::Files(const fs::path& folder, const FractureCase& fracture, const std::vector<ColumnSet>& sets,
                              std::optional<Index> last_step)
    : curve(last_step ? CurveFile(folder / curve_file, *last_step) : CurveFile(folder / curve_file)) {
  if (!sets.empty()) columns.emplace(folder / columns_folder, sets, fracture.cohesive.axis, last_step);
  if (const auto& tips = fracture.output.tips; !tips.empty()) energy_release.emplace(folder, tips, last_step);
  if (fracture.heat) heat.emplace(folder / heat_file, columns_of_heat(), last_step);
  if (fracture.materials.has_fatigue()) fatigue.emplace(folder / fatigue_file, columns_of_fatigue(), last_step);
  if (!fracture.output.places.empty()) places.emplace(folder, fracture.output.places.size(), last_step);
  if (fracture.box) means.emplace(folder / means_file, columns_of_means(fracture.interfaces), last_step);
}

FractureResults::FractureResults(fs::path directory, const Mesh& mesh, const FractureModel& model,
                                 const FractureCase& fracture, const std::vector<ColumnSet>& columns,
                                 const DebondingWatch& watch, std::string case_hash,
                                 const std::optional<FractureState>& last)
    : directory_(std::move(directory)),
      mesh_(mesh),
      fracture_(fracture),
      model_(model),
      sets_(columns),
      watch_(watch),
      case_hash_(std::move(case_hash)),
      curve_patch_(fracture.box ? std::nullopt : std::optional(mesh.patch_index(fracture.output.curve.patch))),
      place_(directory_, !last && has_results(directory_)),
      frames_(mesh, model, fracture),
      damage_(mesh.n_cells(), 0.0) {
  if (!last && !place_.wait()) remove_earlier_run(directory_);  // what a run left that was killed before its first step
  make_folder(folder() / frames_folder);
  remove_leftovers(folder() / frames_folder);
  if (fs::exists(folder() / interfaces_folder)) remove_leftovers(folder() / interfaces_folder);
  std::optional<Index> last_step, last_frame;
  if (last) {
    last_step = last->step;
    const bool failed = status_of_earlier(directory_) != "complete";  // a frame of its end is not one that is due
    last_frame = failed && !frames_.are_due(*last) ? last->step - 1 : last->step;
  }
  frames_.open(folder(), last_frame);
  files_.emplace(folder(), fracture, columns, last_step);
  said_of_tip_.assign(fracture.output.tips.size(), false);
  if (!last) return;
  last_step_ = last->step;
  last_load_ = last->load;
  damage_ = last->damage;
  debonding_ = take_first_debonding(folder() / first_debonding_file, last->step);
}

std::vector<std::string> FractureResults::step_done(const FractureState& state, const StepReport& report,
                                                    const Output& output) {
  std::vector<std::string> warnings;
  if (!has_stepped_) remove_what_was_made_of_them(folder());
  has_stepped_ = true;
  last_step_ = state.step;
  last_load_ = state.load;
  damage_ = state.damage;
  files_->curve.add(row_of(report));
  note_debonding(state, report, output);
  const bool waits = may_wait();
  if (files_->means) files_->means->append(row_of_means(report), !waits);
  if (files_->heat) files_->heat->append(row_of_heat(report), !waits);
  if (files_->fatigue) files_->fatigue->append(row_of_fatigue(report), !waits);
  if (files_->places) record_places(state.step, output, !waits);
  if (waits) {
    waits_ = true;
    return warnings;
  }
  files_->curve.write();
  const bool frame = frames_.are_due(state);
  if (frame || files_->columns || files_->energy_release) {
    const OutputFields fields = output();
    if (frame) frames_.write(state.step, state.load, fields);
    if (files_->columns) files_->columns->append(state.step, mesh_, model_, fields);
    if (files_->energy_release) warnings = files_->energy_release->add(mesh_, model_, state, fields, said_of_tip_);
  }
  write_state(state);
  if (state.step > 0) take_place(state);
  return warnings;
}

void FractureResults::note_debonding(const FractureState& state, const StepReport& report, const Output& output) {
  if (debonding_) return;
  debonding_ = watch_.look(state.damage, report, output);
  if (debonding_) write_first_debonding(folder() / first_debonding_file, *debonding_);
}

CurveRow FractureResults::row_of(const StepReport& report) const {
  return curve_patch_ ? curve_row(report, *curve_patch_, fracture_.output.curve.component)
                      : curve_row_of_box(report, model_.motion.size, fracture_.box->component);
}

void FractureResults::record_places(Index step, const Output& output, bool now) {
  if (!sampler_) sampler_.emplace(mesh_, fracture_.output.places);
  const OutputFields fields = output();
  files_->places->append(step, (*sampler_)(fields.displacement, fields.gradient), now);
}

void FractureResults::write_state(const FractureState& state) {
  write_checkpoint(folder() / checkpoint_file, state, case_hash_);
  since_written_ = {};
  waits_ = false;
}

/// Continues with the files in their new place as a restart would.
void FractureResults::take_place(const FractureState& state) {
  if (!place_.wait()) return;
  place_.take_place([this] { remove_earlier_run(directory_); }, checkpoint_file);
  frames_.open(folder(), state.step);
  files_.emplace(folder(), fracture_, sets_, state.step);
}

/// Many short runs would spend more time on flushing to the disk than on computing. Columns are written step by step.
bool FractureResults::may_wait() const {
  return fracture_.output.figures_only && !files_->columns && since_written_.seconds() < seconds_at_stake;
}

void FractureResults::write_what_waits(const FractureState& state) {
  if (waits_) {
    files_->curve.write();
    if (files_->means) files_->means->write();
    if (files_->heat) files_->heat->write();
    if (files_->fatigue) files_->fatigue->write();
    if (files_->places) files_->places->write();
    write_state(state);
  }
  take_place(state);
}

void FractureResults::write_last_frame(const Output& output) {
  if (!fracture_.output.figures_only && !frames_.has(last_step_)) frames_.write(last_step_, last_load_, output());
}

std::map<std::string, double> FractureResults::damaged_areas() const {
  const auto& through = fracture_.output.slices_through;
  if (!through) return {};
  return {{"damaged_area_yz_m2", damaged_area(mesh_, damage_, *through, Vector::UnitX())},
          {"damaged_area_xz_m2", damaged_area(mesh_, damage_, *through, Vector::UnitY())},
          {"damaged_area_xy_m2", damaged_area(mesh_, damage_, *through, Vector::UnitZ())}};
}

/// Of a box in place of force and displacement: mean stress and strain, which are those over its side and length.
std::map<std::string, double> FractureResults::figures_of_debonding() const {
  if (!watch_.has_surfaces()) return {};
  std::map<std::string, double> figures =
      debonding_figures(debonding_, files_->curve.rows(), fracture_.output.curve.component);
  if (fracture_.box) name_as_means(figures, model_.motion.size, fracture_.box->component);
  return figures;
}

RunSummary FractureResults::write_summary(RunSummary summary) const {
  summary.case_hash = case_hash_;
  summary.cells = mesh_.n_cells();
  summary.steps = last_step_;
  summary.figures = headlines(files_->curve.rows(), fracture_.output.curve.component);
  summary.other_figures.merge(damaged_areas());
  if (files_->energy_release) summary.other_figures.merge(files_->energy_release->figures());
  if (files_->means) summary.other_figures.merge(figures_of_means(*files_->means, fracture_.box->component));
  summary.other_figures.merge(figures_of_debonding());
  if (files_->heat) summary.other_figures.merge(figures_of_heat(*files_->heat));
  if (debonding_) summary.other_texts["first_debonding_surface"] = debonding_->surface;
  pfdm::write_summary(folder() / summary_file, summary);
  return summary;
}

}  // namespace pfdm
