// Fits of displacements measured on a face, against closed forms.

#include "tests/cases/field_plate.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;
using namespace field_plate;

const char* const files = "files = [\"frame_0.csv\", \"frame_1.csv\"]\nat = [\"12 um\", \"20 um\"]\n";

struct Estimate {
  double value = 0.0, error = 0.0;
};

/// Of Poisson's ratio, the only unknown of u = e x, v = -nu e y but for the rigid motions: least squares by hand.
Estimate ratio_by_hand(const std::vector<std::vector<Point>>& frames) {
  double product = 0.0, square = 0.0;
  const std::vector<double> displacements{0.012, 0.020};
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const double e = displacements[f] / length, n = static_cast<double>(frames[f].size());
    Point mean{0, 0, 0, 0};
    for (const Point& p : frames[f]) mean.x += p.x / n, mean.y += p.y / n, mean.u += p.u / n, mean.v += p.v / n;
    double turn_turn = 0.0, turn_g = 0.0, turn_d = 0.0, g_d = 0.0, g_g = 0.0;
    for (const Point& p : frames[f]) {
      const double x = p.x - mean.x, y = p.y - mean.y, g = -e * y, du = p.u - mean.u - e * x, dv = p.v - mean.v;
      turn_turn += x * x + y * y;
      turn_g += x * g;
      turn_d += x * dv - y * du;
      g_d += g * dv;
      g_g += g * g;
    }
    product += g_d - turn_g * turn_d / turn_turn;
    square += g_g - turn_g * turn_g / turn_turn;
  }
  return {product / square, noise / std::sqrt(square)};
}

// Of a plate that is drawn by a given displacement the field gives Poisson's ratio and nothing of the modulus, which
// the force gives alone.
TEST(FieldFit, HasTheRatioOfTheFieldAndTheModulusOfTheForce) {
  const TemporaryCase directory(plate);
  const auto frames = measured(11);
  write(directory, frames);
  const auto fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "sound") << fit["reasons"];
  const auto &modulus = fit["parameters"][0], &ratio = fit["parameters"][1];
  const Estimate due = ratio_by_hand(frames);
  EXPECT_NEAR(ratio["estimate"].get<double>(), due.value, 0.1 * due.error);
  EXPECT_NEAR(ratio["standard_error"].get<double>(), due.error, 0.05 * due.error);  // of noise that is not stated
  EXPECT_NEAR(ratio["estimate"].get<double>(), true_ratio, 3.0 * due.error);
  // 20 forces of 7 N deviation: E to 7 N over the root of the sum of their squares.
  double squares = 0.0;
  for (int i = 1; i <= 20; ++i) squares += std::pow(1e-6 * plate_modulus * 1e-3 * i / length * height, 2);
  EXPECT_NEAR(modulus["standard_error"].get<double>(), plate_modulus * 7.0 / std::sqrt(squares),
              0.03 * plate_modulus * 7.0 / std::sqrt(squares));
  EXPECT_NEAR(fit["correlation"][0][1].get<double>(), 0.0, 0.05);
  const auto& field = fit["fields"][0];
  EXPECT_NEAR(field["deviation_m"].get<double>(), 1e-3 * noise, 0.07e-3 * noise);
  EXPECT_EQ(field["frames"].size(), 2u);
  EXPECT_NEAR(field["frames"][1]["rms_misfit_m"].get<double>(), 1e-3 * noise, 0.1e-3 * noise);
  EXPECT_EQ(field["data"].get<int>(), 2 * (2 * 21 * 11 - 3));
  EXPECT_THAT(read_file(directory.results() / "fit_field_0.csv"), HasSubstr("residual_y_m"));
  const Outcome report = run({"report", directory.path().string()});
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_THAT(content_of(directory.results() / "report/index.html"), HasSubstr("computed less measured"));
}

TEST(FieldFit, NamesAWrongScale) {
  const TemporaryCase directory(plate);
  write(directory, measured(12, 1.05));
  const auto fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "questionable");
  EXPECT_THAT(fit["reasons"].dump(), HasSubstr("see its \\\"unit\\\", \\\"pixel\\\" and \\\"factor\\\""));
}

TEST(FieldFit, LeavesOutliersOut) {
  auto frames = measured(13);
  const Estimate due = ratio_by_hand(frames);
  for (std::size_t i = 5; i < frames[0].size(); i += 37) frames[0][i].u += 0.02, frames[1][i].v -= 0.01;
  const TemporaryCase directory(plate);
  write(directory, frames);
  const auto fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "sound") << fit["reasons"];
  EXPECT_NEAR(fit["parameters"][1]["estimate"].get<double>(), due.value, 0.5 * due.error);
}

TEST(FieldFit, ReadsPixelsAndFramesOfOneFile) {
  const auto frames = measured(14);
  std::string text = "frame,image,COORDINATE_X,COORDINATE_Y,DISPLACEMENT_X,DISPLACEMENT_Y\n";
  for (std::size_t k = 0; k < 2; ++k)
    for (const Point& p : frames[k])  // 50 um a pixel; y of the image points down
      text +=
          fmt::format("{},{},{},{},{},{}\n", k + 1, k == 0 ? 12 : 20, p.x / 0.05, -p.y / 0.05, p.u / 0.05, -p.v / 0.05);
  const TemporaryCase directory(
      replaced(plate, "files = [\"frame_0.csv\", \"frame_1.csv\"]\nat = [\"12 um\", \"20 um\"]\n",
               "files = [\"all.csv\"]\nframe = \"frame\"\nunit = \"px\"\npixel = \"50 um\"\n"
               "plane = { y = [0, -1, 0] }\nmatched = { column = \"image\", curve_column = \"u\" }\n"));
  write(directory, frames);
  directory.write("all.csv", text);
  const auto fit = fitted(directory);
  EXPECT_EQ(fit["verdict"], "sound") << fit["reasons"];
  EXPECT_NEAR(fit["parameters"][1]["estimate"].get<double>(), ratio_by_hand(frames).value, 1e-4);
  EXPECT_NEAR(fit["fields"][0]["frames"][0]["displacement_m"].get<double>(), 12e-6, 1e-12);
}

// A frame without noise in it, and one taken before the run begins, which the model has no displacements for.
TEST(FieldFit, LeavesOutTheReferenceAndWhatIsBeforeTheRun) {
  const TemporaryCase directory(
      replaced(plate, files,
               "files = [\"reference.csv\", \"frame_0.csv\", \"frame_0.csv\", \"frame_1.csv\"]\n"
               "at = [\"0 um\", \"-12 um\", \"12 um\", \"20 um\"]\n"));
  write(directory, measured(21));
  directory.write("reference.csv", "X [mm],Y [mm],U [mm],V [mm]\n1,2,0,0\n2,2,0,0\n2,3,0,0\n5,6,0,0\n");
  const Outcome outcome = run({"fit", directory.path().string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err + outcome.out, HasSubstr("1 frames left out: all their displacements are equal"));
  EXPECT_THAT(outcome.err + outcome.out, HasSubstr("1 frames left out: they were taken before the run begins"));
  const auto fit = nlohmann::json::parse(read_file(directory.results() / "fit.json"));
  EXPECT_EQ(fit["fields"][0]["frames"].size(), 2u);
  EXPECT_EQ(fit["verdict"], "sound") << fit["reasons"];
}

// The factor of a column turns what the file has, before the origin of the curve (toe) is taken off.
TEST(FieldFit, TakesTheFactorOfAColumnBeforeTheOrigin) {
  const std::string with_toe = replaced(plate, "name = \"one\"\n", "name = \"one\"\ntoe = [\"2 um\", \"15 um\"]\n");
  const auto frames = measured(22);
  const TemporaryCase stated(with_toe);
  write(stated, frames);
  std::string text = "frame,image,X,Y,U,V\n";
  for (std::size_t k = 0; k < 2; ++k)
    for (const Point& p : frames[k])
      text += fmt::format("{},{},{},{},{},{}\n", k + 1, k == 0 ? -12 : -20, p.x, p.y, p.u, p.v);
  const TemporaryCase by_column(replaced(with_toe, files,
                                         "files = [\"all.csv\"]\nframe = \"frame\"\nunit = \"mm\"\n"
                                         "displacement = { column = \"image\", unit = \"um\", factor = -1 }\n"));
  write(by_column, frames);
  by_column.write("all.csv", text);
  const auto due = fitted(stated)["fields"][0]["frames"], found = fitted(by_column)["fields"][0]["frames"];
  ASSERT_EQ(found.size(), due.size());
  for (std::size_t k = 0; k < due.size(); ++k)
    EXPECT_NEAR(found[k]["displacement_m"].get<double>(), due[k]["displacement_m"].get<double>(), 1e-12);
}

// Of a body a fiftieth as far drawn the stages end within a micrometre of each other: each has its own part of a run.
TEST(FieldFit, HasThePartOfTheRunOfEachStage) {
  std::string small = replaced(plate, "\"20 um\", \"free\"", "\"0.4 um\", \"free\"");
  small = replaced(small, "[\"2 um\", \"15 um\"]", "[\"0.04 um\", \"0.3 um\"]");
  small = replaced(small, "at = [\"12 um\", \"20 um\"]", "at = [\"0.24 um\", \"0.4 um\"]\ndeviation = \"0.002 um\"");
  small +=
      "[[fit.stages]]\nname = \"a\"\nbetween = [\"0 um\", \"0.27 um\"]\n"
      "parameters = [\"materials.alu.young_modulus\"]\n"
      "[[fit.stages]]\nname = \"b\"\nbetween = [\"0 um\", \"0.4 um\"]\n"
      "parameters = [\"materials.alu.young_modulus\", \"materials.alu.poisson_ratio\"]\n";
  const TemporaryCase directory(small);
  auto frames = measured(23);
  for (auto& frame : frames)
    for (Point& p : frame) p.u *= 0.02, p.v *= 0.02;
  write(directory, frames);
  std::string curve = "u,f,deviation\n";
  for (int i = 1; i <= 20; ++i)
    curve += fmt::format("{},{},0.14\n", 0.02 * i, 1e-6 * plate_modulus * 2e-5 * i / length * height);
  directory.write("curve.csv", curve);
  const auto fit = fitted(directory);
  EXPECT_NEAR(fit["parameters"][1]["estimate"].get<double>(), true_ratio, 0.01);
}

struct BadField {
  const char* name;
  const char *good, *bad;
  const char* message;
};
void PrintTo(const BadField& field, std::ostream* stream) { *stream << field.name; }

class BadDisplacementFields : public testing::TestWithParam<BadField> {};

TEST_P(BadDisplacementFields, AreRefusedWithOneMessage) {
  const TemporaryCase directory(replaced(plate, GetParam().good, GetParam().bad));
  write(directory, measured(15));
  directory.write("bare.csv", "x,y,u,v\n1,2,0.1,0.1\n2,2,0.1,0.1\n2,3,0.1,0.1\n");
  directory.write("few.csv", "x_mm,y_mm,u_mm,v_mm\n1,2,0.1,0.1\n2,2,0.1,0.1\n2,3,,\n");
  directory.write("other.csv", "x_mm,y_mm,ex,ey\n1,2,0.1,0.1\n2,2,0.1,0.1\n2,3,1,1\n");
  directory.write("deep.csv", "x_mm,y_mm,u_mm,v_mm,w_mm\n1,2,0.1,0.1,0\n2,2,0.1,0.2,0\n2,3,1,1,0\n");
  directory.write("flat.csv", "x_mm,y_mm,u_mm,v_mm\n1,2,0.1,0.1\n2,2,0.1,0.2\n2,3,1,1\n4,5,1,1\n");
  directory.write("bare_curve.csv", "u,f\n1,35\n2,70\n20,700\n");
  directory.write("pixels.csv", "x [px],y [px],u [px],v [px]\n1,2,0.1,0.1\n2,2,0.1,0.1\n2,3,1,1\n");
  for (const char* command : {"check", "fit"}) {
    const Outcome outcome = run({command, directory.path().string()});
    EXPECT_EQ(outcome.status, 2) << outcome.out;
    EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadDisplacementFields,
    testing::Values(
        BadField{"outside", "at = [", "plane = { origin = [\"40 mm\", \"0 mm\", \"0 mm\"] }\nat = [",
                 "all points of \"front\" lie outside of the body, the nearest by 20 mm"},
        BadField{"no_unit", files, "files = [\"bare.csv\"]\nat = [\"12 um\"]\n",
                 "does not say in which unit column \"x\""},
        BadField{"no_pixel", files, "files = [\"pixels.csv\"]\nat = [\"12 um\"]\n",
                 "say with \"pixel\" how long one is"},
        BadField{"two_points", files, "files = [\"few.csv\"]\nat = [\"12 um\"]\n",
                 "no frame has three points with values or more"},
        BadField{"no_column", files, "files = [\"other.csv\"]\nat = [\"12 um\"]\n",
                 "no column of the file is known as \"u\""},
        BadField{"frames_and_entries", "at = [\"12 um\", \"20 um\"]", "at = [\"12 um\"]",
                 "there are 2 frames, and 1 entries"},
        BadField{"no_match", "at = [\"12 um\", \"20 um\"]", "matched = { curve_column = \"f\" }",
                 "no frame has a row in the file of \"one\""},
        BadField{"no_force", "at = [\"12 um\", \"20 um\"]", "at = [\"12 kN\", \"20 um\"]",
                 "\"one\" does not reach this force"},
        BadField{"no_row", "at = [\"12 um\", \"20 um\"]", "rows = [2, 99]", "the file of \"one\" has 20 rows"},
        BadField{"no_time", "at = [\"12 um\", \"20 um\"]", "", "no frame has a displacement of the curve"},
        BadField{"two_ways", "at = [", "rows = [2, 3]\nat = [", "there are several ways"},
        BadField{"oblique", "at = [", "plane = { x = [1, 0, 0], y = [1, 1, 0] }\nat = [", "must be at right angles"},
        BadField{"no_force_noise", "deviation = { column = \"deviation\", unit = \"N\" }\n", "",
                 "give [[experiment.specimens]] deviation"},
        BadField{"no_force_noise_of_another", "[[experiment.fields]]\n",
                 "[[experiment.specimens]]\nname = \"two\"\ncsv = \"bare_curve.csv\"\n"
                 "displacement = { column = \"u\", unit = \"um\" }\nforce = { column = \"f\", unit = \"N\" }\n"
                 "[[experiment.fields]]\nspecimen = \"one\"\n",
                 "beside the rows of \"two\" is not known; give [[experiment.specimens]] deviation"},
        BadField{"some_with_w", files, "files = [\"deep.csv\", \"flat.csv\"]\nat = [\"12 um\", \"20 um\"]\n",
                 "one has displacements along z (w) and the other has none"},
        BadField{"too_few_for_noise", files, "files = [\"flat.csv\"]\nat = [\"12 um\"]\ndrop_outliers = false\n",
                 "has 5 data, and fewer than 20 do not tell their noise: state it by \"deviation\""},
        BadField{"unknown_key", "at = [", "frequency = 3\nat = [", "\"frequency\" is not known here"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pfdm::this_file
