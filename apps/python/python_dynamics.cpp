#include "apps/python/python_dynamics.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "apps/python/errors.h"
#include "apps/python/made_whole.h"
#include "apps/python/python_world.h"
#include "language/names.h"
#include "simulation/analysis/controller_terms.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;
using simulation::ControllerTerms;

py::array_t<double> vector(const std::vector<double>& numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::array_t<double> matrix(const std::vector<double>& numbers, std::size_t columns) {
  const std::size_t rows = columns == 0 ? 0 : numbers.size() / columns;
  return py::array_t<double>({rows, columns}, numbers.data());
}

/// The terms as an object of Python.
struct PythonDynamics : MadeWhole, ControllerTerms {
  using ControllerTerms::ControllerTerms;
};

/// The index of `name` among `names`; "" is the first. Throws hookpoint.Error.
std::size_t index_of(const std::string& name, const std::vector<std::string>& names,
                     const char* what) {
  if (name.empty() && !names.empty()) return 0;
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string nearest = language::nearest_name(name, names);
  throw_error(fmt::format("there is no {} `{}`{}", what, name,
                          nearest.empty() ? "" : "; did you mean `" + nearest + "`?"));
}

std::unique_ptr<PythonDynamics> dynamics_of(const PythonWorld& world, const std::string& robot) {
  std::vector<std::string> names;
  for (const simulation::RobotSpec& spec : world.experiment().robots) names.push_back(spec.name);
  if (names.empty()) throw_error("the world has no robot");
  return make_whole<PythonDynamics>(world.experiment(), index_of(robot, names, "robot"),
                                    world.motion());
}

py::array_t<double> jacobian(const PythonDynamics& terms, const std::string& body,
                             const std::array<double, 3>& point) {
  const std::size_t index = index_of(body, terms.bodies(), "body");
  return matrix(terms.jacobian(index, {point[0], point[1], point[2]}), terms.coordinates().size());
}

py::tuple linearised(const PythonDynamics& terms, std::optional<std::vector<double>> torques) {
  const std::size_t joints = terms.bodies().size() - 1;
  if (!torques) torques.emplace(joints);
  if (torques->size() != joints)
    throw_error(
        fmt::format("the robot has {} joints: {} torques were given", joints, torques->size()));
  const simulation::LinearisedRobot linear = terms.linearised(*torques);
  return py::make_tuple(matrix(linear.A, 2 * terms.coordinates().size()), matrix(linear.B, joints));
}

}  // namespace

void add_dynamics(py::module_& module) {
  py::class_<PythonDynamics> terms(
      module, "RobotDynamics",
      "A robot's equations of motion, M v' + h = S tau + J^T f, at the instant at which it was "
      "made. v: angular velocity and velocity of a mobile base, world axes, then the joints' "
      "rates.");
  terms
      .def_property_readonly(
          "coordinates",
          [](const PythonDynamics& own) {
            py::list list;
            for (const auto& [trail, unit] : own.coordinates())
              list.append(py::make_tuple(trail, unit));
            return list;
          },
          "(trail, unit) of each coordinate of v.")
      .def_property_readonly(
          "bodies", [](const PythonDynamics& own) { return own.bodies(); },
          "Names that `jacobian` takes: \"base\", \"leg.thigh\".")
      .def_property_readonly(
          "mass_matrix",
          [](const PythonDynamics& own) {
            return matrix(own.mass_matrix(), own.coordinates().size());
          },
          "M, (n, n): the kinetic energy is v.M v / 2.")
      .def_property_readonly(
          "bias_forces", [](const PythonDynamics& own) { return vector(own.bias_forces()); },
          "h, (n,): what velocities and gravity take. Joints' own springs, dampers and friction "
          "and the ground are not in it.")
      .def_property_readonly(
          "gravity_forces", [](const PythonDynamics& own) { return vector(own.gravity_forces()); },
          "The part of h that is there at rest, (n,).")
      .def_property_readonly(
          "mass", [](const PythonDynamics& own) { return own.center_of_mass().mass; },
          "Of all that moves [kg].")
      .def_property_readonly(
          "center_of_mass",
          [](const PythonDynamics& own) {
            const Vector3d& c = own.center_of_mass().position;
            return vector({c.x, c.y, c.z});
          },
          "Of all that moves, world axes [m].")
      .def_property_readonly(
          "center_of_mass_jacobian",
          [](const PythonDynamics& own) {
            return matrix(own.center_of_mass().jacobian, own.coordinates().size());
          },
          "(3, n): its velocity is this times v.")
      .def("__repr__",
           [](const PythonDynamics& own) {
             return fmt::format("<hookpoint.RobotDynamics of {} bodies, {} coordinates, {:g} kg>",
                                own.bodies().size(), own.coordinates().size(),
                                own.center_of_mass().mass);
           })
      .def("jacobian", jacobian, py::arg("body"), py::arg("point") = std::array<double, 3>{},
           "(6, n): the angular velocity of the body and the velocity of its point `point` (body "
           "axes, m), world axes, of unit rates. Raises Error.")
      .def("linearise", linearised, py::arg("torques") = py::none(),
           "(A, B) of x' = A x + B u about the state: x displacements (of a mobile base a rotation "
           "vector, then its place) and v, u torques of the drives; `torques`: what they give at "
           "the state, by default 0. Joints' springs, dampers and friction are in it, the ground "
           "is not.");
  const py::object world = module.attr("World");
  world.attr("dynamics") = py::cpp_function(
      dynamics_of, py::name("dynamics"), py::is_method(world), py::arg("robot") = "",
      py::keep_alive<0, 1>(),
      "RobotDynamics of a robot, by default the first, at the present instant, whatever engine "
      "moves it. Raises Error.");
}

}  // namespace hookpoint::python
