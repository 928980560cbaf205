#pragma once
// pfdm compare: the results of a fracture case against its experiments.

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/case/fracture_case.h"
#include "cases/program/session/session.h"
#include "postproc/cohesive/column_record.h"
#include "postproc/curves/curve_csv.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pfdm {

/// Force over displacement as a test that is driven by its displacement would show it.
/// `first_debonding`: the row behind which something debonds first.
SampledCurve computed_curve(const std::vector<CurveRow>& rows, int component,
                            std::optional<std::size_t> first_debonding = std::nullopt);
/// That row, as summary.json there says; nothing where nothing debonds, or the row is not there.
std::optional<std::size_t> first_debonding_in(const std::filesystem::path& results, const std::vector<CurveRow>& rows,
                                              int component);

/// The surface that the experiment's angles are of; it has one at least. Throws InputError for a surface that the
/// record does not have.
const ColumnRecord& measured_surface(const ExperimentSettings& experiment, const std::vector<ColumnRecord>& records);
/// The debonding angle [rad] at the pole, and of the surface, that the experiment's angles are of; it has one at least.
/// Throws InputError for a surface that the record does not have.
SampledCurve computed_angle(const ExperimentSettings& experiment, const std::vector<CurveRow>& rows,
                            const std::vector<ColumnRecord>& records);
/// An energy [J] likewise to computed_curve.
SampledCurve computed_energy(const std::vector<CurveRow>& rows, const EnergyKind& kind);

/// Reads the results in session.results, writes the comparison beside them and says its figures. Throws InputError
/// where there are no results or nothing can be compared.
void compare_with_experiment(const FractureCase& fracture, const ExperimentSettings& experiment,
                             const std::string& name, const std::string& hash, Session& session);

}  // namespace pfdm
