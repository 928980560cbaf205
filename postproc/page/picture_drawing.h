#pragma once
// A picture of a report: polygons in colours, lines, axes and the scale of the colours.

#include "postproc/page/paper.h"
#include "postproc/page/report_page.h"

namespace pfdm {

void draw_picture(Paper& paper, const Rectangle& place, const Picture& picture);

}  // namespace pfdm
