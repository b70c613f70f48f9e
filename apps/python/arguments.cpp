#include "apps/python/arguments.h"

#include <fmt/format.h>
#include <pybind11/stl/filesystem.h>

#include "apps/python/errors.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

std::string type_name(const py::handle& value) {
  return py::str(py::type::handle_of(value).attr("__name__")).cast<std::string>();
}

/// A value as the language writes it: "5 deg" stays, 0.1 and (0, 0, .3) are written out. `depth`:
/// of lists in lists, which may hold themselves.
std::string text_of(const py::handle& value, const std::string& trail, int depth = 0) {
  constexpr int deepest = 4;
  if (py::isinstance<py::str>(value)) return utf8(value);
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(value)) return py::str(value).cast<std::string>();
  // A scalar of numpy, or an array that holds one number.
  if (py::hasattr(value, "item") && py::hasattr(value, "ndim") &&
      py::object(value.attr("ndim")).equal(py::int_(0)))
    return text_of(value.attr("item")(), trail, depth);
  const bool is_list = (py::isinstance<py::sequence>(value) || py::isinstance<py::array>(value)) &&
                       !py::isinstance<py::bytes>(value);
  if (is_list && depth < deepest) {
    std::string text;
    for (const py::handle& part : value)
      text += (text.empty() ? "" : ", ") + text_of(part, trail, depth + 1);
    return text;
  }
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw py::type_error(fmt::format(
        "the value of `{}` in `set` is text, a number or a list, not {}", trail, type_name(value)));
  }
  return py::repr(py::float_(number)).cast<std::string>();
}

}  // namespace

std::string utf8(const py::handle& text) {
  Py_ssize_t size = 0;
  const char* const bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
  if (bytes == nullptr) throw py::error_already_set();
  return {bytes, static_cast<std::size_t>(size)};
}

std::vector<std::string> settings_of(const py::handle& set) {
  if (!py::isinstance<py::dict>(set))
    throw py::type_error(
        fmt::format("`set` is a dict of trails and values, not {}", type_name(set)));
  std::vector<std::string> settings;
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(set)) {
    if (!py::isinstance<py::str>(key))
      throw py::type_error(
          fmt::format("the keys of `set` are trails, which are text, not {}", type_name(key)));
    const std::string trail = utf8(key);
    settings.push_back(trail + "=" + text_of(value, trail));
  }
  return settings;
}

std::vector<std::string> names_of(const py::handle& names, const char* argument) {
  if (py::isinstance<py::str>(names)) return {utf8(names)};
  const auto refuse = [&](const py::handle& given) {
    throw py::type_error(fmt::format("`{}` takes a name or a list of names, which are text, not {}",
                                     argument, type_name(given)));
  };
  if (!py::isinstance<py::iterable>(names) || py::isinstance<py::bytes>(names)) refuse(names);
  std::vector<std::string> all;
  for (const py::handle& name : names) {
    if (!py::isinstance<py::str>(name)) refuse(name);
    all.push_back(utf8(name));
  }
  return all;
}

std::filesystem::path path_of(const py::object& path, const char* argument) {
  try {
    return path.cast<std::filesystem::path>();
  } catch (const py::cast_error&) {
    throw py::type_error(fmt::format("`{}` is a path, not {}", argument, type_name(path)));
  }
}

int threads_of(std::int64_t count, const char* argument) {
  if (count < 0 || count > most_threads)
    throw_error(
        fmt::format("`{}` is a number of threads from 0, which is one a core, to {}, not {}",
                    argument, most_threads, count));
  return static_cast<int>(count);
}

std::string shape_text(const py::array& array) {
  if (array.ndim() == 0) return "one number";
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    text += (i > 0 ? " x " : "") + std::to_string(array.shape(i));
  return text;
}

Numbers numbers_of(const py::handle& value, const std::string& what) {
  auto array = Numbers::ensure(value);
  if (!array) throw_error(fmt::format("{} takes numbers, not {}", what, type_name(value)));
  return array;
}

}  // namespace hookpoint::python
