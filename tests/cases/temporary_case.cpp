#include "tests/cases/temporary_case.h"

#include "cases/program/program.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace pfdm {

std::string bar_case() {
  return R"(kind = "fracture"
title = "a bar"

[mesh]
generator = "box_hexes"
x = [{ length = "20 mm", cells = 21 }]
y = [{ length = "1 mm", cells = 2 }]
z = [{ length = "1 mm", cells = 1 }]
region = "bar"
[[mesh.regions]]
name = "weak"
lower = ["9.6 mm", "-1 mm", "-1 mm"]
upper = ["10.4 mm", "2 mm", "2 mm"]

[materials.concrete]
regions = ["bar", "weak"]
young_modulus = "30 GPa"
poisson_ratio = 0.2
toughness = "100 J/m^2"

[regions.weak]
toughness = "80 J/m^2"

[fracture]
model = "AT1"
split = "none"
length = "4 mm"

[[boundary]]
patch = "xmin"
displacement = ["0 mm", "free", "free"]
[[boundary]]
patch = "xmax"
displacement = ["0.015 mm", "free", "free"]
[[boundary]]
patches = ["ymin", "ymax"]
type = "symmetry"
[[boundary]]
patches = ["zmin", "zmax"]
type = "plane"

[loading]
initial_increment = 0.1
maximum_increment = 0.1

[output]
curve = { patch = "xmax", component = "x" }
frames_at = ["0.006 mm"]
)";
}

std::string crack_plane() {
  return R"(
[cohesive]
[[cohesive.planes]]
name = "crack"
point = ["10 mm", "0.5 mm", "0.5 mm"]
normal = [1, 0, 0]
half_width = "30 mm"
)";
}

std::string measured_specimen(const std::string& stiffness_between) {
  return "\n[experiment]\nstiffness_between = " + stiffness_between + R"(
[[experiment.specimens]]
name = "one"
csv = "data/one.csv"
displacement = { column = "u", unit = "um" }
force = { column = "f", unit = "kN" }
)";
}

std::string soft_sample() {
  return R"(kind = "mass_material"
title = "a soft sample"
[model]
structure = "2"
mass = "1.12 kg"
stiffness = ["54 kN/m"]
damping = "40 N s/m"
[sampling]
rate = "1 kHz"
)";
}

std::string replaced(std::string text, const std::string& old_text, const std::string& new_text) {
  const std::size_t place = text.find(old_text);
  if (place == std::string::npos || text.find(old_text, place + 1) != std::string::npos)
    throw std::logic_error(old_text + " does not occur exactly once");
  return text.replace(place, old_text.size(), new_text);
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TemporaryCase::TemporaryCase(const std::string& case_toml) {
  std::string pattern = (std::filesystem::temp_directory_path() / "pfdm_case_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary directory");
  path_ = pattern;
  write("case.toml", case_toml);
}

TemporaryCase::~TemporaryCase() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void TemporaryCase::write(const std::string& file, const std::string& content) const {
  std::ofstream(path_ / file, std::ios::binary) << content;
}

Outcome run(const std::vector<std::string>& arguments) {
  std::ostringstream out;
  std::ostringstream err;
  const int status = run_program(arguments, out, err);
  return {status, out.str(), err.str()};
}

void PrintTo(const BadInput& input, std::ostream* stream) { *stream << input.name; }

void expect_refused(const TemporaryCase& directory, const BadInput& input) {
  for (const char* command : {"check", "run"}) {
    const Outcome outcome = run({command, directory.path().string()});
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    for (const std::string& part : input.message)
      EXPECT_NE(outcome.err.find(part), std::string::npos) << part << " is missing in " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(directory.results()));
  }
}

}  // namespace pfdm
