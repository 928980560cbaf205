#pragma once
// pfdm reduce: records of fracture tests to energy release rates, beside the toughness of a fit.

#include "cases/program/fracture/run/running_case.h"

namespace pfdm {

/// Says what each method gives and writes reduction.json and reduction.csv. Throws InputError for a record that cannot
/// be reduced.
void reduce_tests(const FractureProgram& program, Session& session);

}  // namespace pfdm
