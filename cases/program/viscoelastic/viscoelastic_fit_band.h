#pragma once
// What the intervals of the branches leave open of the moduli over frequency.

#include "postproc/curves/fit_json.h"
#include "postproc/files/csv_table.h"
#include "solver/point/viscoelastic_fit.h"

namespace pfdm {

inline constexpr const char* modulus_band_file = "fit_complex_modulus.csv";

/// Complex moduli in tension and shear of a fitted law, ten frequencies a decade over the window of the data, from
/// 1/(2 pi longest time) to 1/(2 pi shortest time), and of a sound fit their intervals: to first order in what is
/// estimated, with the intervals and correlations of the estimates. Branches that lie close to each other make up for
/// each other, so that a modulus is known far better than they are. Of DMA at one frequency there is one row. Where
/// nothing relaxes the loss modulus is zero, and so are the ends of its interval.
CsvTable modulus_band(const ViscoelasticFit& fit, const FitFindings& findings, const TimeWindow& window);

}  // namespace pfdm
