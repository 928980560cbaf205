#include "cases/program/studies/study_keys.h"

#include "cases/program/input/config/key_member.h"
#include "cases/program/studies/fit/curve_fit_case.h"
#include "cases/program/studies/runs/slurm.h"

namespace pfdm {
namespace {

constexpr Range starts_range{1.0, 1000.0, false, "between 1 and 1000"};
constexpr Range screened_range{0.0, 10000.0, false, "between 0 and 10000"};
constexpr Range spread_range{0.0, 10.0, true, "above 0 and below 10"};
constexpr Range iterations_range{1.0, 1000.0, false, "between 1 and 1000"};
constexpr Range step_range{0.0, 0.5, true, "above 0 and below 0.5"};
constexpr Range count_range{2.0, 1e6, false, "between 2 and 1000000"};
constexpr Range samples_range{1.0, 1e6, false, "between 1 and 1000000"};
constexpr Range cpus_range{1.0, 4096.0, false, "between 1 and 4096"};
constexpr Range tasks_range{1.0, 1e6, false, "between 1 and 1000000"};

/// A value of the case: a quantity of any dimension, or a number.
KeyType value_type() { return keys::either({keys::text("quantity"), keys::number()}); }
KeyType any_value_type() { return keys::either({keys::text("quantity or word"), keys::number(), keys::flag()}); }
/// A key of the case, or several that keep their ratios.
KeyType key_type() {
  return keys::either({keys::text("key of the case"), keys::list(keys::text("key of the case"), 1)});
}

const KeyTable& prior_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit.parameters[].prior",
      .sentence = "What is known of a parameter beforehand, normally distributed.",
      .keys = {{"mean", value_type(), "", "Mean of what is known of the parameter beforehand."},
               {"deviation", value_type(), "", "Standard deviation of what is known beforehand."}}};
  return table;
}

const KeyTable& fit_parameter_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit.parameters[]",
      .sentence = "A parameter that is estimated.",
      .keys = {
          {"key", key_type(), "", "Key of the case whose value is estimated, or several that keep their ratios."},
          {"bounds", list(value_type(), 2, 2), "", "Lower and upper bound of the estimate, in units."},
          {"prior", keys::table(prior_keys), "no prior", "Mean and standard deviation that are known beforehand."}}};
  return table;
}

std::vector<Key> start_keys() {
  using namespace keys;
  return {stored<&CurveFitStage::starts>(
              "starts", whole(starts_range),
              "Number of descents: the first from the first guess, others from random points.", "1"),
          stored<&CurveFitStage::screened>("screened", whole(screened_range),
                                           "Number of sample points that are run once to choose where descents start.",
                                           "0: none")};
}

const KeyTable& stage_keys() {
  using namespace keys;
  static const KeyTable table{.name = "fit.stages[]",
                              .sentence = "A stage of a fit: some of its parameters over a part of the curve.",
                              .keys = joined({{{"name", text("name"), "", "Name of the stage."},
                                               {"parameters", list(text("key of the case"), 1), "all",
                                                "Keys of the parameters that the stage estimates."},
                                               {"between", list(quantity(dimension::length), 2, 2), "the whole curve",
                                                "Displacements between which the data count in this stage."}},
                                              start_keys()})};
  return table;
}

const KeyTable& sweep_parameter_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "sweep.parameters[]",
      .sentence = "A parameter that the sweep changes.",
      .keys = {{"key", key_type(), "", "Key of the case whose value is changed, or several that keep their ratios."},
               {"values", list(any_value_type(), 1), "or between", "Values of the parameter, in units; or words."},
               {"between", list(value_type(), 2, 2), "or values", "Two values between which the parameter is spread."},
               {"count", whole(count_range), "with between of a grid or list", "Number of values between the two."},
               {"spacing", choice("spacing", {"linear", "logarithmic"}), "\"linear\"",
                "Spacing of the values between the two."}}};
  return table;
}

const KeyTable& slurm_keys() {
  using namespace keys;
  using S = SlurmSettings;
  static const KeyTable table{
      .name = "sweep.slurm",
      .sentence = "Resources of a task on a cluster with Slurm.",
      .keys = {
          {"partition", text("partition"), "the cluster's",
           "Slurm's partition, or a list of them, as in \"short,long\"."},
          stored<&S::time>("time", quantity(dimension::time, range::positive), "Time limit of a task on the cluster.",
                           "the cluster's"),
          stored<&S::cpus_per_task>("cpus_per_task", whole(cpus_range), "Number of processors and threads of a run."),
          {"memory", text("amount of memory"), "the cluster's", "Memory of a task, as in \"4 GB\"."},
          stored<&S::at_once>("at_once", whole(tasks_range), "Number of tasks that may run at a time.", "no limit"),
          stored<&S::largest_array>("largest_array", whole(tasks_range),
                                    "Largest number of tasks of one submission (Slurm's MaxArraySize, less 1)."),
          {"lines", list(text("line")), "none", "Lines of the job's script, as \"#SBATCH --account=glass\"."}}};
  return table;
}

}  // namespace

Key fit_parameters_key() {
  return {"parameters", keys::tables(fit_parameter_keys), "", "Parameters that are estimated, each with its bounds."};
}

Key finer_key(std::string_view otherwise) {
  return {"finer", keys::names(value_type()), std::string(otherwise),
          "Other values of keys, as a finer mesh, for one more run that tells how estimates move."};
}

const KeyTable& curve_fit_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit",
      .sentence = "Parameters that are estimated from the measured curves (inverse analysis, calibration).",
      .keys = joined(
          {{fit_parameters_key(),
            {"stages", tables(stage_keys), "one: all parameters, the whole curve",
             "Stages of the fit, one after the other."},
            stored<&FitSettings::step>("step", number(step_range),
                                       "Step of the finite differences, of the logarithm of a value.", "0.02"),
            {"differences", choice("kind of differences", {"central", "forward", "shared"}), "\"central\"",
             "Kind of finite differences: central, forward with half the runs, or shared on a grid."},
            stored<&FitSettings::least_step>("tolerance", number(step_range),
                                             "Step of the logarithms below which the fit has converged.", "1e-4"),
            stored<&FitSettings::maximum_iterations>("maximum_iterations", whole(iterations_range),
                                                     "Largest number of iterations of a stage.", "30")},
           start_keys(),
           {stored<&FitSettings::spread>(
                "spread", number(spread_range),
                "Random points lie within the factors exp(-spread) and exp(spread) of the first guess.", "1"),
            {"intervals", choice("kind of intervals", {"linear", "profile", "posterior", "discrepancy"}), "\"linear\"",
             "Intervals from derivatives; by profile likelihood, or the posterior of the parameters as well, also with "
             "a smooth discrepancy of the model."},
            finer_key("none: the error of the mesh is not told"),
            {"coarse", names(value_type()), "none: the case itself is run at every step",
             "Other values of keys, as a coarser mesh, with which the fit is made; the case itself is run at its "
             "minima."}}})};
  return table;
}

const KeyTable& sweep_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "sweep",
      .sentence = "Sets of values with which pfdm sweep runs the case.",
      .keys = {{"method", choice("method of a sweep", {"grid", "list", "latin_hypercube", "changes"}), "",
                "Which sets of values: all combinations, side by side, a random sample, or one change at a time."},
               {"samples", whole(samples_range), "with latin_hypercube", "Number of samples of the Latin hypercube."},
               {"seed", whole(range::seed), "1", "Seed of the Latin hypercube."},
               {"parameters", tables(sweep_parameter_keys), "with the other methods",
                "Parameters that the sweep changes, each with its values."},
               {"changes", names(names(value_type())), "with changes",
                "Changes of the case, by name, as a finer mesh or shorter steps (convergence study)."},
               {"slurm", keys::table(slurm_keys), "none", "Resources of a task of --slurm on a cluster."}}};
  return table;
}

}  // namespace pfdm
