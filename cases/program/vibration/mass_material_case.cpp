#include "cases/program/vibration/mass_material_case.h"

#include "cases/program/input/config/key_member.h"
#include "cases/program/vibration/mass_material_keys.h"

#include "cases/program/input/config/path_reader.h"
#include "cases/program/input/fields/csv_marks.h"
#include "cases/program/vibration/vibration_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

double level(const ConfigTable& table) { return table.quantity("level"); }

Excitation read_swept_sine(const ConfigTable& table, const fs::path&, double, std::vector<fs::path>&) {
  SweptSine sweep{.amplitude = level(table),
                  .from = table.quantity("from"),
                  .to = table.quantity("to"),
                  .duration = table.quantity("duration"),
                  .logarithmic = table.choice("law", "linear") == "logarithmic"};
  sweep.ramp = table.quantity("ramp", 0.01 * sweep.duration);
  return swept_sine(sweep);
}

Excitation read_harmonic(const ConfigTable& table, const fs::path&, double, std::vector<fs::path>&) {
  const double duration = table.quantity("duration");
  return harmonic(level(table), table.quantity("frequency"), duration, table.quantity("ramp", 0.01 * duration));
}

Excitation read_random(const ConfigTable& table, const fs::path&, double, std::vector<fs::path>&) {
  BandLimitedRandom random{.density = table.quantity("density"),
                           .low = table.quantity("from"),
                           .high = table.quantity("to"),
                           .duration = table.quantity("duration")};
  random.seed = static_cast<std::uint64_t>(table.integer("seed", std::int64_t{1}));
  if (random.low >= random.high)
    throw table.error(
        fmt::format("the band goes from {} to {} Hz; the first must be the lower", random.low, random.high));
  return band_limited_random(random);
}

RecordFile read_record_file(const ConfigTable& table, const fs::path& directory, double rate,
                            std::vector<fs::path>& data_files) {
  RecordFile record;
  record.file = read_data_file(table.at("file"), directory);
  data_files.push_back(record.file);
  record.usual_rate = rate;
  record.base = table.string("base", record.base);
  record.relative = table.string("relative", record.relative);
  record.time = table.string("time", record.time);
  record.names_time = table.has("time");
  if (table.has("unit")) record.base_unit = record.relative_unit = table.string("unit");
  if (table.has("time_unit")) record.time_unit = table.string("time_unit");
  if (table.has("rate")) record.rate = table.quantity("rate");
  record.marks = read_csv_marks(table);
  return record;
}

Excitation read_measured(const ConfigTable& table, const fs::path& directory, double rate,
                         std::vector<fs::path>& files) {
  const RecordFile source = read_record_file(table, directory, rate, files);
  const SampledChannel channel = table.in_context([&] { return read_channel(source); });
  for (const std::string& note : channel.notes) table.remark(note);
  return sampled_excitation(channel.values, channel.rate, table.quantity("from"), table.quantity("to"));
}

constexpr ExcitationType excitations[] = {
    {"swept_sine", "sine whose frequency goes up or down, linear or logarithmic in time", read_swept_sine},
    {"harmonic", "sine of one frequency", read_harmonic},
    {"random", "Gaussian noise of a flat spectral density within a band", read_random},
    {"measured", "base acceleration from a file", read_measured},
};

constexpr FitMethod methods[] = {
    {"output_error", "separable start, then the simulated response fitted to all records; order by BIC; intervals"},
    {"least_squares", "continuous-time least squares (AFRL-RW-EG-TR-2016-088, A4.2), M = 0 or 1"},
    {"ten_step", "iteration with a Prony series (AFRL-RW-EG-TR-2016-088, A4.3), of the first record; for comparison"},
};

const ExcitationType& type_of(const ConfigTable& excitation) {
  return choose(excitation.at("type"), excitation_types(), "type of excitation");
}

VibrationTest read_test(const ConfigTable& table, const fs::path& directory, MassMaterialCase& c) {
  VibrationTest test;
  std::string_view motion;
  test.where = table.at("name");
  test.name = read_plain_name(*test.where, "files");
  if (table.has("excitation")) {
    const ConfigTable shaker = table.table("excitation");
    motion = type_of(shaker).name;
    test.excitation = read_excitation(shaker, directory, c.rate, c.data_files);
    test.band_low = test.excitation->band_low;
    test.band_high = test.excitation->band_high;
  }
  if (table.has("record")) {
    const ConfigTable record = table.table("record");
    test.record = read_record_file(record, directory, c.rate, c.data_files);
    if (record.has("base_file")) {
      test.record->base_file = read_data_file(record.at("base_file"), directory);
      c.data_files.push_back(*test.record->base_file);
    }
    if (record.has("base_unit")) test.record->base_unit = record.string("base_unit");
    if (record.has("relative_unit")) test.record->relative_unit = record.string("relative_unit");
    test.record->absolute = record.choice("acceleration", "relative") == "absolute";
    test.band_low = record.quantity("from", test.band_low);
    test.band_high = record.quantity("to", test.band_high);
  }
  if (!test.excitation && !test.record) throw table.error("a test requires an excitation, a record or both");
  if (!(test.band_low > 0.0 && test.band_high >= test.band_low))
    throw table.error("the excited band is not known: give the record's \"from\" and \"to\"");
  test.predicted = table.boolean("predicted", false);
  if (const auto date = table.find("date")) test.date = read_date(*date);
  if (table.has("schedule"))
    test.schedule = read_scheduled_run(table.table("schedule"), motion, test.band_high - test.band_low);
  return test;
}

bool share_a_file(const std::string& one, const std::string& other) {
  return std::ranges::any_of(result_endings,
                             [&](std::string_view ending) { return one == other + std::string(ending); });
}

void read_tests(const ConfigTable& root, const fs::path& directory, MassMaterialCase& c) {
  for (const ConfigTable& table : root.tables("test")) {
    VibrationTest test = read_test(table, directory, c);
    if (std::ranges::count(c.tests, test.name, &VibrationTest::name) > 0)
      throw test.where->error(fmt::format("there are two tests \"{}\"", test.name));
    for (const VibrationTest& other : c.tests)
      if (share_a_file(test.name, other.name) || share_a_file(other.name, test.name))
        throw test.where->error(fmt::format("the tests \"{}\" and \"{}\" would have results in files of the same name",
                                            other.name, test.name));
    c.tests.push_back(std::move(test));
  }
  if (c.tests.empty()) throw root.error("there is no test; at least one [[test]] is required");
}

/// models = ["1", "2", "4b"]
void read_models(const ConfigTable& table, MassMaterialFit& fit) {
  const auto models = table.find("models");
  if (!models) return;
  if (table.has("structure"))
    throw models->error("\"structure\" names one model, \"models\" several: give one of them");
  for (const ConfigValue& entry : models->list()) {
    const std::string name(choose(entry, model_structures(), "mass-material model").name);
    if (std::ranges::count(fit.models, name) > 0) throw entry.error(fmt::format("model \"{}\" is listed twice", name));
    fit.models.push_back(name);
  }
  if (fit.models.empty()) throw models->error("the list of models is empty");
}

void read_fit(const ConfigTable& root, MassMaterialCase& c) {
  c.fit.structure = c.structure;
  if (!root.has("fit")) return;
  const ConfigTable table = root.table("fit");
  MassMaterialFit& fit = c.fit;
  read_stored(table, fit);
  if (const auto method = table.find("method"))
    fit.method = choose(*method, fit_methods(), "method of identification").name;
  if (const auto structure = table.find("structure"))
    fit.structure = choose(*structure, model_structures(), "mass-material model").name;
  read_models(table, fit);
  if (const auto order = table.find("kernel_order"); order && !(order->is_string() && order->string() == "auto"))
    fit.kernel_order = static_cast<int>(order->integer(
        fit.method == "ten_step" ? Range{1.0, 20.0, false, "\"auto\" or between 1 and 20"}
                                 : Range{0.0, 6.0, false, "\"auto\" or between 0 and 6 (\"ten_step\": up to 20)"}));
  if (const auto terms = table.find("ogden_terms")) {
    fit.ogden_terms = static_cast<int>(terms->integer());
    if (!c.sample) throw terms->error("Ogden's model needs the sample's length and area: [sample]");
  }
  if (fit.repeatability) require_schedule(c, table.at("repeatability"));
}

void read_analysis(const ConfigTable& root, MassMaterialCase& c) {
  if (!root.has("analysis")) return;
  const ConfigTable table = root.table("analysis");
  read_stored(table, c.analysis);
  read_stored(table, c.analysis.segments);
}

/// Only what is simulated needs it.
void read_sampling(const ConfigTable& root, MassMaterialCase& c) {
  if (!root.has("sampling")) return;
  const ConfigTable table = root.table("sampling");
  c.rate = table.quantity("rate");
  read_stored(table, c);
}

}  // namespace

Excitation read_excitation(const ConfigTable& excitation, const fs::path& directory, double rate,
                           std::vector<fs::path>& data_files) {
  if (rate == 0.0)
    throw excitation.error("a simulated test needs the samples per second: [sampling] rate, as in rate = \"6 kHz\"");
  Excitation read = type_of(excitation).read(excitation, directory, rate, data_files);
  if (read.band_high > highest_frequency(rate))
    throw excitation.error(fmt::format("the excitation reaches {} Hz; {} samples per second resolve up to {:.4g} Hz",
                                       read.band_high, rate, highest_frequency(rate)));
  return read;
}

MassMaterialCase read_mass_material_case(const ConfigTable& root, const fs::path& case_directory) {
  MassMaterialCase c = read_sample_model(root);
  c.title = root.line("title");
  c.card = read_sample_card(root);
  read_sampling(root, c);
  read_tests(root, case_directory, c);
  c.changes = read_sample_changes(root);
  read_fit(root, c);
  read_analysis(root, c);
  return c;
}

std::span<const ExcitationType> excitation_types() { return excitations; }

std::span<const FitMethod> fit_methods() { return methods; }

}  // namespace pfdm
