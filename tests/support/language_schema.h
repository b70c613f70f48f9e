// A schema of the tests' own: World, Robot, Chain, Link, ground, windows, controllers. It stays as
// it is when the application's classes grow, so that the expected diagnostics stay the same.
#pragma once

#include "language/schema/schema.h"

namespace hookpoint::language::testing {

inline FieldSchema field(std::string name, FieldType type, std::string unit, std::string doc) {
  FieldSchema made;
  made.name = std::move(name);
  made.type = type;
  made.unit = std::move(unit);
  made.doc = std::move(doc);
  return made;
}

inline FieldSchema number(std::string name, std::string unit, std::string doc,
                          std::string by_default = "") {
  FieldSchema made = field(std::move(name), FieldType::number, std::move(unit), std::move(doc));
  made.default_text = std::move(by_default);
  return made;
}

inline FieldSchema positive(FieldSchema made) {
  made.minimum = 0.;
  made.exclusive_minimum = true;
  return made;
}

inline FieldSchema at_least_zero(FieldSchema made) {
  made.minimum = 0.;
  return made;
}

inline FieldSchema port(FieldSchema made, Direction direction, bool setting = true) {
  made.port = direction;
  made.setting = setting;
  return made;
}

inline FieldSchema required(FieldSchema made) {
  made.required = true;
  return made;
}

inline FieldSchema vector(std::string name, std::string unit, std::string doc, int least = 3,
                          int most = 3) {
  FieldSchema made = field(std::move(name), FieldType::numbers, std::move(unit), std::move(doc));
  made.min_count = least;
  made.max_count = most;
  return made;
}

inline FieldSchema choice(std::string name, std::vector<std::string> choices, std::string doc) {
  FieldSchema made = field(std::move(name), FieldType::choice, "", std::move(doc));
  made.choices = std::move(choices);
  made.default_text = made.choices.front();
  return made;
}

inline FieldSchema object(std::string name, std::string refers_to, std::string doc) {
  FieldSchema made = field(std::move(name), FieldType::object, "", std::move(doc));
  made.refers_to = std::move(refers_to);
  return made;
}

inline ClassSchema make_class(std::string name, std::string doc, std::vector<FieldSchema> fields,
                              std::vector<std::string> children = {}) {
  ClassSchema made;
  made.name = std::move(name);
  made.doc = std::move(doc);
  made.fields = std::move(fields);
  made.children = std::move(children);
  return made;
}

inline ClassSchema at_top(ClassSchema made) {
  made.top_level = true;
  return made;
}

inline void add_ground_classes(Schema& schema) {
  schema.add(make_class("Terrain.Flat", "A horizontal plane.",
                        {number("height", "m", "Height of the plane.", "0 m"),
                         object("material", "Material", "What it is made of.")}));
  schema.add(make_class("Terrain.Slope", "An inclined plane through the origin.",
                        {number("angle", "rad", "Inclination.", "0 deg"),
                         object("material", "Material", "What it is made of.")}));
  ClassSchema material = make_class(
      "Material", "What the ground is made of.",
      {positive(number("normal_stiffness", "N/m", "Stiffness along the normal.", "100 kN/m")),
       at_least_zero(number("normal_damping", "N.s/m", "Damping along the normal.", "0")),
       at_least_zero(number("static_friction", "", "Friction coefficient at rest.", "0.8"))});
  material.naming = Naming::required;
  schema.add(material);
}

inline void add_robot_classes(Schema& schema) {
  schema.add(make_class("Robot", "A base and its chains.", {}, {"Base.", "Chain"}));
  const FieldSchema location =
      port(vector("location", "m", "Position in the world."), Direction::output);
  const FieldSchema orientation =
      port(field("orientation", FieldType::orientation, "", "Orientation in the world."),
           Direction::output);
  ClassSchema fixed =
      make_class("Base.fixed", "A base that does not move.", {location, orientation}, {"Shape."});
  fixed.default_name = "base";
  schema.add(fixed);
  ClassSchema mobile =
      make_class("Base.mobile", "A base that moves.",
                 {location, orientation, positive(number("mass", "kg", "Mass.")),
                  object("rest_on", "Terrain", "Lies at rest on this ground."),
                  port(vector("force", "N", "External force."), Direction::input, false)},
                 {"Shape."});
  mobile.default_name = "base";
  schema.add(mobile);
  schema.add(make_class("Chain", "A row of links.",
                        {vector("hip_distance", "m", "Position of the hip on the base.")},
                        {"Link"}));
  schema.add(make_class(
      "Link", "A link and the joint before it.",
      {number("dhlength", "m", "MDH a.", "0 m"), number("dhtwist", "rad", "MDH alpha.", "0 rad"),
       number("dhoffset", "m", "MDH d.", "0 m"), required(positive(number("mass", "kg", "Mass."))),
       choice("joint", {"revolute", "prismatic"}, "Kind of the joint."),
       port(number("angle", "rad", "Joint angle.", "0 rad"), Direction::output),
       port(number("rate", "rad/s", "Joint rate.", "0 rad/s"), Direction::output),
       port(number("torque", "N.m", "Joint torque.", "0 N.m"), Direction::input),
       at_least_zero(number("damping", "N.m.s/rad", "Viscous friction.", "0"))},
      {"Shape."}));
  schema.add(make_class("Shape.Cube", "A box centred on its body.",
                        {required(vector("dimensions", "m", "Edge lengths."))}));
  schema.add(make_class("Shape.Legcone", "A truncated cone along x.",
                        {required(positive(number("length", "m", "Length."))),
                         required(positive(number("proximal_radius", "m", "Radius at the joint."))),
                         positive(number("distal_radius", "m", "Radius at the end.", "1 mm"))}));
}

inline void add_control_classes(Schema& schema) {
  FieldSchema rate = positive(number("rate", "Hz", "How often it runs."));
  ClassSchema pd = at_top(
      make_class("Controller.PD", "Proportional and derivative control.",
                 {rate, at_least_zero(number("delay", "s", "How late its output is.", "0 s")),
                  port(number("goal", "rad", "Where to.", "0 rad"), Direction::input),
                  port(number("pconstant", "N.m/rad", "Proportional gain.", "0"), Direction::input),
                  port(number("dconstant", "N.m.s/rad", "Derivative gain.", "0"), Direction::input),
                  port(number("current", "rad", "The measured angle."), Direction::input, false),
                  port(number("output", "N.m", "The torque."), Direction::output, false)}));
  pd.default_input = "current";
  pd.default_output = "output";
  schema.add(pd);
  ClassSchema data =
      at_top(make_class("Data", "Values from a file.",
                        {required(field("file", FieldType::text, "", "Path of the file.")),
                         field("column", FieldType::text, "", "Name of the column."),
                         choice("interpolate", {"hold", "linear"}, "Between rows."),
                         port(number("output", "?", "The value now."), Direction::output, false)}));
  data.default_output = "output";
  schema.add(data);
}

inline void add_window_classes(Schema& schema) {
  const FieldSchema label = field("label", FieldType::text, "", "Title.");
  FieldSchema width = field("width", FieldType::integer, "", "Width in pixels.");
  FieldSchema height = field("height", FieldType::integer, "", "Height in pixels.");
  width.minimum = height.minimum = 1.;
  width.maximum = height.maximum = 10000.;
  schema.add(at_top(make_class("Window", "A window or a panel of one.", {width, height, label},
                               {"Window", "Window.", "Valuator.", "Button", "Button."})));
  schema.add(make_class(
      "Window.grob", "A camera's view of a world.",
      {vector("size", "", "Pixels.", 2, 2), object("drawer", "World", "The world that is seen."),
       port(number("zoom", "", "Magnification.", "1"), Direction::input),
       port(number("distance", "m", "Distance of the camera.", "1 m"), Direction::input),
       port(number("euler1", "rad", "Azimuth.", "0 rad"), Direction::input),
       port(number("euler2", "rad", "Elevation.", "0 rad"), Direction::input)}));
  FieldSchema value = port(number("value", "?", "Where it stands.", "0"), Direction::both);
  ClassSchema slider = make_class("Valuator.Slider", "A slider.",
                                  {vector("range", "?", "Least and greatest value.", 2, 2), value});
  slider.default_input = slider.default_output = "value";
  schema.add(slider);
  for (const std::string name : {"Button", "Button.Light"}) {
    ClassSchema button = make_class(
        name, "A button.",
        {port(field("pressed", FieldType::boolean, "", "Is it down?"), Direction::output)});
    button.default_output = "pressed";
    schema.add(button);
  }
}

inline Schema make_schema() {
  Schema schema;
  FieldSchema running =
      port(field("running", FieldType::boolean, "", "Does time pass?"), Direction::input);
  running.default_text = "true";
  FieldSchema seed = field("seed", FieldType::integer, "", "Of all random numbers.");
  seed.default_text = "1";
  ClassSchema world =
      at_top(make_class("World", "Robots and their ground.",
                        {vector("gravity", "m/s^2", "g, downwards, or a vector.", 1, 3),
                         positive(number("deltat", "s", "Time step.", "1 ms")),
                         choice("engine", {"dts", "ode", "bullet"}, "What computes the motion."),
                         at_least_zero(number("duration", "s", "How long.", "10 s")), seed, running,
                         port(number("time", "s", "Simulated time."), Direction::output, false)},
                        {"Robot", "Terrain.", "Material"}));
  schema.add(world);
  add_ground_classes(schema);
  add_robot_classes(schema);
  add_control_classes(schema);
  add_window_classes(schema);
  ClassSchema simulator = at_top(make_class(
      "Simulator", "The program itself.",
      {port(field("quit", FieldType::boolean, "", "End the program."), Direction::input, false)}));
  simulator.implicit = true;
  schema.add(simulator);
  schema.add(at_top(make_class("Record", "Ports to write to a file.",
                               {field("what", FieldType::port, "", "The port.")})));
  return schema;
}

}  // namespace hookpoint::language::testing
