#pragma once
// A Prony series (physics/materials/prony_response.h) as a forward model of tests on the bulk material: relaxation and
// any other strain over time, creep, and dynamic mechanical analysis (DMA). The histories are those of the data: a ramp
// is no step.

#include "physics/materials/prony_response.h"
#include "solver/calibration/calibration.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

/// The last three are of DMA; the loss factor is the loss over the storage modulus, tan delta.
enum class MeasuredQuantity { stress, strain, storage_modulus, loss_modulus, loss_factor };
/// "stress", "storage modulus" ... and the unit, "Pa" or "1".
std::string_view name_of(MeasuredQuantity quantity);
std::string_view unit_of(MeasuredQuantity quantity);

/// A test on material at rest before.
struct ViscoelasticExperiment {
  struct Channel {
    MeasuredQuantity quantity = MeasuredQuantity::stress;
    std::vector<double> values{};  ///< measured: [Pa], strain, or 1; strains of shear are engineering ones
    double noise = 0.0;            ///< standard deviation, as the values; 0: not known
    double relative_noise = 0.0;   ///< in its place: in parts of the model's value
  };
  std::string name;
  Deformation deformation = Deformation::tension;
  std::vector<double> times{};                ///< rising [s]; empty of DMA
  std::vector<double> angular_frequencies{};  ///< of DMA [rad/s]
  std::vector<double> followed{};             ///< strains, or stresses [Pa], at the times, linear in between
  bool follows_stress = false;
  /// Of the test [K], or of each frequency; empty: the reference of the law's temperature shift, if it has one.
  std::vector<double> temperatures{};
  double ramp = 0.0;  ///< time before the first row, within which the first value was reached linearly [s]; 0: at once
  std::vector<Channel> channels{};

  bool is_frequency_sweep() const { return !angular_frequencies.empty(); }
};
using ViscoelasticExperiments = std::vector<ViscoelasticExperiment>;

/// Relaxation times that tests can show [s]: from the shortest step of time in which the load changes, or after it (the
/// inverse of the highest angular frequency), to the longest time under load (the inverse of the lowest).
struct TimeWindow {
  double shortest = 0.0, longest = 0.0;
};
TimeWindow time_window(const ViscoelasticExperiments& experiments);
/// The experiments as they would be at the reference of the shift (time-temperature superposition): times over a_T,
/// frequencies times a_T.
ViscoelasticExperiment at_reference(ViscoelasticExperiment experiment, const std::optional<TemperatureShift>& shift);
ViscoelasticExperiments at_reference(const ViscoelasticExperiments& experiments,
                                     const std::optional<TemperatureShift>& shift);
/// The rows of a frequency sweep by rising values of `by`, one for each.
void sort_rows(ViscoelasticExperiment& sweep, std::vector<double> by);
/// How many temperatures there are.
std::size_t n_temperatures(const ViscoelasticExperiments& experiments);
/// "1.6 us to 10 ks"
std::string text_of(const TimeWindow& window);

/// What was followed over time, from rest.
struct LoadPath {
  std::vector<double> times, followed;
  std::size_t added = 0;  ///< rows before those of the experiment
};
/// With the step before the first row, if there is a ramp. `followed`: at the times of the experiment, its own or what
/// was measured in its place.
LoadPath whole_path(const ViscoelasticExperiment& experiment, const std::vector<double>& followed);

/// What is estimated. Bulk branches are not.
struct ViscoelasticChoice {
  bool young_modulus = true;   ///< the relaxed one
  bool moduli = true;          ///< of the shear branches
  bool times = true;           ///< likewise
  bool poisson_ratio = false;  ///< the relaxed one
  bool shift = false;          ///< of the times by the temperature: C1 and C2, or the activation energy
};

/// young_modulus [Pa], modulus_1 [Pa], time_1 [s] ..., C1, C2 [K] or activation_energy [J/mol], poisson_ratio; all but
/// the last on a logarithmic scale. Times stay within a factor of a thousand of the window.
std::vector<FitParameter> fit_parameters(const PronyLaw& law, const ViscoelasticChoice& choice,
                                         const TimeWindow& window);
/// The law with these values; nothing if they make no law.
std::optional<PronyLaw> with_values(const PronyLaw& law, const ViscoelasticChoice& choice,
                                    std::span<const double> values);

/// What each channel would measure.
std::vector<std::vector<double>> respond(const PronyLaw& law, const ViscoelasticExperiment& experiment);

/// Whether every channel says how noisy it is.
bool noise_is_known(const ViscoelasticExperiments& experiments);
std::size_t n_measured(const ViscoelasticExperiments& experiments);

/// Standard deviation of each measured value, experiment by experiment and channel by channel. Relative noise is that
/// of the law's values: those of the data would favour what noise makes small. Where noise is not known each channel
/// has the scatter of its values about the law, of stresses and strains the same for all, of DMA in proportion to the
/// value.
std::vector<double> deviations(const PronyLaw& law, const ViscoelasticExperiments& experiments);
/// The same before there is a law: by the measured values; 1 % where the noise is not known.
std::vector<double> first_deviations(const ViscoelasticExperiments& experiments);

/// Root of the mean square; zero of no values.
double rms_of(std::span<const double> values);

/// Model less measurement over its deviation.
std::vector<double> fit_residuals(const PronyLaw& law, const ViscoelasticExperiments& experiments,
                                  std::span<const double> deviations);

/// Rms of model less measurement over the measured rms, of each channel of an experiment.
std::vector<double> relative_misfits(const PronyLaw& law, const ViscoelasticExperiment& experiment);
/// The largest of all.
double relative_misfit(const PronyLaw& law, const ViscoelasticExperiments& experiments);

struct ViscoelasticFit {
  PronyLaw law;
  ViscoelasticChoice choice;
  std::vector<FitParameter> parameters;
  FitResult result;
};

/// Least squares from the values of `law` on; branches come back by rising time. `limits`: parameters whose bounds
/// replace those by default, found by name.
ViscoelasticFit fit_law(const PronyLaw& law, const ViscoelasticChoice& choice,
                        const ViscoelasticExperiments& experiments, std::span<const double> deviations,
                        const std::vector<FitParameter>& limits, const FitSettings& settings);

}  // namespace pfdm
