#pragma once
// A fit of the endochronic law to cycles that the program made itself.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/point/endochronic_case.h"
#include "tests/cases/temporary_case.h"
#include "tests/solver/independent_simulators.h"

#include <filesystem>
#include <stdexcept>
#include <string>

namespace pfdm {

inline std::string cyclic_case(const std::string& kernel, const std::string& f_inf) {
  return "kind = \"endochronic\"\ntitle = \"cycles\"\n[material]\nyoung_modulus = \"100 GPa\"\npoisson_ratio = 0.3\n" +
         kernel + "[material.hardening]\nlaw = \"saturating\"\nf_inf = " + f_inf + R"x(
b = 20.0

[loading]
[[loading.segments]]
duration = "3 s"
increments = 90
control = { strain_xx = { expr = "0.005*sin(2*pi*t)", unit = "1" } }
)x";
}

inline const std::string true_kernel = "kernel = [{ C = \"30 GPa\", alpha = 700 }, { C = \"4 GPa\", alpha = 60 }]\n";
inline const std::string first_kernel_guess = R"(kernel = [
  { C = "20 GPa", alpha = 1000 },
  { C = "6 GPa", alpha = 40 },
]
)";

inline const std::string fit_table = R"(
[fit]
method = "joint"
estimate = ["kernel", "hardening"]
[fit.bounds]
f_inf = [0.5, 10]
C_1 = ["1 GPa", "500 GPa"]
[[fit.experiments]]
name = "cycles 0.5 %"
csv = "cycles.csv"
strain = { strain_xx = { column = "strain_xx" } }
stress = { stress_xx = { column = "stress_xx_Pa", unit = "Pa" } }
)";

/// A case to be fitted and the history of the true law in cycles.csv.
class FitCase {
 public:
  explicit FitCase(const std::string& fit = fit_table) : directory(cyclic_case(true_kernel, "2.0")) {
    if (run({"run", directory.path().string(), "--quiet"}).status != 0) throw std::logic_error("the true law fails");
    directory.write("cycles.csv", "# synthetic\n" + content_of(directory.results() / "history.csv"));
    std::filesystem::remove_all(directory.results());
    directory.write("case.toml", cyclic_case(first_kernel_guess, "1.5") + fit);
  }
  TemporaryCase directory;
};

}  // namespace pfdm
