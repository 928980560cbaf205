#pragma once
// One fit of a curve, from its first run to its files: what curve_fit.cpp does, and what curve_fit_doubts.cpp holds
// against it.

#include "cases/program/studies/fit/curve_fit.h"
#include "cases/program/studies/fit/law_trial.h"
#include "postproc/curves/curve_jumps.h"
#include "postproc/curves/curve_misfit.h"
#include "postproc/displacements/field_residuals.h"
#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_judgement.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pfdm {

/// Whether the displacements of events are known alike: an eighth of a standard error is not worth more runs.
bool is_as_exact(const MeasuredEvent& a, const MeasuredEvent& b);

/// What a fit with `used` is to say where its estimates have the event in a longer or shorter load step, as
/// `at_estimates` has it; nothing where they are as exact.
std::optional<std::string> warning_of_steps(const MeasuredEvent& used, const MeasuredEvent& at_estimates,
                                            const std::string& specimen);

class CurveFit {
 public:
  CurveFit(const CurveFitJob& job, Session& session);
  void run();

 private:
  /// A stage whose parameters are estimated, and all that its fit was made of.
  struct DoneStage {
    const CurveFitStage& stage;
    const MeasuredPoints& points;
    const FitProblem& problem;
    const FitSettings& settings;
    const FitResult& result;
    std::optional<double> until;  ///< end of its runs [m]
  };

  static std::vector<CaseParameter> parameters_of(const CurveFitSettings& settings);
  /// Where the stage cannot go on without an answer.
  SampledCurve curve_at(const std::vector<double>& values, std::optional<double> until);
  /// All values, with those of the stage's parameters in their places.
  std::vector<double> with_stage(const CurveFitStage& stage, std::span<const double> of_stage) const;
  /// What the set-up adds to each specimen's curve with these values.
  std::vector<SetUp> set_ups_at(const std::vector<double>& values) const;
  /// The least that the set-up may add, within the bounds.
  std::vector<SetUp> least_set_ups() const;
  /// A computed curve as each specimen's record would show it. Where there are events it ends at `until`, the end of
  /// the runs that a stage needs: what a longer run has of them depends on which runs were made before.
  ModelCurves as_recorded_by_all(const SampledCurve& computed, const std::vector<double>& values,
                                 std::optional<double> until) const;
  /// How far a stage's runs have to go: a smaller offset or compliance on trial needs more of the computed curve.
  std::optional<double> end_of_runs(const CurveFitStage& stage) const;
  /// The same ones with all values of the set-up: the computed curve reaches them with each.
  MeasuredPoints points_of(const CurveFitStage& stage, const SampledCurve& curve);
  void say(const CurveFitStage& stage, const MeasuredPoints& points);
  /// All events. The standard deviations of the displacements of those of the stage have what the load steps leave open
  /// with these values: that of the computed event, or where it is not there the one about the measured place.
  std::vector<MeasuredEvent> widened_events(const CurveFitStage& stage, const std::vector<double>& values,
                                            std::optional<double> until);
  /// The events of the stage, in place of the points beside them; in curve_fit_events.cpp. `latest`: the last
  /// displacement of each specimen that computed curves reach.
  void add_events(const CurveFitStage& stage, const std::vector<double>& latest, MeasuredPoints& points);
  /// `model`: the case, or one with another law.
  using Compared = std::optional<std::vector<double>> (*)(const ModelCurves&, const MeasuredPoints&);
  static std::optional<std::vector<double>> residuals_by_points(const ModelCurves& models,
                                                                const MeasuredPoints& measured);
  /// Those of points, of events and of fields, with these values of all parameters.
  std::optional<std::vector<double>> residuals_at(const std::vector<double>& values, std::optional<double> until,
                                                  const MeasuredPoints& points, CurveModel& model, Compared compared);
  FitProblem problem_of(const CurveFitStage& stage, const MeasuredPoints& points, std::optional<double> until,
                        CurveModel& model);
  FitSettings settings_of(const CurveFitStage& stage, const MeasuredPoints& points);
  FitStage fit_stage(const CurveFitStage& stage);
  /// Refuses forces of the other sign than those of the first guess, and warns of those in another unit.
  void check_forces(const MeasuredPoints& points, const SampledCurve& first_curve);
  /// A fit, and the problem by which it can be doubted: the case itself, or with [fit] `coarse` what the coarse one is
  /// mapped to.
  struct FittedPoints {
    FitResult result;
    FitProblem problem;
  };
  /// `problem`: of the case itself.
  FittedPoints fit_points(const CurveFitStage& stage, const MeasuredPoints& points, std::optional<double> until,
                          const FitSettings& settings, const FitProblem& problem);
  /// Moves the curves of the coarse case so that with these values they jump where the case itself does.
  void align(const std::vector<double>& values, std::optional<double> until);
  /// Of one model, with a sample of starts where the first guess leads nowhere.
  FitResult fit_model(const FitProblem& problem, const MeasuredPoints& points, const FitSettings& settings);
  /// Fits again, with each specimen weighted by its own scatter, where those differ.
  void weigh_specimens(const CurveFitStage& stage, std::optional<double> until, const FitSettings& settings,
                       MeasuredPoints& points, FittedPoints& fitted);
  /// Fits again where the load steps about an event are others than those with which it began.
  void widen_by_estimates(const CurveFitStage& stage, std::optional<double> until, const FitSettings& settings,
                          MeasuredPoints& points, FittedPoints& fitted);
  /// Fits again from the best of a sample, where the first guess has led nowhere. Returns whether that was better.
  bool screen(const FitProblem& problem, const FitSettings& settings, double misfit, FitResult& result);
  bool judge_stage(const DoneStage& done, FitFindings& found);
  // Fields, in curve_fit_fields.cpp.

  /// A field in a stage.
  struct StageField {
    std::vector<std::size_t> frames;
    std::vector<RigidMotion> motions;  ///< of these
    double deviation = 0.0;            ///< of a component of one point, that residuals are over [m]
    FieldScatter scatter{};            ///< about the estimates
  };
  /// Computed less measured displacements of the frames of the stage, [field][frame]: (places, components) [m].
  using FieldDifferences = std::vector<std::vector<Eigen::MatrixXd>>;
  /// The frames of a stage: between its displacements, within the run, and not within three standard deviations of
  /// a jump that is an event.
  void select_frames(const CurveFitStage& stage, std::optional<double> until, const MeasuredPoints& points);
  /// The first standard deviation of field k, before residuals tell. `latest`: end of the run [m]. Throws InputError
  /// where it is not stated and the data of the stage are too few to tell it.
  void set_first_noise(const CurveFitStage& stage, std::size_t k, double latest);
  std::size_t n_field_data() const;
  std::size_t n_field_data(std::size_t k) const;  ///< of one field, in the stage
  /// Those of a field without the rigid motion of each frame.
  std::vector<Eigen::MatrixXd> without_motion(std::size_t field, const FieldDifferences& differences) const;
  std::optional<FieldDifferences> field_differences(const std::vector<double>& values, std::optional<double> until,
                                                    const std::vector<MeasuredEvent>& events, CurveModel& model);
  /// Behind those of points and events: without rigid motions, over their standard deviations.
  std::optional<std::vector<double>> field_residuals(const std::vector<double>& values, std::optional<double> until,
                                                     const std::vector<MeasuredEvent>& events, CurveModel& model);
  /// What residuals about these estimates say of the noise of each field; returns whether there are any.
  bool find_scatter(const CurveFitStage& stage, std::optional<double> until, const MeasuredPoints& points,
                    const FitResult& result);
  /// Returns whether residuals are over another noise now.
  bool take_noise();
  /// Fits again where the noise of a field is another one than it was taken for.
  void weigh_fields(const CurveFitStage& stage, std::optional<double> until, const FitSettings& settings,
                    MeasuredPoints& points, FittedPoints& fitted);
  /// Whether the case that [fit] `finer` makes, with the estimates that it would have, leaves nothing long-ranged of a
  /// field.
  bool finer_explains(const DoneStage& done, const FitFindings& found, std::size_t field);
  void doubt_fields(const DoneStage& done, FitFindings& found);
  /// A reason where field k scatters more than its stated noise.
  void doubt_noise(std::size_t k, FitFindings& found) const;
  /// A reason where the scale of the displacements of field k is surely another one, and whether it is.
  /// `rows`: its residuals among all, first and end.
  bool doubt_scale(const DoneStage& done, std::size_t k, const std::vector<Eigen::MatrixXd>& differences,
                   std::pair<std::ptrdiff_t, std::ptrdiff_t> rows, FitFindings& found) const;
  /// A reason where the residuals of field k are correlated as far as no noise is, a warning where they are so less
  /// far.
  void doubt_correlation(const DoneStage& done, std::size_t k, FitFindings& found);
  /// Of the last stage, with a table each.
  std::vector<FittedField> fitted_fields();
  std::vector<CurveFitStage>::const_iterator last_stage_of(std::size_t parameter) const;
  const CurveFitStage& last_stage_of(const MeasuredEvent& event) const;
  /// Whether an earlier stage that is not sound estimated what neither this one nor a later one does: then the whole
  /// fit has no intervals, and runs for them are saved.
  bool rests_on_doubts(const CurveFitStage& stage) const;

  // Doubts, in curve_fit_doubts.cpp.

  void doubt(const DoneStage& done, bool model_error, FitFindings& found);
  /// One more reason where other parameters make up for a compliance of the set-up.
  void try_compliance(const DoneStage& done, std::size_t k, FitFindings& found) const;
  /// One more reason where another law, or an imperfect set-up, would explain most of what the model leaves. A straight
  /// part that misses the origin is explanation enough: then no other law is tried.
  static std::vector<double> residuals_of_curve(const DoneStage& done);  ///< and of its events
  bool suspect_law_or_set_up(const DoneStage& done, const SampledCurve& fitted, bool misses_origin, FitFindings& found);
  std::optional<TriedLaw> other_law(const DoneStage& done);
  /// Whether the offset of force that would explain the residuals best contradicts curves that begin unloaded.
  bool preloads(const DoneStage& done, const std::vector<std::vector<double>>& errors) const;
  /// A reason where an estimated offset of force contradicts a curve that begins unloaded.
  void suspect_preload(FitFindings& found) const;
  /// Reasons: straight parts beside the computed one, also where the residuals are too few to show it.
  std::vector<std::string> missed_origins(const DoneStage& done, const SampledCurve& fitted) const;
  /// Reasons where the fitted curve lacks an event, or has it elsewhere; in curve_fit_events.cpp.
  void doubt_events(const DoneStage& done, const SampledCurve& fitted, FitFindings& found);
  /// A warning where the load steps about an event of the stage are others with the estimates than those that its
  /// standard deviation has: the fit was made anew for them, and they have changed again.
  void warn_of_steps(const DoneStage& done, FitFindings& found);
  /// A reason where an event moves by hardly a load step over the differences that the derivatives are of. `row`: of
  /// the residual of its displacement.
  void doubt_derivatives(const DoneStage& done, const MeasuredEvent& event, const ComputedEvent& computed,
                         Eigen::Index row, FitFindings& found) const;
  /// Whether the case that [fit] `finer` makes has the event where it was measured.
  bool finer_meets(const DoneStage& done, const MeasuredEvent& event, const MeasuredFigure& figure);
  /// What the fitted curve has of all events, each as the last stage that has it.
  std::vector<FittedEvent> fitted_events(const SampledCurve& fitted) const;
  /// The residuals of the stage that ends the fit, of the case that [fit] `finer` makes.
  std::optional<FinerModel> on_finer_model(const DoneStage& done);
  /// Intervals by profile likelihood of the parameters that no later stage estimates anew.
  void add_profiles(const DoneStage& done, FitFindings& found) const;
  /// A table of how much each parameter of the last stage moves the computed curve at the points of the first specimen;
  /// the name of its file, empty without such points. In curve_fit_sensitivity.cpp.
  std::string add_sensitivity(const DoneStage& done, const FitFindings& found);
  /// Those that [fit] `intervals` names beside the linear ones, of a fit that may have them.
  void add_other_intervals(const DoneStage& done, FitFindings& found);
  /// Of the parameters of the last stage, with its tables; in curve_fit_posterior.cpp. Throws NoConvergence.
  void add_posterior(const DoneStage& done, FitFindings& found);
  /// Tables of how the law of each interface varies over these samples of a stage's parameters; the names of their
  /// files.
  std::vector<std::string> add_law_bands(const CurveFitStage& stage, const std::vector<std::vector<double>>& samples,
                                         std::vector<std::string>& warnings);
  /// The residuals of each specimen, over its displacement.
  std::vector<ResidualSeries> series_of(const MeasuredPoints& points, const std::vector<double>& residuals) const;

  const CurveFitJob& job_;
  Session& session_;
  CaseRuns runs_;
  std::vector<CaseParameter> parameters_;
  CurveModel model_;
  std::optional<CaseVariant> finer_, coarse_;
  CaseRuns coarse_runs_;
  std::optional<CurveModel> coarse_model_;
  JumpAlignment alignment_;                 // of its curves
  std::vector<double> first_;               // of all parameters, the case's own [SI]
  std::vector<double> values_;              // of all parameters, as known so far [SI]
  std::vector<MeasuredEvent> events_;       // with what load steps leave open
  std::vector<StageField> fields_;          // in the present stage, or the last one
  std::vector<bool> is_of_set_up_;          // parameters of the measured curves: no run depends on them
  std::vector<bool> is_estimated_;          // by an earlier stage
  std::vector<bool> is_doubtful_;           // estimated last by a stage that is not sound
  std::map<std::string, CsvTable> tables_;  // that go with fit.json, by the names of their files
};

}  // namespace pfdm
