// import hookpoint: what Python sees.
#include <dlfcn.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "application/engines_json.h"
#include "python/errors.h"
#include "python/python_study.h"
#include "python/python_world.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

/// A value as the language writes it: "5 deg" stays, 0.1 and (0, 0, .3) are written out.
std::string text_of(const py::handle& value) {
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(value)) return py::str(value).cast<std::string>();
  if (!py::isinstance<py::sequence>(value) && !py::isinstance<py::array>(value))
    return py::repr(py::float_(py::reinterpret_borrow<py::object>(value))).cast<std::string>();
  std::string text;
  for (const py::handle& part : value) text += (text.empty() ? "" : ", ") + text_of(part);
  return text;
}

std::vector<std::string> settings_of(const py::dict& values) {
  std::vector<std::string> settings;
  for (const auto& [trail, value] : values)
    settings.push_back(trail.cast<std::string>() + "=" + text_of(value));
  return settings;
}

py::dict run_world(PythonWorld& world, std::optional<double> duration,
                   const std::vector<std::string>& record, std::int64_t every,
                   std::optional<std::filesystem::path> output, const py::object& movie) {
  RunOptions options{duration, record, every, std::move(output), std::nullopt};
  if (py::isinstance<py::bool_>(movie)) {
    if (movie.cast<bool>()) options.movie.emplace();
  } else {
    options.movie = movie.cast<std::filesystem::path>();
  }
  return world.run(options);
}

void add_world(py::module_& module) {
  py::class_<PythonWorld>(module, "World", "An experiment that runs, from time 0 on.")
      .def("step", &PythonWorld::step, py::arg("count") = 1,
           "Takes `count` steps, fewer when the run ends. Raises RunError.")
      .def("run", run_world, py::arg("duration") = py::none(), py::kw_only(),
           py::arg("record") = std::vector<std::string>{}, py::arg("every") = 1,
           py::arg("output") = py::none(), py::arg("movie") = false,
           "Runs for `duration` seconds, by default to the file's own. Returns a dict of numpy "
           "arrays: \"time\", and one a trail of `record`, at the present instant and after every "
           "`every` steps. `output`: the folder that gets what `hookpoint run` would leave there; "
           "`movie`: True or a file's name, to log the whole state too. Raises RunError and "
           "KeyboardInterrupt; `recorded` and the files then hold what there was.")
      .def("read", &PythonWorld::read, py::arg("trail"), "The present value of a port, SI.")
      .def("write", &PythonWorld::write, py::arg("trail"), py::arg("value"),
           "Sets an input, SI; the next step sees it.")
      .def("__getitem__", &PythonWorld::read, py::arg("trail"))
      .def("__setitem__", &PythonWorld::write, py::arg("trail"), py::arg("value"))
      .def("ports", &PythonWorld::ports, "Every port: a list of (trail, unit, writable).")
      .def_property_readonly("time", &PythonWorld::time, "Simulated time [s].")
      .def_property_readonly("steps", &PythonWorld::steps, "Steps taken.")
      .def_property_readonly(
          "deltat", [](const PythonWorld& world) { return world.experiment().deltat; },
          "Time step [s].")
      .def_property_readonly(
          "duration", [](const PythonWorld& world) { return world.experiment().duration; },
          "How long the file wants it to run [s].")
      .def_property_readonly(
          "name", [](const PythonWorld& world) { return world.experiment().world; },
          "Of the World.")
      .def_property_readonly(
          "engine", [](const PythonWorld& world) { return world.experiment().engine; },
          "That computes the motion.")
      .def_property_readonly("text", &PythonWorld::text,
                             "The experiment after includes, loops, expressions and settings.")
      .def_property_readonly("ended", &PythonWorld::ended,
                             "Why the run is over, \"\" while it is not.")
      .def_property_readonly("notices", &PythonWorld::notices,
                             "What its engine had to say: a list of strings.")
      .def_property_readonly("recorded", &PythonWorld::recorded, "By the last `run`.");
}

void add_functions(py::module_& module) {
  module.def(
      "load",
      [](const std::filesystem::path& file, const py::dict& set, std::optional<std::string> engine,
         bool allow_plugins) {
        return std::make_unique<PythonWorld>(
            Source{file, {}, settings_of(set), std::move(engine), allow_plugins});
      },
      py::arg("file"), py::kw_only(), py::arg("set") = py::dict(), py::arg("engine") = py::none(),
      py::arg("allow_plugins") = false,
      "The World of a .hook file at time 0. `set`: {trail or Param: value}, values as the language "
      "writes them (\"5 deg\"), or numbers in SI. Raises FileError.");
  module.def(
      "loads",
      [](const std::string& text, const py::dict& set, std::optional<std::string> engine,
         const std::filesystem::path& name) {
        return std::make_unique<PythonWorld>(
            Source{name, text, settings_of(set), std::move(engine), false});
      },
      py::arg("text"), py::kw_only(), py::arg("set") = py::dict(), py::arg("engine") = py::none(),
      py::arg("name") = "<text>",
      "The same of a text. `name`: the file that it would be, beside which its Includes are.");
  module.def(
      "study",
      [](const std::filesystem::path& file, bool quick, const std::vector<std::string>& only,
         int jobs, std::optional<std::filesystem::path> out, bool resume, bool allow_plugins) {
        return run_studies({file, std::move(out), jobs, quick, resume, only, allow_plugins});
      },
      py::arg("file"), py::kw_only(), py::arg("quick") = false,
      py::arg("only") = std::vector<std::string>{}, py::arg("jobs") = 0,
      py::arg("out") = py::none(), py::arg("resume") = false, py::arg("allow_plugins") = false,
      "Runs the Studies, Walls and Matrices of a .hook file: a dict of results by their names, "
      "each with \"table\", a dict of numpy arrays by the titles of results.csv (\"slope [deg]\"). "
      "`out`: where the files of `hookpoint study` go, else none are kept.");
  module.def(
      "engines",
      [] {
        const std::string json = application::engines_json(application::Application());
        return py::module_::import("json").attr("loads")(json);
      },
      "Every engine, contact law and integrator: {\"engines\", \"laws\", \"integrators\"}, lists "
      "of "
      "dicts.");
}

/// Plugins find what they need of hookpoint among the global names, where python3 does not put
/// those of a module.
void share_names() {
  Dl_info self;
  if (dladdr(reinterpret_cast<const void*>(&share_names), &self) != 0)
    dlopen(self.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_GLOBAL);
}

}  // namespace
}  // namespace hookpoint::python

PYBIND11_MODULE(hookpoint, module) {
  module.doc() = "Dynamics of legged robots under comparable contact models (docs/python.md).";
  module.attr("__version__") = HOOKPOINT_VERSION;
  hookpoint::python::share_names();
  hookpoint::python::add_errors(module);
  hookpoint::python::add_world(module);
  hookpoint::python::add_functions(module);
}
