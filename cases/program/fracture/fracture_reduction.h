#pragma once
// pfdm reduce: records of fracture tests to energy release rates, beside the toughness of a fit.

#include "cases/program/fracture/run/running_case.h"

namespace pfdm {

/// Whether all records can be reduced, as far as the case has [experiment.reduction]. Warns of one that cannot: fits
/// and runs do without.
bool can_be_reduced(const FractureProgram& program, Log& log);

/// Says what each method gives and writes reduction.json and reduction.csv. Throws InputError for a record that cannot
/// be reduced.
void reduce_tests(const FractureProgram& program, Session& session);

}  // namespace pfdm
