#include "cases/python/extension/arrays.h"

#include "physics/error.h"

#include <fmt/format.h>

namespace pfdm {

std::string shape_words(const py::array& array) {
  std::string words;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) words += fmt::format("{}{}", i > 0 ? ", " : "", array.shape(i));
  return fmt::format("({}{})", words, array.ndim() == 1 ? "," : "");
}

std::vector<double> numbers_of(const ArrayOf<double>& array, std::string_view name) {
  if (array.ndim() != 1)
    throw InputError(
        fmt::format("{}: an array of one dimension is expected, its shape is {}", name, shape_words(array)));
  return {array.data(), array.data() + array.size()};
}

}  // namespace pfdm
