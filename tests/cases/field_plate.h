#pragma once
// A plate in uniaxial tension whose curve and displacement fields are made by the closed form, with noise.

#include "postproc/files/text_file.h"
#include "tests/cases/temporary_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <random>
#include <string>
#include <vector>

namespace pfdm::field_plate {

inline constexpr double length = 20.0, height = 10.0;                           // of a plate 1 mm thick [mm]
inline constexpr double plate_modulus = 70e9, true_ratio = 0.33, noise = 1e-4;  // of displacements [mm]

inline const std::string plate = R"(
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
inline std::vector<std::vector<Point>> measured(unsigned seed, double scale = 1.0) {
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

inline void write(const TemporaryCase& directory, const std::vector<std::vector<Point>>& frames,
                  const std::string& names = "X [mm],Y [mm],U [mm],V [mm]") {
  std::string curve = "u,f,deviation\n";
  std::mt19937 engine(5);
  std::normal_distribution<double> normal(0.0, 7.0);
  for (int i = 1; i <= 20; ++i)
    curve += fmt::format("{},{},7\n", i, 1e-6 * plate_modulus * 1e-3 * i / length * height + normal(engine));
  directory.write("curve.csv", "# SYNTHETIC, made by the test\n" + curve);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::string text = "# SYNTHETIC, made by the test\n" + names + "\n";
    for (const Point& p : frames[k]) text += fmt::format("{},{},{},{}\n", p.x, p.y, p.u, p.v);
    text += "3.5,4.5,,\n4.5,4.5,NaN,NaN\n";  // not correlated
    directory.write(fmt::format("frame_{}.csv", k), text);
  }
}

inline nlohmann::json fitted(const TemporaryCase& directory) {
  const Outcome outcome = run({"fit", directory.path().string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  return nlohmann::json::parse(read_file(directory.results() / "fit.json"));
}

}  // namespace pfdm::field_plate
