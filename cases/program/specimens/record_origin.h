#pragma once
// Where the displacements of a record begin, as a new case of a specimen names it: toes whose straight part misses the
// origin, and what they err by.

#include "cases/program/specimens/measured_record.h"
#include "postproc/reduction/initiation.h"

#include <string>
#include <vector>

namespace pfdm {

/// stiffness_between of [experiment]: where the straight part of a record lies, whose toe may be taken off.
std::string straight_keys(const StraightPart& straight, bool takes_toe);

/// Adds the toe of a record whose straight part misses the origin, by more than noise moves it; as a comment where the
/// specimen may stiffen. Where noise may have moved it, or slack, no toe but an offset, which a fit estimates.
void add_toe(MeasuredRecord& record, const StraightPart& straight, bool is_taken);

/// [[fit.parameters]] of the offsets of records whose straight part misses the origin noticeably, with and without toe:
/// it gives the origin within noise, and a modulus about a wrong origin errs by more than its interval.
std::string offset_parameters(const std::vector<StraightPart>& straight);

}  // namespace pfdm
