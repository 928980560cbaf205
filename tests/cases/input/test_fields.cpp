// Fields out of files in place of formulas: they do the same, follow lists of frames, and say what is wrong with them.

#include "mesh/files/field_file.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace pfdm::this_file {
namespace {

constexpr const char* poisson_ratio = "poisson_ratio = 0.2\n";

// Elastic, between rigid ends, at a change of temperature.
std::string held_bar(const std::string& change) {
  std::string text = replaced(bar_case(), "frames_at = [\"0.006 mm\"]\n", "");
  text = replaced(text, "\"0.015 mm\"", "\"0 mm\"");
  text = replaced(text, poisson_ratio, std::string(poisson_ratio) + "damageable = false\nexpansion = \"1e-5 1/K\"\n");
  return text + "[loads]\ntemperature_change = " + change + "\n";
}

nlohmann::json summary_of(const TemporaryCase& directory) {
  const Outcome outcome = run({"run", directory.path().string(), "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(content_of(directory.results() / "summary.json"));
}

double final_force(const TemporaryCase& directory) { return summary_of(directory).at("final_force_N").get<double>(); }

double force_by_formula(const std::string& formula) {
  return final_force(TemporaryCase(held_bar("{ expr = \"" + formula + "\", unit = \"K\" }")));
}

/// A grid of n x m quadrilaterals in the plane z = 0, its points by `place` of 0 to 1 and 0 to 1, T at them.
template <class Place, class Value>
std::string flat_grid(int n, int m, const Place& place, const Value& value) {
  std::string points, values, cells, offsets, types;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) {
      const auto [x, y] = place(static_cast<double>(i) / n, static_cast<double>(j) / m);
      points += fmt::format("{} {} 0 ", x, y);
      values += fmt::format("{} ", value(x, y));
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const int p = i * (m + 1) + j;
      cells += fmt::format("{} {} {} {} ", p, p + m + 1, p + m + 2, p + 1);
      offsets += fmt::format("{} ", 4 * (i * m + j + 1));
      types += "9 ";
    }
  const auto array = [](const char* attributes, const std::string& numbers) {
    return fmt::format("<DataArray format=\"ascii\" {}>{}</DataArray>\n", attributes, numbers);
  };
  return fmt::format(
             "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n"
             "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\"><Points>\n",
             (n + 1) * (m + 1), n * m) +
         array("type=\"Float64\" NumberOfComponents=\"3\"", points) + "</Points><Cells>\n" +
         array("type=\"Int32\" Name=\"connectivity\"", cells) + array("type=\"Int32\" Name=\"offsets\"", offsets) +
         array("type=\"UInt8\" Name=\"types\"", types) + "</Cells><PointData>\n" +
         array("type=\"Float64\" Name=\"T\"", values) + "</PointData></Piece></UnstructuredGrid></VTKFile>\n";
}

/// About the bar, in mm.
std::string heated_bar(double at_end) {
  return flat_grid(
      7, 3, [](double a, double b) { return std::pair(-1.0 + 22.0 * a, -1.0 + 3.0 * b); },
      [&](double x, double) { return at_end * x / 20.0; });
}

TEST(Fields, DoWhatTheirFormulaDoes) {
  const double force = force_by_formula("2e3*x*t");
  const TemporaryCase mesh(held_bar("{ file = \"t.vtu\", array = \"T\", unit = \"K\", length_unit = \"mm\" }"));
  mesh.write("t.vtu", heated_bar(40.0));
  EXPECT_NEAR(final_force(mesh) / force, 1.0, 1e-12);
  // Temperatures in place of changes of it, in columns with units.
  const TemporaryCase points(
      held_bar("{ csv = \"t.csv\", column = \"T\", x = \"place\", unit = \"degC\", length_unit = \"mm\", reference = "
               "\"20 degC\" }"));
  points.write("t.csv", "place [mm],T [degC]\n25,70\n-5,10\n10,40\n");
  EXPECT_NEAR(final_force(points) / force, 1.0, 1e-12);
}

TEST(Fields, FollowAListOfFrames) {
  const TemporaryCase directory(
      held_bar("{ file = \"heat.pvd\", array = \"T\", unit = \"K\", length_unit = \"mm\", duration = \"90 s\", "
               "time_unit = \"min\" }"));
  directory.write("heat.pvd",
                  "<VTKFile type='Collection'><Collection>\n"
                  "<DataSet timestep='2' file='b.vtu'/>\n<DataSet group='' part='0' file='a.vtu' timestep='0.5'/>\n"
                  "</Collection></VTKFile>\n");
  directory.write("a.vtu", heated_bar(0.0));
  directory.write("b.vtu", heated_bar(60.0));
  // At 90 s two thirds of the way from 0.5 to 2 minutes.
  EXPECT_NEAR(final_force(directory) / force_by_formula("2e3*x*t"), 1.0, 1e-8);  // by another way
  const std::string longer = replaced(content_of(directory.path() / "case.toml"), "90 s", "121 s");
  directory.write("case.toml", longer);
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("its last frame is at 120 s"), std::string::npos) << outcome.err;
}

TEST(Fields, MayActFromTheStart) {
  const std::string text =
      held_bar("{ csv = \"t.csv\", column = 2, x = 1, unit = \"K\", length_unit = \"m\" }\napplied = \"from_start\"");
  const TemporaryCase directory(text);
  directory.write("t.csv", "0,0\n0.02,40\n");
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet", "--max-steps", "1"}).status, 0);
  const auto summary = nlohmann::json::parse(content_of(directory.results() / "summary.json"));
  EXPECT_NEAR(summary.at("final_force_N").get<double>() / force_by_formula("2e3*x*t"), 1.0, 1e-12);
}

// Of a material: as stiff as by its formula.
TEST(Fields, AreParametersOfMaterials) {
  const auto bar = [](const std::string& modulus) {
    std::string text = replaced(bar_case(), "frames_at = [\"0.006 mm\"]\n", "");
    text = replaced(text, poisson_ratio, std::string(poisson_ratio) + "damageable = false\n");
    return replaced(text, "young_modulus = \"30 GPa\"", "young_modulus = " + modulus);
  };
  const TemporaryCase by_file(
      bar("{ csv = \"e.csv\", column = \"E\", x = \"x\", unit = \"GPa\", length_unit = \"m\" }"));
  by_file.write("e.csv", "x,E\n0,30\n0.02,50\n");
  const TemporaryCase by_formula(bar("{ expr = \"30 + 1000*x\", unit = \"GPa\" }"));
  EXPECT_NEAR(final_force(by_file) / final_force(by_formula), 1.0, 1e-12);
}

TEST(Fields, OfNumbersMayHaveAUnit) {
  for (const char* unit : {"", ", unit = \"1\"", ", unit = \"%\""}) {
    const std::string field =
        fmt::format("{{ csv = \"n.csv\", column = \"nu\", x = \"x\", length_unit = \"m\"{} }}", unit);
    const TemporaryCase directory(replaced(bar_case(), poisson_ratio, "poisson_ratio = " + field + "\n"));
    directory.write("n.csv", "x,nu\n0,0.1\n0.02,0.2\n");
    const Outcome outcome = run({"check", directory.path().string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
}

TEST(Fields, BelongToTheResults) {
  const TemporaryCase directory(
      held_bar("{ csv = \"t.csv\", column = \"T\", x = \"x\", length_unit = \"m\", unit = \"K\" }"));
  directory.write("t.csv", "x,T\n0,0\n0.02,40\n");
  ASSERT_EQ(run({"run", directory.path().string(), "--quiet", "--max-steps", "4"}).status, 0);
  directory.write("t.csv", "x,T\n0,0\n0.02,41\n");
  EXPECT_EQ(run({"run", directory.path().string(), "--quiet", "--restart"}).status, 2);
}

constexpr double alpha = 1e-5, modulus = 70e9, poisson = 0.3, radius = 10.0, hottest = 100.0;  // radius in mm

std::string disc_case() {
  return fmt::format(R"(kind = "fracture"
title = "a disc, hot in the middle"
[mesh]
generator = "cylinder_sector"
azimuth = "5 degree"
radius = [{{ length = "{} mm", cells = 40 }}]
height = [{{ length = "0.25 mm", cells = 1 }}]
[materials.glass]
regions = ["body"]
young_modulus = "{} GPa"
poisson_ratio = {}
expansion = "{} 1/K"
damageable = false
toughness = "10 J/m^2"
[fracture]
model = "AT1"
length = "1 mm"
[loads]
temperature_change = {{ file = "t.vtu", array = "T", unit = "K", length_unit = "mm" }}
[[boundary]]
patches = ["bottom", "top"]
type = "symmetry"
[[boundary]]
patches = ["front", "back"]
type = "axisymmetric"
[loading]
initial_increment = 1.0
maximum_increment = 1.0
[output]
curve = {{ patch = "top", component = "z" }}
)",
                     radius, modulus / 1e9, poisson, alpha);
}

// Timoshenko & Goodier, Theory of Elasticity (1970), art. 151, a long cylinder that is held at its ends, with
// T = T0 (1 - r^2/R^2): s_r = a E T0/(4 (1 - nu)) (r^2/R^2 - 1), s_t = a E T0/(4 (1 - nu)) (3 r^2/R^2 - 1). The field's
// mesh is coarser and finer than the disc's; its error is h^2/8 T''.
TEST(Fields, GiveADiscItsStresses) {
  const double scale = alpha * modulus * hottest / (4.0 * (1.0 - poisson));
  for (const auto& [rings, bound] : {std::pair{10, 0.02}, {120, 0.0075}}) {
    const TemporaryCase directory(disc_case());
    directory.write("t.vtu",
                    flat_grid(
                        rings, 2 * rings,
                        [](double a, double b) {
                          const double r = radius * (0.001 + 0.999 * a), angle = (b - 0.5) * std::numbers::pi / 3.0;
                          return std::pair(r * std::cos(angle), r * std::sin(angle));
                        },
                        [](double x, double y) { return hottest * (1.0 - (x * x + y * y) / (radius * radius)); }));
    summary_of(directory);
    const std::filesystem::path frame = directory.results() / "fields" / "step_000001.vtu";
    for (const int direction : {0, 1}) {
      const FieldFile stress = read_field_file(frame, "stress", direction, 1.0);
      double error = 0.0;
      for (double share = 0.05; share < 0.9; share += 0.1) {
        const Interpolation there = stress.field.at({share * radius * 1e-3, 0.0, 0.125e-3}, false);
        double found = 0.0;
        for (std::size_t i = 0; i < there.known.size(); ++i) found += there.weight[i] * stress.values[there.known[i]];
        const double exact = scale * ((direction == 0 ? 1.0 : 3.0) * share * share - 1.0);
        error = std::max(error, std::abs(found - exact) / scale);
      }
      EXPECT_LT(error, bound) << rings << " rings, direction " << direction;
    }
  }
}

class BadFields : public testing::TestWithParam<BadInput> {};

constexpr const char* good = "{ csv = \"t.csv\", column = \"T\", x = \"x\", length_unit = \"m\", unit = \"K\" }";

TEST_P(BadFields, AreRefused) {
  const TemporaryCase directory(replaced(held_bar(good), GetParam().good, GetParam().bad));
  directory.write("t.csv", "x,T,text\n0,0,a\n0.01,40,b\n");
  directory.write("t.vtu", heated_bar(40.0));
  directory.write("cut.vtu", heated_bar(40.0).substr(0, 900));
  const std::string pairs = flat_grid(
      1, 1, [](double x, double y) { return std::pair(x, y); }, [](double, double) { return "1 2"; });
  directory.write("two.vtu", replaced(pairs, "Name=\"T\"", "Name=\"T\" NumberOfComponents=\"2\""));
  directory.write("none.pvd", "<Collection></Collection>");
  directory.write("nan.pvd", "<Collection><DataSet timestep=\"nan\" file=\"t.vtu\"/></Collection>");
  const Outcome outcome = run({"check", directory.path().string()});
  EXPECT_EQ(outcome.status, 2);
  for (const std::string& part : GetParam().message)
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    , BadFields,
    testing::Values(
        BadInput{"outside",
                 "unit = \"K\" }",
                 "unit = \"K\" }",
                 {"case.toml:", "temperature_change", "m outside the field, which reaches from (0, any, any) to (0.01",
                  "tolerance", "length_unit"}},
        BadInput{"no_file", "t.csv", "no.csv", {"no.csv"}}, BadInput{"text", "\"T\"", "\"text\"", {"\"a\""}},
        BadInput{"no_coordinate", "x = \"x\", ", "", {"name the columns of the coordinates x, y, z"}},
        BadInput{"no_unit", ", unit = \"K\"", "", {"unit"}},
        BadInput{"wrong_unit", "\"K\" }", "\"mm\" }", {"\"mm\" is a length; expected a temperature"}},
        BadInput{"absolute", "\"K\" }", "\"degC\" }", {"give it, as in reference = \"20 degC\""}},
        BadInput{"array",
                 good,
                 "{ file = \"t.vtu\", array = \"U\", unit = \"K\", length_unit = \"mm\" }",
                 {"t.vtu: it has no array \"U\"; available: T at points, none in cells"}},
        BadInput{"micrometres",
                 good,
                 "{ file = \"t.vtu\", array = \"T\", unit = \"K\", length_unit = \"um\" }",
                 {"which reaches from (-1e-06, -1e-06, any)", "Is length_unit right?"}},
        BadInput{"components",
                 good,
                 "{ file = \"two.vtu\", array = \"T\", unit = \"K\", length_unit = \"mm\" }",
                 {"two.vtu: the array has 2 components: name one, from 1"}},
        BadInput{"no_length_unit", ", length_unit = \"m\"", "", {"\"length_unit\" is missing"}},
        BadInput{"component",
                 good,
                 "{ file = \"t.vtu\", array = \"T\", component = 2, unit = \"K\", length_unit = \"mm\" }",
                 {"the array has 1 component"}},
        BadInput{"cut", good, "{ file = \"cut.vtu\", array = \"T\", unit = \"K\", length_unit = \"mm\" }", {"cut.vtu"}},
        BadInput{"no_frames",
                 good,
                 "{ file = \"none.pvd\", array = \"T\", unit = \"K\", duration = \"1 s\", length_unit = \"mm\" }",
                 {"none.pvd: it has no frames"}},
        BadInput{"frame_at_nan",
                 good,
                 "{ file = \"nan.pvd\", array = \"T\", unit = \"K\", duration = \"1 s\", length_unit = \"mm\" }",
                 {"nan.pvd: the timestep of its frame 1 is \"nan\"; expected a number"}},
        BadInput{"no_duration",
                 good,
                 "{ file = \"none.pvd\", array = \"T\", unit = \"K\", length_unit = \"mm\" }",
                 {"duration"}},
        BadInput{"unknown_of_a_formula",
                 good,
                 "{ expr = \"20*t\", unit = \"K\", expression = \"x\" }",
                 {"\"expression\" is not known here"}},
        BadInput{"unknown", "column", "colum", {"\"colum\" is not known here; did you mean \"column\"?"}},
        BadInput{"idle",
                 good,
                 "{ file = \"t.vtu\", array = \"T\", unit = \"K\", length_unit = \"mm\", x = \"x\" }",
                 {"\"x\" has no effect"}}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace pfdm::this_file
