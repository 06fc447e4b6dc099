#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"

/// Between NumPy's arrays and ours.
namespace python {

/// Rows one after the other; other arrays are converted.
template <typename T>
using Array = pybind11::array_t<T, pybind11::array::c_style | pybind11::array::forcecast>;

/// An array that takes over the values, without a copy.
template <typename T>
Array<T> owned_array(std::vector<T> values) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const auto n = static_cast<pybind11::ssize_t>(kept->size());
  T* data = kept->data();
  const pybind11::capsule owner(kept.release(),
                                [](void* held) { delete static_cast<std::vector<T>*>(held); });
  return Array<T>(n, data, owner);
}

template <typename T>
Array<T> copied_array(const std::vector<T>& values) {
  return Array<T>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

/// n x 3.
inline Array<double> points_array(const std::vector<radiosity::Vec3>& points) {
  Array<double> result({static_cast<pybind11::ssize_t>(points.size()), pybind11::ssize_t{3}});
  auto values = result.mutable_unchecked<2>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) values(i, axis) = points[i][axis];
  }
  return result;
}

/// The rows of an n x 3 array.
inline std::vector<radiosity::Vec3> points_of(const Array<double>& array) {
  const auto values = array.unchecked<2>();
  std::vector<radiosity::Vec3> points(values.shape(0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {values(i, 0), values(i, 1), values(i, 2)};
  }
  return points;
}

template <typename T>
std::vector<T> values_of(const Array<T>& array) {
  return {array.data(), array.data() + array.size()};
}

}  // namespace python
