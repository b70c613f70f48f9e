// import hookpoint: what Python sees.
#include <dlfcn.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "application/engines_json.h"
#include "python/errors.h"
#include "python/frames.h"
#include "python/python_batch.h"
#include "python/python_dynamics.h"
#include "python/python_study.h"
#include "python/python_tune.h"
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

std::unique_ptr<PythonWorld> world_of(const Source& source) {
  return std::make_unique<PythonWorld>(std::make_shared<LoadedFile>(source));
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
      .def(
          "step",
          [](PythonWorld& world, std::int64_t count, const py::object& callback,
             std::int64_t every) { world.step(count, callback, every); },
          py::arg("count") = 1, py::kw_only(), py::arg("callback") = py::none(),
          py::arg("every") = 1,
          "Takes `count` steps, fewer when the run ends. `callback(world)` is called after every "
          "`every` steps and after the last; the steps end when it returns something false but "
          "None. Raises RunError.")
      .def("reset", &PythonWorld::reset,
           "Back to time 0: what follows is bit for bit what a World that was just loaded does. "
           "Views "
           "stay. What only a step computes (a joint's acceleration) is right after the next step.")
      .def("state", &PythonWorld::state,
           "Everything that evolves, as bytes with the experiment's hash and a checksum.")
      .def("set_state", &PythonWorld::set_state, py::arg("state"),
           "Goes on bit for bit from such bytes, of this experiment. Raises Error for any others "
           "and changes nothing then.")
      .def("copy", &PythonWorld::copy,
           "Another World of the same file that goes on from here bit for bit as this one does.")
      .def(
          "view",
          [](const py::object& self, const std::string& trail) {
            return self.cast<PythonWorld&>().view(self, trail);
          },
          py::arg("trail"),
          "The port, vector or list as a numpy array on the world's own memory, SI: always the "
          "present value, and written in place where it is an input. A lone number has shape ().")
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

std::unique_ptr<PythonBatch> batch_of(const py::object& file, std::size_t worlds, int threads,
                                      const std::optional<std::vector<std::uint64_t>>& seeds,
                                      const std::vector<std::string>& observations,
                                      const std::vector<std::string>& actions,
                                      const std::optional<std::string>& done, const py::dict& set,
                                      std::optional<std::string> engine, bool allow_plugins) {
  Source source{{}, {}, settings_of(set), std::move(engine), allow_plugins};
  const bool is_text = py::isinstance<py::str>(file) &&
                       file.cast<std::string>().find_first_of("{\n") != std::string::npos;
  if (is_text) {
    source.file = "<text>";
    source.text = file.cast<std::string>();
  } else {
    source.file = file.cast<std::filesystem::path>();
  }
  return std::make_unique<PythonBatch>(
      std::make_shared<LoadedFile>(source),
      BatchOptions{worlds, threads, seeds.value_or(std::vector<std::uint64_t>{}), observations,
                   actions, done});
}

void add_batch(py::module_& module) {
  py::class_<PythonBatch>(module, "Batch",
                          "Worlds of one file, stepped by threads, with arrays in and out. Each is "
                          "bit for bit a World by itself, for any number of threads.")
      .def(py::init(&batch_of), py::arg("file"), py::arg("worlds"), py::kw_only(),
           py::arg("threads") = 0, py::arg("seeds") = py::none(),
           py::arg("observations") = std::vector<std::string>{},
           py::arg("actions") = std::vector<std::string>{}, py::arg("done") = py::none(),
           py::arg("set") = py::dict(), py::arg("engine") = py::none(),
           py::arg("allow_plugins") = false,
           "`file`: a .hook file, or the text of one. `threads`: 0 is one a core. `seeds`: one a "
           "world, by default the file's. `observations`, `actions`: trails of ports, vectors or "
           "lists, a column a number. `done`: a port that is not 0 once a world is done. Raises "
           "FileError.")
      .def(
          "step",
          [](PythonBatch& batch, const py::object& actions, std::int64_t count) {
            batch.step(actions, count);
            return py::make_tuple(batch.observations(), batch.done());
          },
          py::arg("actions") = py::none(), py::arg("count") = 1,
          "Writes `actions` (worlds x columns, SI; None: as `Batch.actions` holds them) and takes "
          "`count` steps in each world that is not done. Returns (observations, done), the Batch's "
          "own arrays. A step that cannot be taken makes its world done: see `failures`. Ctrl-C "
          "leaves worlds at different instants.")
      .def(
          "reset",
          [](PythonBatch& batch, const py::object& mask) {
            batch.reset(mask);
            return batch.observations();
          },
          py::arg("mask") = py::none(),
          "Back to time 0: the worlds where `mask` is true, or all. Returns the observations.")
      .def("state", &PythonBatch::state, py::arg("world"),
           "World.state of that world; a World with the same seed takes it.")
      .def("set_state", &PythonBatch::set_state, py::arg("world"), py::arg("state"),
           "World.set_state of that world.")
      .def("__len__", &PythonBatch::size)
      .def_property_readonly("observations", &PythonBatch::observations,
                             "worlds x columns, SI; every step writes the same memory.")
      .def_property_readonly("actions", &PythonBatch::actions,
                             "worlds x columns, SI: what the next step writes; may be filled.")
      .def_property_readonly("done", &PythonBatch::done,
                             "Of each world: `done` is not 0, its run has ended, or failed.")
      .def_property_readonly("failures", &PythonBatch::failures,
                             "Why steps could not be taken: a dict by the world's index.")
      .def_property_readonly("time", &PythonBatch::time, "Of each world [s].")
      .def_property_readonly("seeds", &PythonBatch::seeds, "Of each world.")
      .def_property_readonly("observation_trails", &PythonBatch::observation_trails,
                             "Of the columns of `observations`.")
      .def_property_readonly("action_trails", &PythonBatch::action_trails,
                             "Of the columns of `actions`.")
      .def_property_readonly("threads", &PythonBatch::threads, "That step it.")
      .def_property_readonly(
          "deltat", [](const PythonBatch& batch) { return batch.file().experiment().deltat; },
          "Time step [s].")
      .def_property_readonly(
          "text", [](const PythonBatch& batch) { return batch.file().text(); },
          "The experiment after includes, loops, expressions and settings.");
}

void add_functions(py::module_& module) {
  module.def(
      "load",
      [](const std::filesystem::path& file, const py::dict& set, std::optional<std::string> engine,
         bool allow_plugins) {
        return world_of({file, {}, settings_of(set), std::move(engine), allow_plugins});
      },
      py::arg("file"), py::kw_only(), py::arg("set") = py::dict(), py::arg("engine") = py::none(),
      py::arg("allow_plugins") = false,
      "The World of a .hook file at time 0. `set`: {trail or Param: value}, values as the language "
      "writes them (\"5 deg\"), or numbers in SI. Raises FileError.");
  module.def(
      "loads",
      [](const std::string& text, const py::dict& set, std::optional<std::string> engine,
         const std::filesystem::path& name) {
        return world_of({name, text, settings_of(set), std::move(engine), false});
      },
      py::arg("text"), py::kw_only(), py::arg("set") = py::dict(), py::arg("engine") = py::none(),
      py::arg("name") = "<text>",
      "The same of a text. `name`: the file that it would be, beside which its Includes are.");
  module.def(
      "study",
      [](const std::filesystem::path& file, bool quick, const std::vector<std::string>& only,
         int jobs, std::optional<std::filesystem::path> out, bool resume, bool allow_plugins,
         bool frames) {
        const Frames made(frames);
        return made.of(
            run_studies({file, std::move(out), jobs, quick, resume, only, allow_plugins}));
      },
      py::arg("file"), py::kw_only(), py::arg("quick") = false,
      py::arg("only") = std::vector<std::string>{}, py::arg("jobs") = 0,
      py::arg("out") = py::none(), py::arg("resume") = false, py::arg("allow_plugins") = false,
      py::arg("frames") = false,
      "Runs the Studies, Walls and Matrices of a .hook file: a dict of results by their names, "
      "each with \"table\", a dict of numpy arrays by the titles of results.csv (\"slope [deg]\"), "
      "a "
      "Study also with \"tables\", its Table blocks. `out`: where the files of `hookpoint study` "
      "go, "
      "else none are kept. `frames`: every table is a pandas.DataFrame.");
  module.def(
      "tune",
      [](const std::filesystem::path& file, bool quick, int jobs,
         std::optional<std::filesystem::path> out, bool resume, bool allow_plugins, bool frames) {
        const Frames made(frames);
        return made.of(run_tunings({file, std::move(out), jobs, quick, resume, {}, allow_plugins}));
      },
      py::arg("file"), py::kw_only(), py::arg("quick") = false, py::arg("jobs") = 0,
      py::arg("out") = py::none(), py::arg("resume") = false, py::arg("allow_plugins") = false,
      py::arg("frames") = false,
      "Runs the Tunes and Calibrates of a .hook file: a dict of results by their names, each with "
      "\"table\", a dict of numpy arrays: every evaluation of a Tune, the fitted constants of a "
      "Calibrate. `out`: where the files of `hookpoint tune` go, else none are kept. `frames`: "
      "every table is a pandas.DataFrame.");
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
  hookpoint::python::add_batch(module);
  hookpoint::python::add_dynamics(module);
  hookpoint::python::add_functions(module);
}
