// Numpy arrays that look into C++ memory, and keep alive what owns it.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <vector>

namespace scree::python {

// A read-only array of `count` rows, `stride` bytes apart, of `width` numbers each (one: of one dimension). `owner` is the
// Python object that holds the memory, which must not change as long as it lives.
template <class T>
pybind11::array view(const T* first, std::size_t count, std::size_t stride, std::size_t width, pybind11::handle owner) {
  std::vector<pybind11::ssize_t> shape{static_cast<pybind11::ssize_t>(count)};
  std::vector<pybind11::ssize_t> strides{static_cast<pybind11::ssize_t>(stride)};
  if (width != 1) {
    shape.push_back(static_cast<pybind11::ssize_t>(width));
    strides.push_back(sizeof(T));
  }
  pybind11::array array(pybind11::dtype::of<T>(), std::move(shape), std::move(strides), first, owner);
  array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

// One number of every item of a list of structs.
template <class Number, class Item, class Member, class Memory>
pybind11::array member_view(const std::vector<Item, Memory>& items, Member Item::*member, std::size_t width,
                            pybind11::handle owner) {
  static const Item none{};
  const Item& first = items.empty() ? none : items.front();
  return view(reinterpret_cast<const Number*>(&(first.*member)), items.size(), sizeof(Item), width, owner);
}

// Takes a vector over.
template <class T>
pybind11::array own(std::vector<T> values) {
  auto* kept = new std::vector<T>(std::move(values));
  const pybind11::capsule owner(kept, [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  return view(kept->data(), kept->size(), sizeof(T), 1, owner);
}

}  // namespace scree::python
