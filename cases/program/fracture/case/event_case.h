#pragma once
// Reads [[experiment.events]]: what of a measured curve counts as an event, stated in the case or found in its rows.

#include "cases/program/input/config/key.h"
#include "postproc/curves/curve_events.h"
#include "postproc/curves/measured_curve.h"

#include <vector>

namespace pfdm {

const KeyTable& event_keys();

/// `experiment`: the table that holds the events. Throws InputError that names file and line: for events of curves
/// without standard deviations, for what no event has, and for a jump that is not in the record.
std::vector<MeasuredEvent> read_events(const ConfigTable& experiment, const std::vector<MeasuredCurve>& specimens);

}  // namespace pfdm
