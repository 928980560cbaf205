// Fits of displacements measured on a face, against closed forms.

#include "postproc/files/text_file.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace pfdm::this_file {
namespace {

using ::testing::HasSubstr;

constexpr double length = 20.0, height = 10.0;                          // of a plate 1 mm thick [mm]
constexpr double true_modulus = 70e9, true_ratio = 0.33, noise = 1e-4;  // of displacements [mm]

const std::string plate = R"(
kind = "fracture"
title = "Plate in plane stress"
mesh.generator = "box_hexes"
mesh.x = [{ length = "20 mm", cells = 8 }]
mesh.y = [{ length = "10 mm", cells = 4 }]
mesh.z = [{ length = "1 mm", cells = 1 }]
mesh.region = "plate"
boundary = [
  { patch = "xmin", displacement = ["0 mm", "free", "free"] },
  { patch = "xmax", displacement = ["20 um", "free", "free"] },
  { patch = "ymin", type = "symmetry" },
  { patches = ["zmin", "zmax"], type = "plane_stress" },
]
fracture.split = "none"
loading.initial_increment = 0.25
loading.maximum_increment = 0.25
output.curve = { patch = "xmax", component = "x" }
[materials.alu]
regions = ["plate"]
young_modulus = "60 GPa"
poisson_ratio = 0.25
damageable = false
[experiment]
stiffness_between = ["2 um", "15 um"]
[[experiment.specimens]]
name = "one"
csv = "curve.csv"
displacement = { column = "u", unit = "um" }
force = { column = "f", unit = "N" }
deviation = { column = "deviation", unit = "N" }
[[experiment.fields]]
name = "front"
files = ["frame_0.csv", "frame_1.csv"]
at = ["12 um", "20 um"]
[[fit.parameters]]
key = "materials.alu.young_modulus"
bounds = ["10 GPa", "200 GPa"]
[[fit.parameters]]
key = "materials.alu.poisson_ratio"
bounds = [0.05, 0.45]
)";

struct Point {
  double x, y, u, v;  // [mm]
};

/// Uniaxial tension with noise, moved as a rigid body: u = e x, v = -nu e y.
std::vector<std::vector<Point>> measured(unsigned seed, double scale = 1.0) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<std::vector<Point>> frames;
  for (const double displacement : {0.012, 0.020}) {
    const double e = displacement / length, a = 0.05 * normal(engine), b = 0.05 * normal(engine),
                 turn = 1e-3 * normal(engine);
    auto& frame = frames.emplace_back();
    for (int i = 0; i < 21; ++i)
      for (int j = 0; j < 11; ++j) {
        const double x = i, y = j;
        frame.push_back({x, y, scale * e * x + a - turn * y + noise * normal(engine),
                         -scale * true_ratio * e * y + b + turn * x + noise * normal(engine)});
      }
  }
  return frames;
}

void write(const TemporaryCase& directory, const std::vector<std::vector<Point>>& frames,
           const std::string& names = "X [mm],Y [mm],U [mm],V [mm]") {
  std::string curve = "u,f,deviation\n";
  std::mt19937 engine(5);
  std::normal_distribution<double> normal(0.0, 7.0);
  for (int i = 1; i <= 20; ++i)
    curve += fmt::format("{},{},7\n", i, 1e-6 * true_modulus * 1e-3 * i / length * height + normal(engine));
  directory.write("curve.csv", "# SYNTHETIC, made by the test\n" + curve);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::string text = "# SYNTHETIC, made by the test\n" + names + "\n";
    for (const Point& p : frames[k]) text += fmt::format("{},{},{},{}\n", p.x, p.y, p.u, p.v);
    text += "3.5,4.5,,\n4.5,4.5,NaN,NaN\n";  // not correlated
    directory.write(fmt::format("frame_{}.csv", k), text);
  }
}

nlohmann::json fitted(const TemporaryCase& directory) {
  const Outcome outcome = run({"fit", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  return nlohmann::json::parse(read_file(directory.results() / "fit.json"));
}

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
  for (int i = 1; i <= 20; ++i) squares += std::pow(1e-6 * true_modulus * 1e-3 * i / length * height, 2);
  EXPECT_NEAR(modulus["standard_error"].get<double>(), true_modulus * 7.0 / std::sqrt(squares),
              0.03 * true_modulus * 7.0 / std::sqrt(squares));
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
  directory.write("pixels.csv", "x [px],y [px],u [px],v [px]\n1,2,0.1,0.1\n2,2,0.1,0.1\n2,3,1,1\n");
  for (const char* command : {"check", "fit"}) {
    const Outcome outcome = run({command, directory.path().string()});
    EXPECT_EQ(outcome.status, 2) << outcome.out;
    EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
  }
}

const char* const files = "files = [\"frame_0.csv\", \"frame_1.csv\"]\nat = [\"12 um\", \"20 um\"]\n";

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
        BadField{"unknown_key", "at = [", "frequency = 3\nat = [", "\"frequency\" is not known here"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pfdm::this_file
