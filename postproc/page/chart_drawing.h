#pragma once
// A chart of a report.

#include "postproc/page/paper.h"
#include "postproc/page/report_page.h"

namespace pfdm {

/// The colour of this number; those that follow one another tell apart also where red and green do not.
Colour series_colour(int number);
/// Of its line.
Pen series_pen(const Series& series, double width);
bool has_line(const Series& series);
bool has_dots(const Series& series);

/// Axes, grid and series, without caption and key. Points that are not finite, or not positive on a logarithmic axis,
/// interrupt a line.
void draw_chart(Paper& paper, const Rectangle& place, const Chart& chart);

}  // namespace pfdm
