// Formulas of the place and the load parameter.

#include "cases/program/input/config/expression.h"
#include "tests/reliability/fuzzing/input_file.h"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  is_read([&] {
    const Expression expression{std::string(text_of(data, size))};
    expression.uses_load();
    for (const double t : {0.0, 0.5, 1.0}) {
      const Vector x(0.1, -2.0, 1e-3 * t);
      const double value = expression(x, t);
      require(std::isfinite(value));
      require(value == expression(x, t));  // nothing is left over from the call before
    }
  });
  return 0;
}
