#pragma once
// Arrays of NumPy for values of the library, and back.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pfdm {

namespace py = pybind11;

/// Of the type that is due, with its elements one after the other; another one is converted.
template <class T>
using ArrayOf = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// A read-only array on memory of `owner`, which lives as long as the array and all views of it. `strides` in bytes.
template <class T, class Owner>
py::array_t<T> view_of(std::shared_ptr<Owner> owner, const T* data, std::vector<py::ssize_t> shape,
                       std::vector<py::ssize_t> strides = {}) {
  using Kept = std::shared_ptr<Owner>;
  const py::capsule base(new Kept(std::move(owner)), [](void* kept) { delete static_cast<Kept*>(kept); });
  py::array_t<T> array = strides.empty() ? py::array_t<T>(std::move(shape), data, base)
                                         : py::array_t<T>(std::move(shape), std::move(strides), data, base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// An array of its own.
template <class Values>
py::array_t<double> copy_of(const Values& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// The numbers of an array of one dimension. Throws InputError, which calls it `name`, for another one.
std::vector<double> numbers_of(const ArrayOf<double>& array, std::string_view name);

/// "(3, 2)"
std::string shape_words(const py::array& array);

}  // namespace pfdm
