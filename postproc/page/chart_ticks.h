#pragma once
// Where an axis has its marks, and what they say.

#include "postproc/page/report_page.h"

#include <string>
#include <vector>

namespace pfdm {

struct AxisTicks {
  double from = 0.0, to = 1.0;  ///< ends of the axis; of a logarithmic one their decimal logarithms
  std::vector<double> positions;
  std::vector<std::string> labels;
};

/// For values between `least` and `most`, with about `count` marks at round numbers. What the axis fixes is kept; other
/// ends lie at the outermost marks, or a little beyond the values.
AxisTicks axis_ticks(const ChartAxis& axis, double least, double most, int count);

}  // namespace pfdm
