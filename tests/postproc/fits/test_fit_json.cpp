#include "physics/error.h"
#include "postproc/fits/fit_json.h"
#include "postproc/point/endochronic_fit.h"
#include "postproc/vibration/vibration_fit.h"
#include "tests/postproc/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <set>

namespace pfdm::test::this_file {
namespace {

using ::testing::HasSubstr;

FitReport example() {
  FitReport report{.case_name = "a case",
                   .case_hash = "0123",
                   .version = "1.0",
                   .method = "joint",
                   .wall_seconds = 2.5,
                   .confidence = 0.9,
                   .found = {.converged = true,
                             .message = "done",
                             .parameters = {{.name = "E",
                                             .unit = "Pa",
                                             .estimate = 3e9,
                                             .standard_error = 1e8,
                                             .lower = 2.8e9,
                                             .upper = 3.2e9,
                                             .first_guess = 1e9,
                                             .at_bound = true}}},
                   .experiments = {},
                   .own = {}};
  report.experiments.push_back(
      experiment_misfit("one", 12, {.rms = 0.5, .rms_measured = 10.0, .quantity = "force", .unit = "N"}, "c.csv"));
  report.experiments.push_back({.name = "two", .fitted = false, .n_data = 3, .relative = 0.25});
  return report;
}

nlohmann::json written(const FitReport& report) {
  const TemporaryFolder folder;
  write_fit_json(folder / "fit.json", report);
  return nlohmann::json::parse(content_of(folder / "fit.json"));
}

TEST(FitJson, ComesBackAsItWasWritten) {
  const TemporaryFolder folder;
  FitReport report = example();
  report.own = own_findings(VibrationFindings{.structure = "4b",
                                              .passivity = {},
                                              .orders = {},
                                              .modulus = {{100.0, 3e6, 2e5}},
                                              .ogden = OgdenFit{.terms = {{1e5, 2.0}}},
                                              .repeats = {}});
  write_fit_json(folder / "fit.json", report);
  const FitReport back = read_fit_json(folder / "fit.json");
  EXPECT_EQ(back.case_hash, "0123");
  EXPECT_EQ(back.confidence, 0.9);
  ASSERT_EQ(back.found.parameters.size(), 1U);
  EXPECT_EQ(back.found.parameters[0].upper, 3.2e9);
  EXPECT_TRUE(back.found.parameters[0].at_bound);
  ASSERT_EQ(back.experiments.size(), 2U);
  EXPECT_EQ(back.experiments[0].relative, 0.05);
  EXPECT_EQ(back.experiments[0].absolute->rms, 0.5);
  EXPECT_FALSE(back.experiments[1].fitted);
  EXPECT_FALSE(back.experiments[1].absolute);
  const auto own = vibration_findings(back.own);
  ASSERT_TRUE(own);
  EXPECT_EQ(own->structure, "4b");
  EXPECT_EQ(own->modulus[0].loss, 2e5);
  EXPECT_EQ(own->ogden->terms[0].alpha, 2.0);
}

TEST(FitJson, TellsOfEventsAndTheirSetUp) {
  const TemporaryFolder folder;
  FitReport report = example();
  report.events = {{.name = "jump 1",
                    .specimen = "one",
                    .is_there = true,
                    .set_up = {.offset = 1e-6, .force_offset = 0.5, .compliance = 2e-7},
                    .figures = {{.name = "displacement", .unit = "m", .computed = 3e-6}}}};
  write_fit_json(folder / "fit.json", report);
  const FitReport back = read_fit_json(folder / "fit.json");
  ASSERT_EQ(back.events.size(), 1U);
  EXPECT_EQ(back.events[0].set_up, report.events[0].set_up);
  EXPECT_EQ(back.events[0].figure("displacement", &FittedEvent::Figure::computed), 3e-6);
}

TEST(FitJson, HasTheSameFieldsForEveryKind) {
  FitReport report = example();
  std::vector<std::set<std::string>> fields;
  for (const OwnFindings& own :
       {own_findings(FractureFindings{}), own_findings(EndochronicFindings{}), own_findings(VibrationFindings{})}) {
    report.own = own;
    const nlohmann::json json = written(report);
    const std::string kind = json["kind"];
    EXPECT_TRUE(json[kind].is_object()) << kind;
    std::set<std::string>& names = fields.emplace_back();
    for (const auto& [name, value] : json.items())
      if (name != kind) names.insert(name);
  }
  EXPECT_EQ(fields[0], fields[1]);
  EXPECT_EQ(fields[0], fields[2]);
}

TEST(FitJson, TellsVibrationFindingsOfNoOtherKind) {
  EXPECT_FALSE(vibration_findings(own_findings(FractureFindings{})));
  EXPECT_THAT(message_of<InputError>([] { vibration_findings({.kind = "mass_material", .json = "{}"}); }),
              HasSubstr("no findings of a mass-material fit"));
}

TEST(FitJson, WritesWhatIsNotKnownAsNull) {
  FitReport report = example();
  report.found.parameters[0].first_guess = std::nan("");
  const auto parameter = written(report)["parameters"][0];
  EXPECT_TRUE(parameter["first_guess"].is_null());
  EXPECT_TRUE(parameter["upper_bound"].is_null());
}

TEST(FitJson, RefusesAnotherFormat) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    put(folder / "fit.json", text);
    return message_of<InputError>([&] { read_fit_json(folder / "fit.json"); });
  };
  EXPECT_THAT(message("{\"case\": \"old\"}"),
              HasSubstr("fit.json: the file has format 0, this version reads format 1"));
  EXPECT_THAT(message("{\"format\": 1}"), HasSubstr("this is not a fit"));
  EXPECT_THAT(message("no such thing"), HasSubstr("this is not a fit"));
  EXPECT_THAT(message("{\"format\": 1e300}"), HasSubstr("this is not a fit: 1e+300 is not a whole number of at least"));
}

}  // namespace
}  // namespace pfdm::test::this_file
