#pragma once
// A fit of Prony branches to relaxation and DMA in shear, by the closed forms of tests/solver/synthetic_relaxation.h.

#include "postproc/files/csv_table.h"
#include "tests/cases/temporary_case.h"
#include "tests/solver/synthetic_relaxation.h"

#include <numbers>
#include <string>
#include <vector>

namespace pfdm {

/// A relaxation in shear, and complex moduli.
inline constexpr const char* relaxing_case = R"(kind = "viscoelastic"
title = "rubber"
[material]
young_modulus = "3 MPa"
poisson_ratio = 0.49
shear_branches = [{ modulus = "1.5 MPa", time = "50 ms" }, { modulus = "0.8 MPa", time = "2 s" }]
[loading]
deformation = "shear"
[[loading.segments]]
duration = "0.3 s"
increments = 7
strain = "2 %"
[[loading.segments]]
duration = "20 s"
increments = 12
spacing = "logarithmic"
strain = "2 %"
[frequency_sweep]
from = "1 mHz"
to = "1 kHz"
points_per_decade = 5
)";

inline const std::string bulk_case = R"(kind = "viscoelastic"
title = "rubber"
[material]
young_modulus = "1 MPa"
poisson_ratio = 0.49
shear_branches = [{ modulus = "1 MPa", time = "1 s" }]
[frequency_sweep]
from = "0.1 Hz"
to = "10 Hz"
)";

inline const std::string bulk_fit = R"(
[fit]
branches = [1, 5]
[fit.bounds]
young_modulus = ["10 kPa", "1 GPa"]
[[fit.experiments]]
name = "relaxation"
csv = "relaxation.csv"
deformation = "shear"
time = "t"
time_unit = "ms"
strain = { column = "gamma", unit = "%" }
stress = { column = 3, unit = "kPa", noise = "0.7862 kPa" }
[[fit.experiments]]
name = "DMA"
csv = "dma.csv"
deformation = "shear"
frequency = { column = "f" }
storage_modulus = { column = "G1", relative_noise = "1.4 %" }
loss_factor = { column = "tan", relative_noise = 0.014 }
)";

/// The case and its data, the relaxation in ms, % and kPa, the DMA swept down with units in a row of their own.
class BulkFitCase {
 public:
  explicit BulkFitCase(const std::string& fit = bulk_fit, const char* frequency_unit = "rad/s")
      : directory(bulk_case + fit) {
    const ViscoelasticExperiment relaxation = relaxation_test(true_series, 0.005, 7);
    std::string text = "# synthetic\nt;gamma;tau\n";
    for (std::size_t i = 0; i < relaxation.times.size(); ++i)
      text += std::to_string(1e3 * relaxation.times[i]) + ";" + std::to_string(100.0 * relaxation.followed[i]) + ";" +
              std::to_string(1e-3 * relaxation.channels[0].values[i]) + "\n";
    directory.write("relaxation.csv", text);
    const ViscoelasticExperiment sweep = frequency_sweep(true_series, 0.014, 7),
                                 exact = frequency_sweep(true_series, 0.0, 7);
    const double unit = std::string(frequency_unit) == "Hz" ? 2.0 * std::numbers::pi : 1.0;
    text = "# synthetic\nf,G1,tan\n" + std::string(frequency_unit) + ",MPa,-\n";
    for (std::size_t i = sweep.angular_frequencies.size(); i-- > 0;)
      text += std::to_string(sweep.angular_frequencies[i] / unit) + "," +
              std::to_string(1e-6 * sweep.channels[0].values[i]) + "," +
              std::to_string(sweep.channels[1].values[i] / exact.channels[0].values[i]) + "\n";
    directory.write("dma.csv", text);
  }
  TemporaryCase directory;
};

}  // namespace pfdm
