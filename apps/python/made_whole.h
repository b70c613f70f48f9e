// Objects of Python that exist only as a whole.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <utility>

namespace hookpoint::python {

/// Base of a class of the module. An object that `__new__` made and `__init__` did not has no C++
/// object yet; pybind11 would let its methods work on raw memory from the class's own operator new.
/// There is none here: TypeError.
class MadeWhole {
 public:
  static void* operator new(std::size_t /*size*/) {
    throw pybind11::type_error(
        "this object was never initialised: __new__ alone makes no object of hookpoint");
  }
};

/// std::make_unique of such a class.
template <class Whole, class... Arguments>
std::unique_ptr<Whole> make_whole(Arguments&&... arguments) {
  return std::unique_ptr<Whole>(::new Whole(std::forward<Arguments>(arguments)...));
}

}  // namespace hookpoint::python
