// What Python gives: settings, names, counts and numbers, and what is wrong with them.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hookpoint::python {

/// Numbers of any shape, one after the other.
using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Threads that one call may use, as of the command's --jobs.
inline constexpr std::int64_t most_threads = 9999;

/// A str of Python. UnicodeEncodeError, a ValueError, for halves of a surrogate pair.
std::string utf8(const pybind11::handle& text);

/// `set`, a dict {trail: value}, as settings of the command line: "trail=value". Throws TypeError
/// for what is no dict, a trail that is no text, or a value that is neither text nor number.
std::vector<std::string> settings_of(const pybind11::handle& set);

/// One name, or a sequence of names. Throws TypeError; `argument` names the argument.
std::vector<std::string> names_of(const pybind11::handle& names, const char* argument);

/// A path: text, bytes or what os.fspath takes. Throws TypeError; `argument` names the argument.
std::filesystem::path path_of(const pybind11::object& path, const char* argument);

/// A number of threads: 0 is one a core. Throws hookpoint.Error.
int threads_of(std::int64_t count, const char* argument);

/// "2 x 3"; of a number "one number".
std::string shape_text(const pybind11::array& array);

/// The numbers of an array or a sequence. Throws hookpoint.Error for what is none; `what` names it.
Numbers numbers_of(const pybind11::handle& value, const std::string& what);

}  // namespace hookpoint::python
