// Fits in which a jump of the force is a datum beside the curve.

#include "cases/program/fracture/page/fracture_report.h"
#include "tests/cases/broken_bar.h"
#include "tests/cases/page_data.h"

#include <gmock/gmock.h>

#include <cmath>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

// Equilibrium of the bar depends on toughness and modulus by u (E/Gc)^(1/2) alone: where it jumps gives Gc/E, to twice
// the relative error of the displacement, and the slope gives E.
TEST(EventFit, MeetsAJumpThatIsFoundInTheRecord) {
  const TemporaryCase directory(event_fit());
  const auto fit = fitted_to_broken_bar(directory);
  EXPECT_EQ(fit["verdict"], "sound") << fit["reasons"];
  ASSERT_EQ(fit["events"].size(), 1u);
  const auto& event = fit["events"][0];
  EXPECT_TRUE(event["found_in_record"].get<bool>());
  EXPECT_TRUE(event["in_computed_curve"].get<bool>());
  const auto& displacement = event_figure(event, "displacement");
  const double deviation = std::hypot(row_spacing, load_step) / std::sqrt(12.0);
  EXPECT_NEAR(displacement["measured"].get<double>(), broken_bar().jump, 0.6 * row_spacing);
  EXPECT_NEAR(displacement["deviation"].get<double>(), deviation, 0.02 * deviation);
  EXPECT_LT(std::abs(displacement["residual"].get<double>()), 2.0);
  EXPECT_TRUE(event_figure(event, "force_before")["residual"].is_null());
  const auto &modulus = parameter(fit, modulus_key), &toughness = parameter(fit, toughness_key);
  const double error_of_modulus = modulus["standard_error"].get<double>() / true_modulus;
  const double due = std::hypot(2.0 * deviation / broken_bar().jump, error_of_modulus);
  const double stated = toughness["standard_error"].get<double>() / true_toughness;
  EXPECT_GT(stated, 0.3 * due);  // what the curve bends before it jumps tells of Gc, too
  EXPECT_LT(stated, 1.2 * due);
  EXPECT_NEAR(modulus["estimate"].get<double>(), true_modulus, 2.5 * error_of_modulus * true_modulus);
  EXPECT_NEAR(toughness["estimate"].get<double>(), true_toughness, 2.5 * stated * true_toughness);
  // The rows on both sides of it are left out: half a spacing away.
  EXPECT_EQ(fit["residuals"].get<std::size_t>(), broken_bar().rows.column("force_N").size() - 2 + 1);
}

TEST(EventFit, IsSaidBeforeItIsMade) {
  const TemporaryCase directory(event_fit());
  broken_bar().write(directory);
  EXPECT_THAT(
      run({"check", directory.path().string()}).out,
      HasSubstr("jump at 11.88 um of one, found in the record: displacement 11.88 um, standard deviation 72 nm"));
}

TEST(EventFit, IsMarkedOnThePage) {
  const TemporaryCase directory(event_fit());
  fitted_to_broken_bar(directory);
  const Outcome outcome = run({"report", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = content_of(directory.results() / "report/index.html");
  for (const char* part : {"events, measured", "events, fitted", "jump at ", "residual [deviations]"})
    EXPECT_THAT(page, HasSubstr(part));
}

TEST(EventFit, HasAllThatOtherFitsHave) {
  std::string text = event_fit(
      "event = \"jump\"\nleast_fall = 0.3\nnumber = 1\n[[experiment.events]]\nevent = "
      "\"greatest_force\"\nforce = { value = \"19.3 N\", deviation = \"0.2 N\" }\n");
  text = replaced(text, "[fit]\n",
                  "[fit]\nintervals = \"posterior\"\nfiner = { \"loading.maximum_increment\" = 0.005, "
                  "\"loading.initial_increment\" = 0.005 }\n"
                  "coarse = { \"loading.maximum_increment\" = 0.02, \"loading.initial_increment\" = 0.02 }\n");
  const TemporaryCase directory(text);
  const auto fit = fitted_to_broken_bar(directory);
  ASSERT_EQ(fit["verdict"].get<std::string>().substr(0, 5), "sound") << fit["reasons"];
  EXPECT_EQ(fit["events"].size(), 2u);
  EXPECT_EQ(fit["events"][0]["name"], "jump 1");
  EXPECT_FALSE(fit["events"][1]["found_in_record"].get<bool>());
  for (const char* key : {modulus_key, toughness_key}) {
    const auto& p = parameter(fit, key);
    const double width = p["upper"].get<double>() - p["lower"].get<double>();
    EXPECT_NEAR(p["posterior"]["median"].get<double>(), p["estimate"].get<double>(), 0.4 * width) << key;
    EXPECT_TRUE(p.contains("moved_by_finer"));
  }
  const std::string sensitivity = content_of(directory.results() / "fit_sensitivity.csv");
  EXPECT_THAT(sensitivity, HasSubstr("displacement of jump 1 changes by "));
  EXPECT_THAT(sensitivity, HasSubstr("force of greatest force changes by "));
}

TEST(EventFit, IsNotSoundWithoutTheEvent) {
  // So tough that the bar does not break within the run.
  std::string text = replaced(event_fit(), toughness_bounds, "bounds = [\"320 J/m^2\", \"450 J/m^2\"]");
  text = replaced(replaced(text, "\"100 J/m^2\"", "\"350 J/m^2\""), "\"80 J/m^2\"", "\"280 J/m^2\"");
  const TemporaryCase directory(text);
  const auto fit = fitted_to_broken_bar(directory);
  EXPECT_FALSE(fit["verdict"].get<std::string>().starts_with("sound"));
  EXPECT_THAT(fit["reasons"].dump(), HasSubstr("the fitted curve lacks jump at "));
  EXPECT_FALSE(fit["events"][0]["in_computed_curve"].get<bool>());
  EXPECT_GT(event_figure(fit["events"][0], "displacement")["residual"].get<double>(), 10.0);
}

TEST(EventFit, IsNotSoundWithAnEventElsewhere) {
  const TemporaryCase directory(event_fit(
      "event = \"jump\"\nleast_fall = 0.3\ndisplacement = { value = \"11.875 um\", deviation = \"0.05 um\" }\n"
      "force_before = { value = \"8 N\", deviation = \"0.2 N\" }\n"));
  const auto fit = fitted_to_broken_bar(directory);
  EXPECT_EQ(fit["verdict"], "questionable");
  EXPECT_THAT(fit["reasons"].dump(), HasSubstr("has a computed force before of "));
}

TEST(EventFit, IsNotSoundWithLoadStepsThatAreTooLong) {
  const TemporaryCase directory(replaced(replaced(event_fit(), "initial_increment = 0.01", "initial_increment = 0.04"),
                                         "\nmaximum_increment = 0.01", "\nmaximum_increment = 0.04"));
  EXPECT_THAT(fitted_to_broken_bar(directory)["reasons"].dump(),
              HasSubstr("over the differences of the parameters, and lies within"));
}

TEST(EventFit, MeetsTheFirstDebonding) {
  const std::string event =
      "event = \"first_debonding\"\ndisplacement = { value = \"11.8 um\", deviation = \"0.1 um\" }\n";
  const TemporaryCase directory(event_fit(event) + crack_plane());
  const auto fit = fitted_to_broken_bar(directory);
  EXPECT_EQ(fit["verdict"], "sound") << fit["reasons"];
  EXPECT_TRUE(fit["events"][0]["in_computed_curve"].get<bool>());
  const std::string again = (directory.path() / "again").string();
  ASSERT_EQ(run({"run", (directory.results() / "case.fitted.toml").string(), "--quiet", "--output", again}).status, 0);
  const auto summary = nlohmann::json::parse(content_of(std::filesystem::path(again) / "summary.json"));
  EXPECT_NEAR(event_figure(fit["events"][0], "displacement")["computed"].get<double>(),
              0.5 * (summary["first_debonding_displacement_m"].get<double>() +
                     summary["first_debonding_displacement_after_m"].get<double>()),
              1e-10);
}

TEST(EventFit, IsNotSoundWhereNothingDebonds) {
  const TemporaryCase directory(
      event_fit("event = \"first_debonding\"\ndisplacement = { value = \"11.8 um\", deviation = \"0.1 um\" }\n"));
  EXPECT_THAT(fitted_to_broken_bar(directory)["reasons"].dump(), HasSubstr("nothing debonds in the fitted run"));
}

class BadEvent : public testing::TestWithParam<BadInput> {};

TEST_P(BadEvent, IsRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(event_fit(), GetParam().good, GetParam().bad));
  broken_bar().write(directory);
  for (const char* command : {"check", "fit"}) {
    const Outcome outcome = run({command, directory.path().string()});
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    for (const std::string& part : GetParam().message) EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  }
}

constexpr const char* good = "event = \"jump\"\nleast_fall = 0.3\n";
const BadInput bad_events[] = {
    {"no_deviation",
     "deviation = { column = \"deviation_N\" }\n",
     "",
     {"[experiment.events]", "events have standard deviations of their own, and \"one\" has none"}},
    {"deviation_of_rows_of_zero",
     "deviation = { column = \"deviation_N\" }",
     "deviation = { column = \"displacement_m\", unit = \"N\" }",
     {"[experiment.events]", "the standard deviation of \"one\" at 0 (SI), its point 1, is zero"}},
    {"unknown_event",
     good,
     "event = \"bang\"\n",
     {"\"bang\" is not an event of a curve (allowed: jump, greatest_force, first_debonding)"}},
    {"force_of_a_jump",
     good,
     "event = \"jump\"\nforce = { value = \"1 N\", deviation = \"1 N\" }\n",
     {"[experiment.events]", "\"force\""}},
    {"no_displacement",
     good,
     "event = \"jump\"\nforce_after = { value = \"1 N\", deviation = \"1 N\" }\n",
     {"a jump with forces needs its displacement, too"}},
    {"beyond_the_record",
     good,
     "event = \"jump\"\ndisplacement = { value = \"1 mm\", deviation = \"1 um\" }\n",
     {"[experiment.events] displacement: \"one\" was recorded between 0 m and 15 um"}},
    {"not_in_the_record",
     good,
     "event = \"jump\"\nnumber = 3\n",
     {"\"one\" has 1 such jump, no jump 3: its force falls by more than 10 % of the largest"}},
    {"greatest_force_of_noise", good, "event = \"greatest_force\"\n", {"state \"force\", \"displacement\" or both"}},
    {"fall_of_everything", good, "event = \"jump\"\nleast_fall = 1.0\n", {"least_fall: 1 must be above 0 and below 1"}},
    {"number_of_a_greatest_force",
     good,
     "event = \"greatest_force\"\nnumber = 2\nforce = { value = \"1 N\", deviation = \"1 N\" }\n",
     {"[experiment.events]", "number"}},
    {"debonding_without_displacement",
     good,
     "event = \"first_debonding\"\n",
     {"state its \"displacement\": no record of the force tells what debonds"}},
    {"no_specimen", good, "event = \"jump\"\nspecimen = \"two\"\n", {"\"two\" is not a specimen (allowed: one)"}},
    {"named_twice",
     good,
     "event = \"jump\"\nleast_fall = 0.3\n[[experiment.events]]\nevent = \"jump\"\nleast_fall = 0.3\n",
     {"this jump is named twice"}},
    {"jump_of_a_number_named_twice",
     good,
     "event = \"jump\"\nnumber = 1\ndisplacement = { value = \"11 um\", deviation = \"1 um\" }\n[[experiment.events]]\n"
     "event = \"jump\"\nnumber = 1\ndisplacement = { value = \"12 um\", deviation = \"1 um\" }\n",
     {"this jump is named twice"}},
    {"greatest_force_twice",
     good,
     "event = \"greatest_force\"\nforce = { value = \"19 N\", deviation = \"1 N\" }\n[[experiment.events]]\n"
     "event = \"greatest_force\"\nforce = { value = \"19 N\", deviation = \"1 N\" }\n",
     {"this greatest force is named twice"}},
    {"in_no_stage",
     "bounds = [\"20 J/m^2\", \"500 J/m^2\"]\n",
     "bounds = [\"20 J/m^2\", \"500 J/m^2\"]\n[[fit.stages]]\nname = \"elastic\"\nbetween = [\"0 um\", \"8 um\"]\n",
     {"[fit] stages",
      "jump at 11.88 um of \"one\", at 11.88 um of the specimen, lies between the displacements of no"}},
    {"beyond_the_load",
     "[loading]\n",
     "[loading]\nend = 0.7\n",
     {"[experiment.events]",
      "jump at 11.88 um of \"one\", at 11.88 um of the specimen, lies beyond the end of the load, 10.5 um"}},
    {"deviation_of_zero",
     good,
     "event = \"jump\"\ndisplacement = { value = \"10 um\", deviation = \"0 um\" }\n",
     {"deviation: \"0 um\" must be positive"}},
};
INSTANTIATE_TEST_SUITE_P(Inputs, BadEvent, testing::ValuesIn(bad_events),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pfdm::this_file
