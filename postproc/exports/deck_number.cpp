#include "postproc/exports/deck_number.h"

#include <fmt/format.h>

namespace pfdm {
namespace {

/// Without the sign and the leading zeros of the exponent: 1.25E12, 2.E-9.
std::string short_real(double value, int digits) {
  const std::string text = fmt::format("{:#.{}G}", value, digits);
  const std::size_t e = text.find('E');
  std::string mantissa = text.substr(0, e);
  while (mantissa.ends_with('0')) mantissa.pop_back();
  if (mantissa.ends_with('.')) mantissa += '0';
  if (e == std::string::npos) return mantissa;
  return fmt::format("{}E{}", mantissa, std::stoi(text.substr(e + 1)));
}

}  // namespace

std::string deck_number(double value) { return fmt::format("{:.10g}", value); }

std::string real_field(double value, int width) {
  const auto room = static_cast<std::size_t>(width - 1);  // a blank parts it from its neighbour
  for (int digits = 12; digits > 1; --digits)
    if (const std::string text = short_real(value, digits); text.size() <= room)
      return fmt::format("{:>{}}", text, width);
  return fmt::format("{:>{}}", short_real(value, 1), width);
}

std::string integer_field(int value, int width) { return fmt::format("{:>{}}", value, width); }

}  // namespace pfdm
