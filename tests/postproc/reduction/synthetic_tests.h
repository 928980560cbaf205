#pragma once
// Synthetic records of fracture tests: a crack that grows at one toughness in a specimen whose compliance over the
// crack length is given. The rows follow from C(a) and its derivative alone.

#include "postproc/reduction/test_record.h"

#include <cmath>
#include <functional>

namespace pfdm {

struct SyntheticTest {
  std::function<double(double)> compliance;  ///< C(a) [m/N]
  double width = 0.0, toughness = 0.0;       ///< [m], [J/m^2]

  /// dC/da by differences of fourth order.
  double slope(double a) const {
    const double s = 1e-4 * a;
    return (8.0 * (compliance(a + s) - compliance(a - s)) - compliance(a + 2 * s) + compliance(a - 2 * s)) / (12.0 * s);
  }
  /// Irwin, Kies: G = P^2/(2 b) dC/da.
  double force(double a) const { return std::sqrt(2.0 * width * toughness / slope(a)); }

  /// A straight rise of `n_rise` rows to a0, then `n_growth` rows up to the crack length `a_end`, with crack lengths.
  TestRecord record(double a0, double a_end, int n_rise = 50, int n_growth = 40) const {
    TestRecord rows;
    for (int i = 0; i < n_rise; ++i) {
      const double force_here = force(a0) * i / n_rise;
      rows.displacement.push_back(force_here * compliance(a0));
      rows.force.push_back(force_here);
      rows.crack_length.push_back(not_given);
    }
    for (int i = 0; i <= n_growth; ++i) {
      const double a = a0 + (a_end - a0) * i / n_growth;
      rows.displacement.push_back(force(a) * compliance(a));
      rows.force.push_back(force(a));
      rows.crack_length.push_back(a);
    }
    return rows;
  }
};

}  // namespace pfdm
