#pragma once
// What the intervals of the branches leave open of the moduli over frequency.

#include "postproc/files/csv_table.h"
#include "postproc/fits/fit_json.h"
#include "solver/point/viscoelastic_fit.h"

#include <span>
#include <string>

namespace pfdm {

inline constexpr const char* modulus_band_file = "fit_complex_modulus.csv";

/// Complex moduli of a fitted law, and what is to be said of them; empty: nothing.
struct ModulusBand {
  CsvTable table;
  std::string warning{};
};

/// Complex moduli in tension and shear of a fitted law, ten frequencies a decade over the window of the data, from
/// 1/(2 pi longest time) to 1/(2 pi shortest time), and of a sound fit their intervals. Where branches are estimated
/// they are those of all spectra that the data allow, whatever the number of branches
/// (solver/point/allowed_spectra.h): the data of the fit and their deviations are needed. A fit of few branches may lie
/// outside of them, which the warning says. Where branches are given, they are to first order in what is estimated,
/// with the intervals and correlations of the estimates. Of DMA at one frequency there is one row. Where nothing
/// relaxes the loss modulus is zero, and so are the ends of its interval.
ModulusBand modulus_band(const ViscoelasticFit& fit, const FitFindings& findings,
                         const ViscoelasticExperiments& experiments, std::span<const double> deviations);

/// Makes the interval of the relaxed Young's modulus of a sound fit hold what all spectra give that the data allow, of
/// times up to the longest of the window: its interval to first order is that of the fit's few branches alone. What is
/// slower than the tests counts as rest.
void widen_relaxed_modulus(const ViscoelasticFit& fit, const ViscoelasticExperiments& experiments,
                           std::span<const double> deviations, FitFindings& findings);

}  // namespace pfdm
