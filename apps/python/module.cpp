// import hookpoint: what Python sees.
#include <dlfcn.h>
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>

#include "apps/python/arguments.h"
#include "apps/python/copying.h"
#include "apps/python/errors.h"
#include "apps/python/frames.h"
#include "apps/python/gil.h"
#include "apps/python/python_batch.h"
#include "apps/python/python_dynamics.h"
#include "apps/python/python_tasks.h"
#include "apps/python/python_world.h"
#include "apps/shared/engines_json.h"
#include "apps/shared/exported.h"
#include "apps/shared/translated.h"
#include "text/number.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

std::unique_ptr<PythonWorld> world_of(const Source& source) {
  return make_whole<PythonWorld>(std::make_shared<LoadedFile>(source));
}

py::dict run_world(PythonWorld& world, std::optional<double> duration, const py::object& record,
                   std::int64_t every, std::optional<std::filesystem::path> output,
                   const py::object& movie) {
  RunOptions options{duration, names_of(record, "record"), every, std::move(output), std::nullopt};
  if (py::isinstance<py::bool_>(movie)) {
    if (movie.cast<bool>()) options.movie.emplace();
  } else {
    options.movie = path_of(movie, "movie");
  }
  return world.run(options);
}

void add_world(py::module_& module) {
  py::class_<PythonWorld> type(module, "World", "An experiment that runs, from time 0 on.");
  add_copying(type);
  type.def(
          "step",
          [](PythonWorld& world, std::int64_t count, const py::object& callback,
             std::int64_t every) { world.step(count, callback, every); },
          py::arg("count") = 1, py::kw_only(), py::arg("callback") = py::none(),
          py::arg("every") = 1,
          "Takes `count` steps, fewer when the run ends. `callback(world)` is called after every "
          "`every` steps and after the last; the steps end when it returns something false but "
          "None. Raises RunError.")
      .def("reset", &PythonWorld::reset, py::kw_only(), py::arg("state") = py::none(),
           "Back to time 0: what follows is bit for bit what a World that was just loaded does. "
           "`state`: {trail: numbers}, SI, of location, orientation, velocity and angular_velocity "
           "of bases, angle and rate of joints; the file gives the others. Views stay. What only a "
           "step computes (a joint's acceleration) is right after the next step. Raises Error.")
      .def("state", &PythonWorld::state,
           "Everything that evolves, as bytes with the experiment's hash and a checksum.")
      .def("set_state", &PythonWorld::set_state, py::arg("state"),
           "Continues bit for bit from such bytes, of this experiment. Raises Error for any others "
           "and changes nothing then.")
      .def(
          "view",
          [](const py::object& self, const std::string& trail) {
            return self.cast<PythonWorld&>().view(self, trail);
          },
          py::arg("trail"),
          "The port, vector or list as a numpy array on the world's own memory, SI: always the "
          "present value, and written in place where it is an input. A lone number has shape ().")
      .def("run", run_world, py::arg("duration") = py::none(), py::kw_only(),
           py::arg("record") = py::list(), py::arg("every") = 1, py::arg("output") = py::none(),
           py::arg("movie") = false,
           "Runs for `duration` seconds, by default to the file's own. Returns a dict of numpy "
           "arrays: \"time\", and one a trail of `record` (a name or a list of names), at the "
           "present instant and after every `every` steps; a vector's has a row an instant. "
           "`output`: the folder that gets what `hookpoint run` would leave there; "
           "`movie`: True or a file's name, to log the whole state too. Raises RunError and "
           "KeyboardInterrupt; `recorded` and the files then hold what there was.")
      .def("read", &PythonWorld::read, py::arg("trail"),
           "The present value of a port, SI: a float, of a vector or a list an array of its own.")
      .def("write", &PythonWorld::write, py::arg("trail"), py::arg("value"),
           "Sets an input, or all numbers of a vector, SI; the next step sees it.")
      .def("__getitem__", &PythonWorld::read, py::arg("trail"))
      .def("__setitem__", &PythonWorld::write, py::arg("trail"), py::arg("value"))
      .def("__repr__", &PythonWorld::repr)
      .def("ports", py::overload_cast<>(&PythonWorld::ports),
           "Every port: a list of (trail, unit, writable).")
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
                             "Warnings of the file and the engine's notices since time 0: a list "
                             "of strings. Each was a UserWarning when it came.")
      .def_property_readonly("recorded", &PythonWorld::recorded, "By the last `run`.");
}

using Seeds = std::optional<std::vector<std::uint64_t>>;

void require_one_a_world(const char* what, std::size_t worlds, std::size_t given) {
  if (given != worlds)
    throw_error(fmt::format("`{}` has one entry a world: {}, not {}", what, worlds, given));
}

/// `settings`, and `over` in the place of those of the same trails.
std::vector<std::string> changed(std::vector<std::string> settings,
                                 const std::vector<std::string>& over) {
  for (const std::string& setting : over) {
    const std::string trail = setting.substr(0, setting.find('=') + 1);
    const auto same = std::ranges::find_if(
        settings, [&](const std::string& other) { return other.starts_with(trail); });
    if (same == settings.end())
      settings.push_back(setting);
    else
      *same = setting;
  }
  return settings;
}

/// `variants` with what `set`, a dict or a list of one a world, and `seeds` change.
Variants changed(Variants variants, const py::object& set, const Seeds& seeds) {
  const bool one_a_world = py::isinstance<py::list>(set) || py::isinstance<py::tuple>(set);
  if (one_a_world) require_one_a_world("set", variants.size(), py::len(set));
  if (seeds) require_one_a_world("seeds", variants.size(), seeds->size());
  std::vector<std::string> same_for_all;
  if (!set.is_none() && !one_a_world) same_for_all = settings_of(set);
  for (std::size_t i = 0; i < variants.size(); ++i) {
    LoadedFile::Variant& variant = variants[i];
    variant.settings = changed(std::move(variant.settings),
                               one_a_world ? settings_of(set[py::int_(i)]) : same_for_all);
    if (seeds) variant.seed = (*seeds)[i];
  }
  return variants;
}

std::unique_ptr<PythonBatch> batch_of(const py::object& file, std::int64_t worlds,
                                      std::int64_t threads, const Seeds& seeds,
                                      const py::object& observations, const py::object& actions,
                                      const std::optional<std::string>& done, const py::object& set,
                                      std::optional<std::string> engine, bool allow_plugins,
                                      bool allow_engines) {
  if (worlds < 1 || worlds > most_worlds)
    throw_error(fmt::format("a Batch has 1 to {} worlds, not {}", most_worlds, worlds));
  const Variants variants = changed(Variants(static_cast<std::size_t>(worlds)), set, seeds);
  Source source{
      {}, {}, variants.front().settings, std::move(engine), {allow_plugins, allow_engines}};
  const bool is_text =
      py::isinstance<py::str>(file) && utf8(file).find_first_of("{\n") != std::string::npos;
  if (is_text) {
    source.file = "<text>";
    source.text = utf8(file);
  } else {
    source.file = path_of(file, "file");
  }
  const BatchOptions options{threads_of(threads, "threads"), variants,
                             names_of(observations, "observations"), names_of(actions, "actions"),
                             done};
  return make_whole<PythonBatch>(std::make_shared<LoadedFile>(source), options);
}

py::array_t<double> reset_batch(PythonBatch& batch, const py::object& mask, const py::object& state,
                                const py::object& set, const Seeds& seeds) {
  BatchReset reset{mask, state, std::nullopt};
  if (!set.is_none() || seeds) {
    Variants present;
    for (std::size_t i = 0; i < batch.size(); ++i) present.push_back(batch.variant(i));
    reset.variants = changed(std::move(present), set, seeds);
  }
  batch.reset(reset);
  return batch.observations();
}

void add_batch(py::module_& module) {
  py::class_<PythonBatch> type(
      module, "Batch",
      "Worlds of one file, stepped by threads, with arrays in and out. Each is bit for bit a World "
      "by itself, for any number of threads.");
  add_copying(type);
  type.def(py::init(&batch_of), py::arg("file"), py::arg("worlds"), py::kw_only(),
           py::arg("threads") = 0, py::arg("seeds") = py::none(),
           py::arg("observations") = py::list(), py::arg("actions") = py::list(),
           py::arg("done") = py::none(), py::arg("set") = py::dict(),
           py::arg("engine") = py::none(), py::arg("allow_plugins") = false,
           py::arg("allow_engines") = false,
           "`file`: a .hook file, or the text of one. `threads`: 0 is one a core. `seeds`: one a "
           "world, of its World and of the Param `seed` where the file has one; by default the "
           "file's. `set`: a dict, or a list of one a world. `observations`, `actions`: trails of "
           "ports, vectors or "
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
      .def("reset", reset_batch, py::arg("mask") = py::none(), py::kw_only(),
           py::arg("state") = py::none(), py::arg("set") = py::none(),
           py::arg("seeds") = py::none(),
           "Back to time 0: the worlds where `mask` is true, or all. `state`: as World.reset, for "
           "all worlds or with a row a world. `set`: settings that change, a dict or a list of one "
           "a world; these worlds are loaded again. `seeds`: one a world. Returns the "
           "observations. Raises Error, and then nothing has changed.")
      .def("state", &PythonBatch::state, py::arg("world"),
           "World.state of that world; a World with the same seed takes it.")
      .def("set_state", &PythonBatch::set_state, py::arg("world"), py::arg("state"),
           "World.set_state of that world.")
      .def("__len__", &PythonBatch::size)
      .def("__repr__", &PythonBatch::repr)
      .def_property_readonly("observations", &PythonBatch::observations,
                             "worlds x columns, SI; every step writes the same memory.")
      .def_property_readonly("actions", &PythonBatch::actions,
                             "worlds x columns, SI: what the next step writes; may be filled.")
      .def_property_readonly("done", &PythonBatch::done,
                             "Of each world: `done` is not 0, its run has ended, or failed.")
      .def_property_readonly("failures", &PythonBatch::failures,
                             "Why steps could not be taken: a dict by the world's index.")
      .def_property_readonly("notices", &PythonBatch::notices,
                             "Warnings of the file, and notices of worlds since their last reset: "
                             "a list of strings. Each was a UserWarning when it came.")
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

/// "solref=0.02,1" of a number, several or a word.
std::string setting_of(const std::string& name, const py::handle& value) {
  if (py::isinstance<py::str>(value)) return name + "=" + utf8(value);
  std::string text = name + "=";
  if (!py::isinstance<py::sequence>(value)) return text + text::shortest(value.cast<double>());
  for (const double number : value.cast<std::vector<double>>())
    text += (text.back() == '=' ? "" : ",") + text::shortest(number);
  return text;
}

py::object translate(const std::filesystem::path& file, const py::object& to,
                     const std::string& source, const py::dict& parameters,
                     const std::optional<std::string>& material, std::optional<double> load,
                     std::optional<double> mass, std::optional<int> contacts,
                     std::optional<double> deltat, std::optional<double> creep,
                     bool allow_plugins) {
  const auto with_unit = [](std::optional<double> value, const char* unit) {
    return value ? std::optional(text::shortest(*value) + " " + unit) : std::nullopt;
  };
  application::TranslateRequest request;
  request.file = file.string();
  request.material = material;
  request.load = with_unit(load, "N");
  request.mass = with_unit(mass, "kg");
  request.step = with_unit(deltat, "s");
  request.creep = with_unit(creep, "m/s");
  request.contacts = contacts;
  request.to = names_of(to, "to");
  request.from = source;
  for (const auto& [name, value] : parameters)
    request.given.push_back(setting_of(utf8(name), value));
  try {
    request.consent = {.plugins = allow_plugins};
    QuietApplication application(request.consent);
    const auto answers = application::translated(*application, request);
    if (!answers) application.fail();
    return py::module_::import("json").attr("loads")(translation::json_of(*answers));
  } catch (const translation::ParameterError& error) {
    throw_error(error.what());
  }
}

/// The text, and what the format does not hold.
py::tuple export_model(const std::filesystem::path& file, const std::string& to,
                       const py::object& set, const std::optional<std::string>& robot,
                       std::optional<double> creep, bool allow_plugins) {
  application::ExportRequest request;
  request.file = file;
  request.settings.trails = settings_of(set);
  request.format = to;
  request.robot = robot;
  if (creep) request.creep = text::shortest(*creep) + " m/s";
  request.consent = {.plugins = allow_plugins};
  try {
    QuietApplication application(request.consent);
    const auto model = application::exported(*application, request);
    if (!model) application.fail();
    return py::make_tuple(model->text, model->left_out);
  } catch (const translation::ParameterError& error) {
    throw_error(error.what());
  }
}

void add_functions(py::module_& module) {
  module.def(
      "load",
      [](const std::filesystem::path& file, const py::object& set,
         std::optional<std::string> engine, bool allow_plugins, bool allow_engines) {
        return world_of(
            {file, {}, settings_of(set), std::move(engine), {allow_plugins, allow_engines}});
      },
      py::arg("file"), py::kw_only(), py::arg("set") = py::dict(), py::arg("engine") = py::none(),
      py::arg("allow_plugins") = false, py::arg("allow_engines") = false,
      "The World of a .hook file at time 0. `set`: {trail or Param: value}, values as the language "
      "writes them (\"5 deg\"), or numbers in SI. Raises FileError.");
  module.def(
      "loads",
      [](const std::string& text, const py::object& set, std::optional<std::string> engine,
         const std::filesystem::path& name) {
        return world_of({name, text, settings_of(set), std::move(engine), {}});
      },
      py::arg("text"), py::kw_only(), py::arg("set") = py::dict(), py::arg("engine") = py::none(),
      py::arg("name") = "<text>",
      "The same of a text. `name`: the file that it would be, beside which its Includes are.");
  module.def(
      "study",
      [](const std::filesystem::path& file, bool quick, const py::object& only, std::int64_t jobs,
         std::optional<std::filesystem::path> out, bool resume, bool allow_plugins, bool frames,
         bool allow_engines, bool latex, bool pdf) {
        const Frames made(frames);
        application::TaskArguments arguments{
            file,   std::move(out),         threads_of(jobs, "jobs"),      quick,
            resume, names_of(only, "only"), {allow_plugins, allow_engines}};
        arguments.forms = {latex, pdf};
        return made.of(run_tasks(application::study_command, arguments));
      },
      py::arg("file"), py::kw_only(), py::arg("quick") = false, py::arg("only") = py::list(),
      py::arg("jobs") = 0, py::arg("out") = py::none(), py::arg("resume") = false,
      py::arg("allow_plugins") = false, py::arg("frames") = false, py::arg("allow_engines") = false,
      py::arg("latex") = false, py::arg("pdf") = false,
      "Runs the Studies, Walls and Matrices of a .hook file: a dict of results by their names, "
      "each with \"table\", a dict of numpy arrays by the titles of results.csv (\"slope [deg]\"), "
      "a "
      "Study also with \"tables\", its Table blocks. `out`: where the files of `hookpoint study` "
      "go, "
      "else none are kept. `frames`: every table is a pandas.DataFrame. `latex`, `pdf`: what "
      "--latex and --pdf add to these files.");
  module.def(
      "tune",
      [](const std::filesystem::path& file, bool quick, std::int64_t jobs,
         std::optional<std::filesystem::path> out, bool resume, bool allow_plugins, bool frames,
         bool allow_engines, bool latex, bool pdf) {
        const Frames made(frames);
        application::TaskArguments arguments{file,
                                             std::move(out),
                                             threads_of(jobs, "jobs"),
                                             quick,
                                             resume,
                                             {},
                                             {allow_plugins, allow_engines}};
        arguments.forms = {latex, pdf};
        return made.of(run_tasks(application::tune_command, arguments));
      },
      py::arg("file"), py::kw_only(), py::arg("quick") = false, py::arg("jobs") = 0,
      py::arg("out") = py::none(), py::arg("resume") = false, py::arg("allow_plugins") = false,
      py::arg("frames") = false, py::arg("allow_engines") = false, py::arg("latex") = false,
      py::arg("pdf") = false,
      "Runs the Tunes and Calibrates of a .hook file: a dict of results by their names, each with "
      "\"table\", a dict of numpy arrays: every evaluation of a Tune, the fitted constants of a "
      "Calibrate. `out`: where the files of `hookpoint tune` go, else none are kept. `frames`: "
      "every table is a pandas.DataFrame.");
  module.def(
      "translate", &translate, py::arg("file") = py::str(""), py::kw_only(),
      py::arg("to") = py::list(), py::arg("source") = "", py::arg("parameters") = py::dict(),
      py::arg("material") = py::none(), py::arg("load") = py::none(), py::arg("mass") = py::none(),
      py::arg("contacts") = py::none(), py::arg("deltat") = py::none(),
      py::arg("creep") = py::none(), py::arg("allow_plugins") = false,
      "Contact constants as parameters of other engines: what `hookpoint translate --json` prints, "
      "a dict, or of a World with several contacts a list of dicts. `file`: a .hook file, or the "
      "name of a material. `to`: engines, by default all. `source`: an engine whose `parameters`, "
      "a dict, are read instead of a file. `load` [N], `mass` [kg], `deltat` [s], `creep` [m/s].");
  module.def(
      "export", &export_model, py::arg("file"), py::arg("to"), py::kw_only(),
      py::arg("set") = py::dict(), py::arg("robot") = py::none(), py::arg("creep") = py::none(),
      py::arg("allow_plugins") = false,
      "A World or a robot as a model of another program, \"mjcf\", \"urdf\" or \"sdf\": its text, "
      "and a list of what that format does not hold. `robot`: this one alone. `creep` [m/s]: of the "
      "translated contact on 10 deg.");
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
  hookpoint::python::watch_the_interpreter();
  hookpoint::python::add_errors(module);
  hookpoint::python::add_world(module);
  hookpoint::python::add_batch(module);
  hookpoint::python::add_dynamics(module);
  hookpoint::python::add_functions(module);
}
