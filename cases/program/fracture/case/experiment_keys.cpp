#include "cases/program/fracture/case/event_case.h"
#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/case/field_case.h"
#include "cases/program/fracture/case/reduction_case.h"
#include "cases/program/fracture/case/run_keys.h"
#include "cases/program/input/config/csv_keys.h"

namespace pfdm {
namespace {

const KeyTable& scaled_column_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "column with a factor",
      .sentence = "A column of a CSV file, times a factor.",
      .keys =
          joined({column_keys().keys,
                  {{"factor", number(), "1",
                    "Factor of the column's values, as 0.5 for the force on half a model, -1 for another sign."}}})};
  return table;
}

std::vector<Key> curve_columns(std::string_view quantity, std::string_view sentence) {
  using namespace keys;
  return joined(
      {{{"name", text("name"), "", "Name of the measured curve."}},
       csv_keys(),
       {{"displacement", table(scaled_column_keys), "", "Column of the displacement."},
        {quantity, table(scaled_column_keys), "", sentence},
        {"deviation", table(scaled_column_keys), "none", "Column of the values' standard deviation (uncertainty)."}}});
}

// Of [experiment], for all specimens, or of one of them.
std::vector<Key> preparation_rows() {
  using namespace keys;
  const KeyType length_or_force = either({quantity(dimension::force), quantity(dimension::length)});
  return {
      {"loops", choice("treatment of unloading loops", {"envelope"}), "refused",
       "How unloading loops of a record are treated: envelope leaves them out."},
      {"jitter", quantity(dimension::length, range::not_negative), "0: refused",
       "How far a displacement may be moved so that the displacements do not fall (noise)."},
      {"toe", list(length_or_force, 2, 2), "none",
       "Forces or displacements between which the curve is straight; its line gives the origin (toe compensation)."},
      {"offset", quantity(dimension::length), "0", "Displacement that the record reads at the true origin."},
      {"force_offset", quantity(dimension::force), "0", "Force that the record reads at the true origin (zero drift)."},
      {"compliance", quantity(dimension::compliance, range::not_negative), "0",
       "Compliance of the testing machine, grips and fixtures in series with the specimen."}};
}

const KeyTable& specimen_keys() {
  static const KeyTable table{
      .name = "experiment.specimens[]",
      .sentence = "A measured force-displacement curve.",
      .keys = keys::joined({curve_columns("force", "Column of the force."),
                            {{"crack_length", keys::table(scaled_column_keys), "none",
                              "Column of crack lengths from the load line, for data reduction; empty where not read."}},
                            preparation_rows()})};
  return table;
}

const KeyTable& debonding_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "experiment.debonding[]",
      .sentence = "A measured angle of the debonded cap of a particle against the displacement.",
      .keys = joined({curve_columns("angle", "Column of the debonding angle."),
                      {{"surface", text("name"), "the first", "Name of the particle's surface in cohesive.json."},
                       {"pole", choice("pole", {"positive", "negative"}), "",
                        "Pole of the particle, along the curve's component, at which the cap begins."}}})};
  return table;
}

const KeyTable& energy_keys() {
  static const KeyTable table{
      .name = "experiment.energies[]",
      .sentence = "Energies against the displacement, as of another run, with which the run's own are compared.",
      .keys = keys::joined({curve_columns("energy", "Column of the energy."),
                            {{"of", keys::one_of("energy of a run", energy_kinds()), "",
                              "Which energy of the run it is compared with: work, stored or dissipated."}}})};
  return table;
}

}  // namespace

const KeyTable& experiment_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "experiment",
      .sentence = "Measured curves that the run is compared with and fitted to.",
      .keys = joined(
          {{{"stiffness_between", list(quantity(dimension::length), 2, 2), "",
             "Displacements between which the initial stiffness is the least-squares slope."},
            {"specimens", tables(specimen_keys), "", "Measured force-displacement curves, one for each specimen."},
            {"debonding", tables(debonding_keys), "none", "Measured debonding angles of a particle."},
            {"events", tables(event_keys), "none", "Events of the curves, with standard deviations of their own."},
            {"reduction", keys::table(reduction_keys), "none",
             "Specimen of a fracture test, whose records are reduced to energy release rates."},
            {"fields", tables(measured_field_keys), "none",
             "Displacements measured on a face, as by digital image correlation."},
            {"energies", tables(energy_keys), "none", "Energies with which those of the run are compared."}},
           preparation_rows()})};
  return table;
}

}  // namespace pfdm
