#pragma once
// Reads [[experiment.events]]: what of a measured curve counts as an event, stated in the case or found in its rows.

#include "cases/program/input/config/config.h"
#include "cases/program/input/config/key.h"
#include "postproc/curves/curve_events.h"
#include "postproc/curves/measured_curve.h"

#include <vector>

namespace pfdm {

const KeyTable& event_keys();

struct StatedEvent {
  MeasuredEvent event;  ///< its figures in the numbers of the record's file; without any it is to be found there
  ConfigTable where;    ///< for messages
};

/// `experiment`: the table that holds the events. Throws InputError that names file and line for what no event has.
/// What the records have of them is of no concern: runs and comparisons do without events.
std::vector<StatedEvent> read_events(const ConfigTable& experiment, const std::vector<MeasuredCurve>& specimens);

/// As the specimens' curves have them: found in their rows, or prepared as these were, by factor and toe. Throws
/// InputError that names file and line: for events of curves without standard deviations, beyond the record or named
/// twice, and for a jump that is not in the record.
std::vector<MeasuredEvent> events_in_records(const std::vector<StatedEvent>& stated,
                                             const std::vector<MeasuredCurve>& specimens);

/// Number of the specimen that the key "specimen" names; the only one without it. `what`: "whose event it is". Throws
/// InputError for one that is not there, and where several could be meant.
std::size_t read_specimen_of(const ConfigTable& table, const std::vector<MeasuredCurve>& specimens,
                             std::string_view what);

}  // namespace pfdm
