#include "cases/program/fracture/case/reduction_case.h"

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/case/run_keys.h"
#include "cases/program/input/config/key_member.h"

#include <fmt/format.h>

#include <cmath>

namespace pfdm {
namespace {

constexpr std::string_view two_arms = "double_cantilever_beam end_notched_flexure mixed_mode_bending";
constexpr std::string_view supported = "end_notched_flexure mixed_mode_bending";
constexpr std::string_view with_young_modulus = "end_notched_flexure mixed_mode_bending compact_tension";
constexpr Range poisson{-1.0, 0.5, true, "above -1 and below 0.5"};

Key only_of(Key key, std::string_view specimens) {
  key.only = specimens;
  return key;
}

Key required(Key key) {
  key.otherwise.clear();
  return key;
}

std::vector<Key> dimension_rows() {
  using namespace keys;
  using D = TestDimensions;
  const KeyType length = quantity(dimension::length, range::positive),
                stress = quantity(dimension::stress, range::positive);
  const auto part = [](Key key) { return only_of(std::move(key), two_arms); };
  const auto block = [](Key key) { return only_of(std::move(key), "double_cantilever_beam"); };
  const KeyType block_length = quantity(dimension::length, range::not_negative);
  const std::string left_out = "methods that need it are left out";
  return {
      required(stored<&D::width>("width", length, "Width b (B) of the specimen.")),
      part(required(stored<&D::thickness>("thickness", length, "Thickness 2h of the specimen, both arms together."))),
      required(stored<&D::crack_length>("crack_length", length,
                                        "Length a0 of the crack before it grows, from the load line or the support.")),
      only_of(required(stored<&D::half_span>("half_span", length, "Half of the span between the supports, L.")),
              supported),
      only_of(required(stored<&D::lever>("lever", length, "Lever length c of mixed-mode bending.")),
              "mixed_mode_bending"),
      only_of(required(
                  stored<&D::depth>("depth", length, "Width W of a compact specimen, from the load line to its back.")),
              "compact_tension"),
      only_of(stored<&D::young_modulus>("young_modulus", stress,
                                        "Young's modulus along the arms, or of an isotropic material.",
                                        "by the initial compliance, if the method can"),
              with_young_modulus),
      part(stored<&D::transverse_modulus>("transverse_modulus", stress, "Young's modulus E33 across the arms.",
                                          left_out)),
      part(stored<&D::shear_modulus>("shear_modulus", stress, "Shear modulus G13 of the arms.", left_out)),
      only_of(stored<&D::poisson_ratio>("poisson_ratio", number(poisson), "Poisson's ratio of an isotropic material.",
                                        left_out),
              "compact_tension"),
      block(stored<&D::block_offset>(
          "block_offset", block_length,
          "Distance t (l1) from the load point to the middle of the arm, for F and N; with block_length.",
          "0 in F, N = 1")),
      block(stored<&D::block_length>(
          "block_length", block_length,
          "Distance L' (l2) from the load point to the end of its block, for N; with block_offset.", "N = 1")),
  };
}

std::vector<Key> calibration_rows() {
  using namespace keys;
  Key lengths{"calibration_lengths", list(quantity(dimension::length, range::positive), 2), "none",
              "Crack lengths at which the compliance was measured before the test."};
  Key compliances{"calibration_compliances", list(quantity(dimension::compliance, range::positive), 2), "none",
                  "Compliances at calibration_lengths, in their order."};
  return {only_of(lengths, "end_notched_flexure"), only_of(compliances, "end_notched_flexure")};
}

std::vector<double> quantities(const ConfigTable& table, std::string_view key) {
  std::vector<double> values;
  if (const auto list = table.find(key))
    for (const ConfigValue& value : list->list()) values.push_back(value.quantity());
  return values;
}

void require_both_of_blocks(const ConfigTable& table, const TestDimensions& read) {
  if (std::isnan(read.block_offset) == std::isnan(read.block_length)) return;
  const bool has_offset = !std::isnan(read.block_offset);
  throw table.at(has_offset ? "block_offset" : "block_length")
      .error(fmt::format("{} is missing: block_offset and block_length go together, as F and N do; both are \"0 mm\" "
                         "without end blocks",
                         has_offset ? "block_length" : "block_offset"));
}

TestDimensions read_dimensions(const ConfigTable& table) {
  for (const Key* key : table.rows())
    if (key->otherwise.empty()) table.at(key->name);  // read_stored() passes over missing ones
  TestDimensions read;
  read_stored(table, read);
  require_both_of_blocks(table, read);
  if (table.choice("specimen") == "end_notched_flexure") {
    read.calibration_lengths = quantities(table, "calibration_lengths");
    read.calibration_compliances = quantities(table, "calibration_compliances");
    if (read.calibration_lengths.size() != read.calibration_compliances.size())
      throw table.error(
          fmt::format("there are {} calibration_lengths and {} calibration_compliances; each length has one",
                      read.calibration_lengths.size(), read.calibration_compliances.size()));
  }
  if (read.crack_length >= read.half_span)
    throw table.at("crack_length").error("the crack must be shorter than half_span: it must not reach the load");
  if (read.crack_length >= read.depth) throw table.at("crack_length").error("the crack must be shorter than depth");
  return read;
}

/// Without the factors that make forces and displacements those of the model, but for their signs.
void take_factors_out(TestRecord& record, const MeasuredCurve& specimen) {
  for (double& u : record.displacement) u /= std::abs(specimen.displacement_factor);
  for (double& force : record.force) force /= std::abs(specimen.force_factor);
}

}  // namespace

const KeyTable& reduction_keys() {
  static const KeyTable table{
      .name = "experiment.reduction",
      .sentence = "Specimen of a fracture test, whose records are reduced to energy release rates as standards do.",
      .keys = keys::joined({{{"specimen", keys::one_of("specimen", reduced_specimens()), "",
                              "Kind of specimen, which has its methods of data reduction."}},
                            dimension_rows(),
                            calibration_rows()}),
      .decided_by = "specimen"};
  return table;
}

std::optional<ReductionSettings> read_reduction(const ConfigTable& root, const std::filesystem::path& case_directory) {
  if (!root.has("experiment")) return std::nullopt;
  const ConfigTable experiment = root.with_keys(fracture_keys()).table("experiment");
  const std::vector<ConfigTable> specimens = experiment.tables("specimens");
  if (!experiment.has("reduction")) {
    for (const ConfigTable& specimen : specimens)
      if (specimen.has("crack_length"))
        throw specimen.at("crack_length")
            .error("crack lengths are for data reduction, which needs [experiment.reduction]");
    return std::nullopt;
  }
  const ConfigTable table = experiment.table("reduction");
  ReductionSettings settings{.where = table};
  settings.specimen = &choose(table.at("specimen"), reduced_specimens(), "specimen");
  settings.dimensions = read_dimensions(table);
  for (const ConfigTable& specimen : specimens) {
    const MeasuredCurve test = read_fracture_test(specimen, experiment, case_directory);
    const SampledCurve curve = test.of_specimen();
    TestRecord record{.displacement = curve.x, .force = curve.y, .crack_length = curve.deviation};
    take_factors_out(record, test);
    settings.names.push_back(curve.name);
    settings.records.push_back(std::move(record));
  }
  return settings;
}

std::vector<ReducedTest> reduced_tests(const ReductionSettings& settings) {
  std::vector<ReducedTest> tests;
  for (std::size_t i = 0; i < settings.records.size(); ++i) {
    const std::string& name = settings.names[i];
    try {
      tests.push_back(reduced_test(*settings.specimen, settings.records[i], settings.dimensions, name));
    } catch (const InputError& error) {
      throw settings.where.error(fmt::format("data reduction of \"{}\": {}", name, error.what()));
    }
  }
  return tests;
}

}  // namespace pfdm
