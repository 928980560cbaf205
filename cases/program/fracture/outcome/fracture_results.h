#pragma once
// The results directory of a fracture run: curve, frames, checkpoint, summary. Files are written whole or not at all;
// all functions throw ComputationError where they cannot be written.

#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/fracture/outcome/energy_release_table.h"
#include "cases/program/fracture/outcome/run_frames.h"
#include "cases/program/session/terminal/stopwatch.h"
#include "mesh/mesh.h"
#include "postproc/cohesive/column_record.h"
#include "postproc/cohesive/first_debonding.h"
#include "postproc/curves/curve_csv.h"
#include "postproc/curves/summary.h"
#include "postproc/displacements/place_record.h"
#include "postproc/displacements/place_sampler.h"
#include "postproc/files/new_results.h"
#include "postproc/files/step_table.h"
#include "solver/fracture/model/state.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace pfdm {

/// Writes mesh.vtu: material (the number of the region), volume [m^3] and quality figures. Makes the directory.
void write_mesh(const std::filesystem::path& results, const Mesh& mesh);

class FractureResults {
 public:
  /// Continues after `last`, or starts anew: results of an earlier run are kept until the first step is done and
  /// on the disk. `columns` are recorded, `watch` looks for the first debonding. Keeps references to mesh, model, case,
  /// columns and watch.
  FractureResults(std::filesystem::path directory, const Mesh& mesh, const FractureModel& model,
                  const FractureCase& fracture, const std::vector<ColumnSet>& columns, const DebondingWatch& watch,
                  std::string case_hash, const std::optional<FractureState>& last);

  /// Where the files are now, in the directory or, as long as earlier results are there, within it.
  const std::filesystem::path& folder() const { return place_.folder(); }
  bool wait() const { return place_.wait(); }
  bool records_columns() const { return files_->columns.has_value(); }

  using Output = std::function<OutputFields()>;
  /// Appends the row, then writes the frame, if one is due, what the columns tell and the energy release rates, then
  /// the checkpoint: killed in between, a restart takes what is beyond the checkpoint away and does it again. Returns
  /// what the user should be warned of.
  std::vector<std::string> step_done(const FractureState& state, const StepReport& report, const Output& output);
  /// The curve and the checkpoint of the last state, if step_done() has left them to later; earlier results go away.
  void write_what_waits(const FractureState& state);
  /// A frame of the last state, if it has none yet.
  void write_last_frame(const Output& output);
  /// All frames in one file in place of their own, if the case asks for it. The last that is done with frames.
  void put_frames_into_one_file() const { frames_.put_into_one_file(); }
  /// Fills in what the curve and the last damage tell; returns the whole.
  RunSummary write_summary(RunSummary summary) const;

  const std::vector<CurveRow>& rows() const { return files_->curve.rows(); }
  const CurveRow& last_row() const { return rows().back(); }
  const std::optional<FirstDebonding>& first_debonding() const { return debonding_; }

 private:
  /// The files that grow with the steps.
  struct Files {
    Files(const std::filesystem::path& folder, const FractureCase& fracture, const std::vector<ColumnSet>& sets,
          std::optional<Index> last_step);
    CurveFile curve;
    std::optional<ColumnFiles> columns;
    std::optional<EnergyReleaseTable> energy_release;
    std::optional<StepTable> means;
    std::optional<StepTable> heat;
    std::optional<StepTable> fatigue;
    std::optional<PlaceRecord> places;
  };

  bool may_wait() const;
  void write_state(const FractureState& state);
  void take_place(const FractureState& state);
  void record_places(Index step, const Output& output, bool now);
  void note_debonding(const FractureState& state, const StepReport& report, const Output& output);
  CurveRow row_of(const StepReport& report) const;
  std::map<std::string, double> figures_of_debonding() const;
  std::map<std::string, double> damaged_areas() const;

  std::filesystem::path directory_;
  const Mesh& mesh_;
  const FractureCase& fracture_;
  const FractureModel& model_;
  const std::vector<ColumnSet>& sets_;
  const DebondingWatch& watch_;
  std::optional<FirstDebonding> debonding_;
  std::string case_hash_;
  std::optional<Index> curve_patch_;  // none of a box
  NewResults place_;
  std::optional<Files> files_;
  RunFrames frames_;
  std::vector<bool> said_of_tip_;  // region by region
  std::optional<PlaceSampler> sampler_;
  Index last_step_ = 0;
  double last_load_ = 0.0;
  CellField<double> damage_;
  Stopwatch since_written_;
  bool has_stepped_ = false;
  bool waits_ = false;  // curve and checkpoint, for a later step
};

}  // namespace pfdm
