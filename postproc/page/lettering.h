#pragma once
// How text looks: outlines and widths of Liberation Sans, which has the widths of Helvetica (FreeType). One thread at a
// time.

#include "postproc/page/paper.h"

#include <string>
#include <vector>

namespace pfdm {

using Outline = std::vector<std::vector<PaperPoint>>;

/// Of the whole text, from the left end of its base line [pt].
double text_width(const std::string& text, double size, bool bold = false);

/// Closed polygons of a text at the origin, upright [pt]; holes run the other way round.
Outline text_outline(const std::string& text, double size, bool bold);

/// A point of a text that begins at `start` and rises by `angle` [rad], from where it is in the upright text.
PaperPoint turned(const PaperPoint& point, const PaperPoint& start, double angle);

}  // namespace pfdm
