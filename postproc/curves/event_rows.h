#pragma once
// Events among the rows of their record: which rows they take the place of, and where of the specimen they are.

#include "postproc/curves/curve_misfit.h"

namespace pfdm {

/// Displacement of the specimen itself where the record has this one [m]: without what the set-up adds, as
/// of_specimen() has those of the rows.
double displacement_of_specimen(const MeasuredCurve& measured, double recorded);

/// Leaves out the points whose information events are, and notes their number (MeasuredPoints::left_out). Within three
/// standard deviations of the displacement of a jump they may be on the wrong side of it. A force that counts was
/// measured with the points beside it: on its side of the event the nearest ones are left out that together know it as
/// well, eight at most. Throws InputError if no point is left.
void leave_out_rows_of_events(MeasuredPoints& measured);

}  // namespace pfdm
