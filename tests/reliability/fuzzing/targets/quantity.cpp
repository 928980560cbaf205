// Quantities with their units, units alone, and dimensions.

#include "cases/program/input/config/units.h"
#include "tests/reliability/fuzzing/input_file.h"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pfdm;
  using namespace pfdm::fuzzing;
  const std::string_view text = text_of(data, size);
  constexpr const Dimension* dimensions[] = {&dimension::length, &dimension::temperature, &dimension::stress,
                                             &dimension::acceleration, &dimension::number};
  for (const Dimension* due : dimensions) {
    is_read([&] { parse_quantity(text, *due); });
    is_read([&] { unit_in_si(text, *due); });
    is_unit_of(text, *due);
  }
  is_unit(text);
  is_read([&] { parse_quantity(text, dimension_of(text)); });
  return 0;
}
