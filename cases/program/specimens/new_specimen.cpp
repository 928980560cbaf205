#include "cases/program/specimens/new_specimen.h"

#include "cases/program/fracture/case/experiment_case.h"
#include "cases/program/fracture/case/reduction_case.h"
#include "cases/program/input/config/expression.h"
#include "cases/program/input/config/toml_document.h"
#include "cases/program/specimens/measured_record.h"
#include "cases/program/specimens/record_origin.h"
#include "cases/program/specimens/specimen_text.h"
#include "physics/error.h"
#include "physics/quantity_text.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

constexpr double least_share = 0.1;  // of the greatest force: the specimen still carries

/// What the records say, before the case is written.
struct RecordFindings {
  std::vector<StraightPart> straight{};
  std::vector<ReducedTest> reduced{};  ///< where the specimen has data reduction
  double reach = 0.0;                  ///< largest displacement of the tests [m]
};

std::string experiment_text(const std::vector<MeasuredRecord>& records, const std::string& straight_keys,
                            const std::string& reduction) {
  std::string text = "[experiment]\n" + straight_keys + "\n";
  if (!reduction.empty()) text += reduction + "\n";
  for (const MeasuredRecord& record : records) text += record.text + "\n";
  return text;
}

/// Largest displacement at which a method without crack lengths still holds [m]; 0 where there is none.
double last_reduced(const std::vector<ReducedTest>& tests) {
  double last = 0.0;
  for (const ReducedTest& test : tests)
    for (const ReducedByMethod& method : test.methods)
      if (method.name == "equivalent_crack" && !method.points.empty())
        last = std::max(last, test.origin + test.record.displacement[method.points.back().row]);
  return last;
}

/// Where the test is over [m]: behind it the specimen has failed.
double last_carried(const TestRecord& record, const StraightPart& straight) {
  std::size_t last = straight.row_of_greatest;
  for (std::size_t i = last; i < record.n_rows(); ++i)
    if (record.force[i] >= least_share * straight.greatest_force) last = i;
  return record.displacement[last];
}

StraightPart straight_part_of(const TestRecord& record, const fs::path& file) {
  try {
    return straight_part(record);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

RecordFindings findings_of(const std::string& text, const std::vector<fs::path>& files, bool has_reduction) {
  const Config config(text, "the record");
  RecordFindings found;
  std::vector<TestRecord> records;
  const auto settings = has_reduction ? read_reduction(config.root(), "/") : std::nullopt;
  if (settings)
    records = settings->records;
  else
    for (const SampledCurve& curve : specimen_curves(*read_experiment(config.root(), "/")))
      records.push_back({.displacement = curve.x, .force = curve.y});
  for (std::size_t i = 0; i < records.size(); ++i) {
    found.straight.push_back(straight_part_of(records[i], files[i]));
    found.reach = std::max(found.reach, last_carried(records[i], found.straight.back()));
  }
  if (settings) found.reduced = reduced_tests(*settings);
  if (const double last = last_reduced(found.reduced); last > 0.0) found.reach = last;
  return found;
}

double guessed(const SpecimenValue& value, const std::vector<ReducedTest>& tests) {
  double sum = 0.0;
  for (const ReducedTest& test : tests)
    sum += value.guess == "toughness" ? best_toughness(test) : constant_of(test, value.guess);
  return sum / static_cast<double>(tests.size());
}

void guess_all(const SpecimenFile& specimen, const RecordFindings& found, SpecimenWords& words, std::ostream& out) {
  if (found.reduced.empty()) return;
  for (const SpecimenValue& value : specimen.values) {
    if (value.guess.empty() || words.given.contains(value.name)) continue;
    guess(words, value, guessed(value, found.reduced));
    out << fmt::format("  {}: {} by data reduction, the first guess\n", value.name, words.texts[value.name]);
  }
}

std::string commented(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    result += (line.empty() ? "" : "# " + line) + "\n";
    at = end + 1;
  }
  return result;
}

std::vector<std::string> file_names(const std::vector<fs::path>& records) {
  std::vector<std::string> names;
  for (const fs::path& record : records) {
    std::string name = "data/" + record.filename().string();
    for (int n = 2; std::ranges::count(names, name) > 0; ++n)
      name = fmt::format("data/{}_{}{}", record.stem().string(), n, record.extension().string());
    names.push_back(name);
  }
  return names;
}

std::vector<MeasuredRecord> recognised_all(const SpecimenRequest& request, const std::vector<std::string>& files,
                                           const std::map<std::string, std::string>& columns, double share) {
  std::vector<MeasuredRecord> records;
  for (std::size_t i = 0; i < files.size(); ++i)
    records.push_back(recognised(request.records[i], files[i], fs::path(files[i]).stem().string(), columns, share));
  return records;
}

/// The same where the files are now.
std::vector<MeasuredRecord> in_place(std::vector<MeasuredRecord> records, const SpecimenRequest& request) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    const std::string named = fmt::format("csv = {}", quoted_toml(records[i].file));
    records[i].text.replace(records[i].text.find(named), named.size(),
                            fmt::format("csv = {}", quoted_toml(fs::absolute(request.records[i]).string())));
  }
  return records;
}

/// [experiment] of the records and what they say; none of both without records.
struct Measured {
  std::string text{};
  std::string straight{};  ///< keys of [experiment]
  RecordFindings found{};
  std::string offsets{};  ///< [[fit.parameters]] of what toes leave
};

Measured measured(std::vector<MeasuredRecord>& records, const SpecimenRequest& request, const std::string& reduction,
                  bool takes_toe) {
  std::string keys = "stiffness_between = [\"0 m\", \"1 m\"]\n";
  const auto read = [&] {
    return findings_of(experiment_text(in_place(records, request), keys, reduction), request.records,
                       !reduction.empty());
  };
  RecordFindings found = read();
  for (std::size_t i = 0; i < records.size(); ++i) add_toe(records[i], found.straight[i], takes_toe);
  keys = straight_keys(found.straight.front(), takes_toe);
  const std::string offsets = takes_toe ? offset_parameters(found.straight) : "";
  found = read();
  return {.straight = keys, .found = found, .offsets = offsets};
}

double share_of(const SpecimenFile& specimen) { return specimen.share.empty() ? 1.0 : evaluated(specimen.share, {}); }

/// [experiment.reduction] of a specimen. Comments of keys that --set gives, as "# young_modulus = ...", become keys.
std::string reduction_of(const SpecimenFile& specimen, const SpecimenWords& words) {
  std::string text = filled(specimen.reduction, words);
  for (const std::string& name : words.given) {
    const std::string key = fmt::format("\n# {} = ", name);
    if (const std::size_t at = text.find(key); at != std::string::npos) text.erase(at + 1, 2);
  }
  return text;
}

std::string unmeasured(const std::string& reduction, double share) {
  const MeasuredRecord example{.file = "data/record.csv",
                               .text =
                                   "[[experiment.specimens]]\nname = \"specimen 1\"\ncsv = \"data/record.csv\"\n"
                                   "displacement = { column = \"Displacement\", unit = \"mm\" }\n"
                                   "force = { column = \"Load\", unit = \"N\"" +
                                   (share == 1.0 ? std::string() : fmt::format(", factor = {:.9g}", share)) + " }\n",
                               .remarks = {}};
  return experiment_text({example}, "stiffness_between = [\"0.1 mm\", \"1 mm\"]\n", reduction);
}

std::string schema_line(const SpecimenRequest& request) {
  const fs::path schema = fs::weakly_canonical(request.cases / "case.schema.json");
  return fmt::format("#:schema {}\n",
                     schema.lexically_relative(fs::weakly_canonical(fs::absolute(request.directory))).string());
}

void write_all(const SpecimenRequest& request, const std::vector<std::string>& files, const std::string& text,
               const std::string& readme) {
  make_folder(request.directory);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const fs::path place = request.directory / files[i];
    make_folder(place.parent_path());
    write_file(place, read_file(request.records[i]));
  }
  const std::string name = fs::weakly_canonical(fs::absolute(request.directory)).filename().string();
  write_file(request.directory / "README.md", fmt::format("# {}\n\n{}", name, readme));
  write_file(request.directory / "case.toml", text);
}

/// What the records say: first guesses and numbers of `words`, sentences on `said`.
Measured measured_or_none(const SpecimenFile& specimen, const SpecimenRequest& request,
                          const std::vector<std::string>& files, const std::map<std::string, std::string>& columns,
                          SpecimenWords& words, std::ostream& said) {
  Measured test;
  double straight_end = 0.0;
  if (!files.empty()) {
    std::vector<MeasuredRecord> records = recognised_all(request, files, columns, share_of(specimen));
    test = measured(records, request, reduction_of(specimen, words), specimen.takes_toe);
    for (const MeasuredRecord& record : records)
      for (const std::string& remark : record.remarks) said << fmt::format("  {}: {}\n", record.file, remark);
    guess_all(specimen, test.found, words, said);
    test.text = experiment_text(records, test.straight, reduction_of(specimen, words));  // with what was guessed
    straight_end = straight_to * test.found.straight.front().reach();
  }
  words.numbers["has_record"] = files.empty() ? 0.0 : 1.0;
  words.numbers["reach"] = test.found.reach;
  words.numbers["straight_end"] = straight_end;
  return test;
}

/// Values that neither the user nor a record gave: those of the specimen that the file describes.
std::string line_of_defaults(const SpecimenFile& specimen, const SpecimenWords& words) {
  std::vector<std::string> taken;
  for (const SpecimenValue& value : specimen.values)
    if (!words.given.contains(value.name) && words.texts.at(value.name) == value.text)
      taken.push_back(fmt::format("{} {}", value.name, value.text));
  if (taken.empty()) return "";
  return fmt::format("  not given, so taken as usual: {} (--set NAME=VALUE gives them)\n", fmt::join(taken, ", "));
}

}  // namespace

void make_specimen(const SpecimenRequest& request, std::ostream& out) {
  const SpecimenFile specimen = read_specimen_file(request.cases, request.specimen);
  std::map<std::string, std::string> columns;
  SpecimenWords words = specimen_words(specimen, request.set, column_words(), columns);
  const std::vector<std::string> files = file_names(request.records);
  if (files.empty() && !columns.empty())
    throw InputError(
        fmt::format("--set {}: there is no record whose column it is; --data FILE names one", columns.begin()->first));
  std::ostringstream said;
  const Measured test = measured_or_none(specimen, request, files, columns, words, said);
  derive(specimen, words);
  const std::string fit = filled(specimen.fit_text, words);
  const std::string text =
      schema_line(request) + filled(specimen.case_text, words) + "\n" +
      (files.empty() ? "# With a record of the test in data/, without the signs of comment:\n\n" +
                           commented(unmeasured(reduction_of(specimen, words), share_of(specimen)) + fit)
                     : test.text + fit + test.offsets);
  write_all(request, files, text, filled(specimen.readme, words));
  const std::string place = request.directory.string();
  out << fmt::format("made {} of {} ({}): case.toml, README.md", place, specimen.name, specimen.standard);
  for (const std::string& file : files) out << ", " << file;
  out << '\n' << said.str() << line_of_defaults(specimen, words) << lines_of_doubts(specimen, words);
  if (files.empty())
    out << fmt::format("next: {0} run {1}\n", request.called_as, place);
  else
    out << fmt::format("next: {0} fit {1}\n      {0} cohesive {1}/results/case.fitted.toml --export abaqus\n",
                       request.called_as, place);
}

void list_specimens(const fs::path& cases, std::ostream& out) {
  for (const std::string& name : specimen_names(cases)) {
    const SpecimenFile specimen = read_specimen_file(cases, name);
    out << fmt::format("{:<24} {} ({})\n", name, specimen.title, specimen.standard);
    list_specimen_values(cases, name, out);
  }
  out << "\nas in: pfdm init my_test --specimen double_cantilever_beam --data record.csv --set \"width=20 mm\"\n";
}

void list_specimen_values(const fs::path& cases, const std::string& name, std::ostream& out) {
  for (const SpecimenValue& value : read_specimen_file(cases, name).values)
    out << fmt::format("    {:<20} {:<12} {}{}\n", value.name, value.text, value.what,
                       value.guess.empty() ? "" : " With a record: by data reduction.");
}

}  // namespace pfdm
