#include "cases/program/point/endochronic_case_keys.h"

#include "cases/program/input/config/csv_keys.h"
#include "cases/program/input/laws/endochronic_keys.h"
#include "cases/program/studies/study_keys.h"
#include "physics/elasticity/mandel.h"
#include "solver/point/endochronic_identification.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

constexpr Range count{1.0, 1e7, false, "at least 1 and at most 10000000"};
constexpr Range terms_range{1.0, 12.0, false, "between 1 and 12"};
constexpr Range substeps_range{1.0, 1000.0, false, "between 1 and 1000"};
constexpr Range starts_range{1.0, 1000.0, false, "between 1 and 1000"};

KeyType control_value() {
  using namespace keys;
  return either({number(), quantity(dimension::stress), quantity(dimension::number), table(control_value_keys)});
}

const KeyTable& condition_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "loading.segments[].conditions[]",
      .sentence = "A linear condition between increments of stress and strain.",
      .keys = {{"sum", names(either({number(), quantity(dimension::stress)}), point_component_keys()), "",
                "Factors of the components' increments; with stress in the sum, factors of strain are stresses."},
               {"change", control_value(), "0", "What the sum changes by over the segment."}}};
  return table;
}

const KeyTable& segment_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "loading.segments[]",
      .sentence = "A segment of the loading with six conditions on stress and strain.",
      .keys = {
          {"duration", quantity(dimension::time, range::positive), "that of the CSV file", "Duration of the segment."},
          {"increments", whole(count), "those of the CSV file", "Number of increments of the segment."},
          {"control", names(control_value(), point_component_keys()), "none",
           "Prescribed components of stress and strain; those that are not named are free of stress."},
          {"free",
           list(choice("pair of stress and strain",
                       std::vector<std::string>(component_names.begin(), component_names.end()))),
           "none", "Pairs of indices with neither stress nor strain prescribed."},
          {"conditions", tables(condition_keys), "none",
           "Linear conditions between increments of stress and strain."}}};
  return table;
}

const KeyTable& point_loading_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "loading of a material point",
      .sentence = "The loading of a material point: segments, and how often they are passed through.",
      .keys = {{"repeat", whole(count), "1", "Number of passes through the segments, as for load cycles."},
               {"largest_strain_increment", number(range::positive), "no limit",
                "Strain increments are divided into substeps of at most this."},
               {"segments", tables(segment_keys), "", "Segments of the loading, one after the other."}}};
  return table;
}

const KeyTable& material_point_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "material of a material point",
      .sentence = "The endochronic law of the material point.",
      .keys = joined({{{"young_modulus", quantity(dimension::stress, range::positive), "", "Young's modulus E."},
                       {"poisson_ratio", number(range::poisson_ratio), "", "Poisson's ratio nu."}},
                      kernel_keys(""),
                      endochronic_factor_keys()})};
  return table;
}

const KeyTable& experiment_of_point_keys() {
  using namespace keys;
  const KeyType columns = names(keys::table(component_column_keys), point_component_keys());
  static const KeyTable table{
      .name = "fit.experiments[]",
      .sentence = "A measured test of the material, to which the law is fitted or which it predicts.",
      .keys = joined({{{"name", text("name"), "", "Name of the test."}},
                      csv_keys(),
                      {{"time", text("column"), "\"time_s\"", "Name of the column of the time."},
                       {"time_unit", text("unit"), "\"s\"", "Unit of the column of the time."},
                       {"controlled", choice("quantity that a test controls", {"strain", "stress"}), "\"strain\"",
                        "Whether the test followed strains or stresses, as creep tests do."},
                       {"strain", columns, "", "Columns of the strains, by component."},
                       {"stress", columns, "", "Columns of the stresses, by component."},
                       {"predicted", flag(), "false", "Whether the test is predicted in place of fitted."}}})};
  return table;
}

const KeyTable& point_fit_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit of a material point",
      .sentence = "What of the endochronic law is estimated, and from which tests.",
      .keys = {
          {"method", one_of("method of identification", identification_methods()), "\"joint\"",
           "Method of identification."},
          {"estimate",
           list(choice("part of the law that can be estimated", {"kernel", "hardening", "rate", "young_modulus"})),
           "kernel, hardening, and rate if there is a rate factor", "Parts of the law that are estimated."},
          {"terms", list(whole(terms_range), 2, 2), "those of [material]",
           "Least and largest number of kernel terms that are tried."},
          {"starts", whole(starts_range), "1", "Number of starting points: the first guess and random ones about it."},
          {"largest_strain_increment", number(range::positive), "no limit",
           "Strain increments are divided into substeps of at most this."},
          {"substeps", whole(substeps_range), "as many as estimates need",
           "Steps of the model for each increment of the curves."},
          {"bounds", names(list(either({number(range::positive), quantity(dimension::stress, range::positive)}), 2, 2)),
           "a factor of 1e5 about the first guess", "Bounds of parameters by name, as C_1, alpha_1, f_inf."},
          {"experiments", tables(experiment_of_point_keys), "", "Measured tests."},
      }};
  return table;
}

}  // namespace

const std::vector<std::string>& point_component_keys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all;
    for (const char* what : {"stress", "strain"})
      for (const std::string_view name : component_names) all.push_back(fmt::format("{}_{}", what, name));
    for (std::size_t k = 3; k < 6; ++k) all.push_back(fmt::format("gamma_{}", component_names[k]));
    return all;
  }();
  return keys;
}

const KeyTable& control_value_keys() {
  using namespace keys;
  const KeyType point =
      either({number(), quantity(dimension::time), quantity(dimension::stress), quantity(dimension::number)});
  static const KeyTable table{
      .name = "loading.segments[].control",
      .sentence = "A component over time: a formula, a table or a column of a CSV file.",
      .keys =
          joined({{{"expr", text("formula"), "or table or csv", "Formula in t, seconds since the segment began."},
                   {"unit", text("unit"), "SI", "Unit of the formula or of the column."},
                   {"table", list(list(point, 2, 2)), "or expr or csv", "Pairs of time and value, linear in between."},
                   {"csv", path(), "or expr or table", "CSV file with the component over time, seen from the case."},
                   {"column", column_type(), "with csv", "Column of the CSV file: its name or number."},
                   {"time", text("column"), "\"time_s\"", "Name of the column of the time."},
                   {"time_unit", text("unit"), "\"s\"", "Unit of the column of the time."}},
                  csv_mark_keys()})};
  return table;
}

const KeyTable& component_column_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "fit.experiments[].stress",
      .sentence = "The column of a component of stress or strain.",
      .keys = joined({column_keys().keys,
                      {{"noise",
                        either({number(range::positive), quantity(dimension::stress, range::positive),
                                quantity(dimension::number)}),
                        "the rms of all", "Standard deviation of the measured component.", "measured"}}}),
      .decided_by_reader = true};
  return table;
}

const KeyTable& endochronic_case_keys() {
  using namespace keys;
  static const KeyTable table{
      .name = "kind \"endochronic\"",
      .sentence = "One material point of endochronic plasticity under mixed control.",
      .keys =
          joined({head_keys(),
                  {{"material", keys::table(material_point_keys), "", "Endochronic law of the material point."},
                   {"loading", keys::table(point_loading_keys), "", "Segments of the loading."},
                   {"fit", keys::table(point_fit_keys), "none", "What of the law is estimated from which tests."},
                   {"sweep", keys::table(sweep_keys), "none", "Parameters with which pfdm sweep runs the case."}}})};
  return table;
}

}  // namespace pfdm
