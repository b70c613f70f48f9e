#include "apps/python/copying.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <utility>

namespace hookpoint::python {
namespace {

namespace py = pybind11;

/// A file is found again from another working folder.
py::tuple tuple_of(const Source& source) {
  const auto file = source.text ? source.file : std::filesystem::absolute(source.file);
  return py::make_tuple(file.string(), source.text, source.settings, source.engine,
                        source.consent.plugins, source.consent.engines);
}

std::shared_ptr<LoadedFile> loaded(const py::tuple& source) {
  return std::make_shared<LoadedFile>(Source{source[0].cast<std::string>(),
                                             source[1].cast<std::optional<std::string>>(),
                                             source[2].cast<std::vector<std::string>>(),
                                             source[3].cast<std::optional<std::string>>(),
                                             {source[4].cast<bool>(), source[5].cast<bool>()}});
}

py::tuple tuple_of(const BatchOptions& options) {
  py::list variants;
  for (const LoadedFile::Variant& variant : options.variants)
    variants.append(py::make_tuple(variant.settings, variant.seed));
  return py::make_tuple(options.threads, variants, options.observed, options.written, options.done);
}

BatchOptions options_of(const py::tuple& options) {
  Variants variants;
  for (const py::handle& variant : options[1]) {
    const auto [settings, seed] =
        variant.cast<std::pair<std::vector<std::string>, std::optional<std::uint64_t>>>();
    variants.push_back({settings, seed});
  }
  if (variants.empty()) throw py::cast_error("a Batch has a world or more");
  return {options[0].cast<int>(), variants, options[2].cast<std::vector<std::string>>(),
          options[3].cast<std::vector<std::string>>(),
          options[4].cast<std::optional<std::string>>()};
}

/// What `make` reads out of the tuple of a pickle, which anybody may have written.
template <class Make>
auto unpickled(const char* name, const Make& make) {
  try {
    return make();
  } catch (const py::cast_error&) {
    throw py::type_error(fmt::format("this is no {} that was pickled", name));
  }
}

template <class Class>
void add_protocols(py::class_<Class>& of) {
  of.def("copy", &Class::copy, "Another one, which continues from here bit for bit as this does.");
  of.def("__copy__", &Class::copy);
  of.def(
      "__deepcopy__", [](Class& self, const py::dict& /*memo*/) { return self.copy(); },
      py::arg("memo"));
  // It holds nothing open: what a `with` ends is the block.
  of.def("__enter__", [](const py::object& self) { return self; });
  of.def("__exit__", [](const Class& /*self*/, const py::args& /*raised*/) {});
}

}  // namespace

void add_copying(py::class_<PythonWorld>& world) {
  add_protocols(world);
  world.def(py::pickle(
      [](PythonWorld& self) {
        return py::make_tuple(tuple_of(self.file().source()), self.state());
      },
      [](const py::tuple& pickled) {
        return unpickled("World", [&] {
          auto made = make_whole<PythonWorld>(loaded(pickled[0]));
          made->set_state(pickled[1]);
          return made;
        });
      }));
}

void add_copying(py::class_<PythonBatch>& batch) {
  add_protocols(batch);
  batch.def(py::pickle(
      [](PythonBatch& self) {
        return py::make_tuple(tuple_of(self.file().source()), tuple_of(self.options()),
                              self.states(), self.failures(), self.actions());
      },
      [](const py::tuple& pickled) {
        return unpickled("Batch", [&] {
          auto made = make_whole<PythonBatch>(loaded(pickled[0]), options_of(pickled[1]));
          made->continue_from(pickled[2], pickled[3], pickled[4].cast<py::array_t<double>>());
          return made;
        });
      }));
}

}  // namespace hookpoint::python
