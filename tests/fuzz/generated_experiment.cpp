#include "tests/fuzz/generated_experiment.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "simulation/scene/schema.h"
#include "tests/fuzz/drawn_text.h"
#include "tests/fuzz/generated_robot.h"

namespace hookpoint::fuzz {
namespace {

using language::ClassSchema;
using language::Direction;
using language::FieldType;

/// A port that a wire may start at or end at.
struct Port {
  std::string trail, unit;
};

class Generator : DrawnText {
 public:
  using DrawnText::DrawnText;

  GeneratedExperiment world() {
    const std::string contact = one_of(choices("World", "contact"));
    // Under an impulse law a robot that has a loop or a coupled joint is refused.
    constrains_ = contact.starts_with("impulse") ? 0.05 : 1.;
    const std::string integrator = one_of(choices("World", "integrator"));
    // One step of an adaptive integrator may take as many evaluations as it is allowed.
    const bool adaptive = integrator.starts_with("cvode") || integrator.starts_with("arkode");
    write("World w {");
    write("deltat = " + number(step_) + "; duration = " +
          std::to_string(adaptive ? 1 : 3 + below(8)) + " * " + number(step_) + ";");
    write("contact = " + contact + ";");
    if (!contact.starts_with("impulse") || chance(0.05)) write("integrator = " + integrator + ";");
    std::set<std::string> said{"deltat", "duration", "contact",          "integrator",
                               "engine", "gravity",  "constraint_mixing"};
    const bool peer = chance(0.25);
    if (peer) {
      write("engine = " + one_of(choices("World", "engine")) + ";");
    } else {
      said.insert("settings");  // of a peer
    }
    if (chance(0.3)) write(chance(0.5) ? "gravity = 9.81;" : "gravity = 0.5,0,-9.7;");
    fields("World", said);
    for (std::size_t i = below(3); i > 0; --i) object("Material", "m", materials_, {});
    if (!chance(0.2)) terrain();
    for (std::size_t i = 1 + below(2); i > 0; --i) robot();
    if (chance(0.15)) described_robot();
    for (std::size_t i = below(3); i > 0; --i) force();
    for (std::size_t i = below(5); i > 0; --i) component();
    if (chance(0.2)) trajectory();
    if (chance(0.2)) record();
    if (chance(peer ? 0.01 : 0.1)) write("Movie seen { }");
    write("}");
    if (chance(0.3)) expect();
    return {GeneratedCommand::run, std::move(text_), std::move(trails_), std::move(files_)};
  }

 private:
  std::string inertia() {
    const double a = between(0.5, 1.), size = 1e-2 * std::pow(10., between(-1., 1.));
    return number(a * size) + "," + number(size) + "," + number(1.2 * size) + ",0,0,0";
  }

  std::string value_of(const FieldSchema& field) {
    switch (field.type) {
      case FieldType::number:
        return one_number(field);
      case FieldType::integer: {
        if (field.name == "boundary_points" && !chance(degenerate_))
          return std::to_string(3 * below(2));
        const double greatest = std::min(field.maximum, 4.);
        return number(chance(degenerate_)
                          ? std::floor(degenerate_number(field))
                          : std::max(field.minimum, std::floor(between(0., greatest))));
      }
      case FieldType::boolean:
        return chance(0.5) ? "true" : "false";
      case FieldType::choice:
        return one_of(field.choices);
      case FieldType::numbers: {
        if (field.name == "inertia" && !chance(degenerate_)) return inertia();
        // One for all, or one each; never a number between.
        const bool all = chance(0.5);
        std::string list;
        for (int i = all ? field.max_count : field.min_count; i > 0; --i)
          list += one_number(field) + (i > 1 ? "," : "");
        return list;
      }
      case FieldType::orientation:
        if (chance(degenerate_)) return chance(0.5) ? "0,0,0,0" : "1e-300,0,0,1e300";
        if (chance(0.5)) return "0.5,-0.5,0.5,0.5";
        return number(between(-3., 3.)) + "," + number(between(-1.5, 1.5)) + "," +
               number(between(-3., 3.));
      case FieldType::object:
        return referred(field.refers_to);
      default:
        return "";
    }
  }

  /// The trail of an object that a field may refer to; "" where there is none.
  std::string referred(const std::string& classes) {
    const auto pick = [&](const std::vector<std::string>& list) {
      return list.empty() ? std::string() : one_of(list);
    };
    if (classes == "Link") return pick(links_);
    if (classes.starts_with("Material")) return pick(materials_);
    if (classes.starts_with("Terrain")) return pick(terrains_);
    if (classes.starts_with("Robot")) return pick(robots_);
    if (classes.find("Base") != std::string::npos || classes.empty()) return pick(bodies_);
    return "";
  }

  /// Some of the class's fields, the required ones all, but for those in `without`.
  void fields(const std::string& type, const std::set<std::string>& without,
              const std::set<std::string>& always = {}) {
    for (const FieldSchema& field : schema_.find(type)->fields) {
      if (!field.setting || without.contains(field.name) || field.type == FieldType::text) continue;
      if (!field.required && !always.contains(field.name) && !chance(0.12)) continue;
      const std::string value = value_of(field);
      if (!value.empty()) write(field.name + " = " + value + ";");
    }
  }

  std::string object(const std::string& type, const std::string& letter,
                     std::vector<std::string>& names, const std::set<std::string>& without) {
    const std::string name = object(type, letter, without);
    names.push_back(name);
    return name;
  }
  std::string object(const std::string& type, const std::string& letter,
                     const std::set<std::string>& without) {
    const std::string name = letter + std::to_string(named_++);
    write(type + " " + name + " {");
    fields(type, without);
    write("}");
    return name;
  }

  /// On what moves; now and then on what does not.
  void force() {
    const std::vector<std::string>& bodies = chance(0.02) ? bodies_ : moving_;
    if (bodies.empty()) return;
    const std::string kind = chance(0.5) ? "Force" : "Push";
    write(kind + " f" + std::to_string(named_++) + " {");
    write("body = " + one_of(bodies) + ";");
    fields(kind, {"body", "to"}, {"force", "duration"});
    write("}");
  }

  /// A robot of a URDF file.
  void described_robot() {
    const GeneratedRobot drawn = generate_robot(random_(), degenerate_);
    files_.insert(files_.end(), drawn.files.begin(), drawn.files.end());
    const std::string name = "u" + std::to_string(named_++);
    std::string arguments = "name = " + name + drawn.arguments;
    if (!terrains_.empty() && chance(0.5)) arguments += ", rest_on = " + one_of(terrains_);
    write("Include \"" + drawn.files.front().name + "\" (" + arguments + ");");
    trails_.push_back("w." + name + ".base.location.z");
  }

  void trajectory() {
    files_.push_back(
        {"path.csv", "t [s],a,b\n0,1,2\n" +
                         one_of(std::vector<std::string>{"0.001,2,3\n0.1,3,4\n", "0.001,2\n",
                                                         "0,2,3\n", "1e300,0,0\n", "0.002,nan,3\n",
                                                         "", "0.002,1e308,-1e308\n"})});
    write("Controller.Trajectory path { file = \"path.csv\"; }");
  }

  void record() {
    const std::string trail = trails_.empty() ? "w.time" : one_of(trails_);
    write("Record written { trails = " + trail.substr(2) +
          "; format = " + one_of(choices("Record", "format")) + ";");
    fields("Record", {"trails", "format"});
    write("}");
  }

  void expect() {
    if (trails_.empty()) return;
    write("Expect e { of = " + one_of(trails_) + ";");
    fields("Expect", {"of", "from", "to"}, {"within", "equals"});
    // No later than the run ends.
    if (chance(0.12)) write("to = " + number(between(0.5, 1.) * step_) + ";");
    write("}");
  }

  /// Heights as text, next to the file.
  void grid(const std::string& name) {
    std::string heights;
    for (int row = 0; row < 3; ++row)
      heights += number(between(-0.1, 0.1)) + " 0.01 " +
                 one_number(*schema_.find("Link")->find("dhlength")) +
                 (chance(degenerate_) ? " x\n" : "\n");
    files_.push_back({"heights.txt", heights});
    write("Terrain.Grid " + name + " { file = \"heights.txt\"; spacing = 0.5;");
    fields("Terrain.Grid", {"spacing"}, {"material"});
    write("}");
  }

  void terrain() {
    if (chance(0.1)) {
      terrains_.push_back("g" + std::to_string(named_++));
      return grid(terrains_.back());
    }
    static const std::vector<std::string> kinds{"Terrain.Flat", "Terrain.Slope", "Terrain.Steps",
                                                "Terrain.Rough"};
    const std::string& kind = one_of(kinds);
    const std::string name = "g" + std::to_string(named_++);
    write(kind + " " + name + " {");
    // Of computed grounds the size and spacing decide how many tiles are laid out.
    if (kind == "Terrain.Steps" || kind == "Terrain.Rough") {
      write("size = 2; spacing = 0.05; " +
            std::string(kind == "Terrain.Steps" ? "run" : "wavelength") + " = 0.4;");
      fields(kind, {"size", "spacing", "run", "wavelength"}, {"material"});
    } else {
      fields(kind, {}, {"material"});
    }
    if (!materials_.empty() && chance(0.2)) {
      write("Patch {");
      fields("Patch", {});
      write("}");
    }
    write("}");
    terrains_.push_back(name);
  }

  void shape(bool with_mass) {
    static const std::vector<std::string> shapes{"Shape.Box", "Shape.Cube", "Shape.Sphere",
                                                 "Shape.Cylinder", "Shape.Legcone"};
    const std::string& kind = one_of(shapes);
    write(kind + " {");
    fields(kind, with_mass ? std::set<std::string>{} : std::set<std::string>{"mass"});
    write("}");
  }

  /// Of a joint, whose numbers need one another: static friction at least the kinetic, and how fast it
  /// falls to it.
  void friction(std::set<std::string>& without) {
    without.insert({"friction", "static_friction", "stribeck_velocity"});
    if (!chance(0.2)) return;
    const double kinetic = between(0., 0.5);
    write("friction = " + number(kinetic) + ";");
    if (!chance(0.5)) return;
    write("static_friction = " + number(kinetic + between(0., 0.5)) + ";");
    if (chance(0.5)) write("stribeck_velocity = " + number(between(0.01, 1.)) + ";");
  }

  /// What stands in a body: its mass and inertia, given or of its shapes, and points.
  void body(const std::string& type, std::set<std::string> without) {
    const bool careless = chance(degenerate_);
    std::set<std::string> always;  // to be given
    const std::size_t shapes = below(3);
    if (!careless) {
      if (type == "Link") friction(without);
      always.insert("mass");
      if (shapes == 0) always.insert("inertia");
      without.insert({"lower_limit", "upper_limit"});
      // What a joint that follows another begins at is none of its own.
      if (type == "Link" && !without.contains("rate") && chance(0.2))
        write("lower_limit = -1.5; upper_limit = " + number(between(0., 1.5)) + "; angle = -0.01;");
    }
    fields(type, without, always);
    for (std::size_t i = shapes; i > 0; --i) shape(careless);
    for (std::size_t i = chance(0.3) ? 1 + below(3) : 0; i > 0; --i) {
      write("ContactPoint {");
      fields("ContactPoint", {});
      write("}");
    }
  }

  void joint_ports(const std::string& link, bool turns) {
    sources_.push_back({link + ".angle", turns ? "rad" : "m"});
    sources_.push_back({link + ".rate", turns ? "rad/s" : "m/s"});
    drives_.push_back({link + ".torque", turns ? "N.m" : "N"});
    for (const char* port : {".angle", ".rate", ".acceleration", ".total_torque"})
      trails_.push_back("w." + link + port);
  }

  std::vector<std::string> links_of(const std::string& robot) const {
    std::vector<std::string> links;
    std::ranges::copy_if(links_, std::back_inserter(links),
                         [&](const std::string& link) { return link.starts_with(robot + "."); });
    return links;
  }

  /// Two links tied together, by a spring at places that need not meet, or exactly.
  void loop(const std::string& robot) {
    const std::vector<std::string> links = links_of(robot);
    if (links.size() < 2 || !chance(0.2 * constrains_)) return;
    write("Loop { a = " + links[0] + "; b = " + links[1 + below(links.size() - 1)] + ";");
    std::set<std::string> always;
    if (chance(0.7)) {
      write("point_a = 0.1, 0, 0;");
      always.insert("stiffness");
    }
    fields("Loop",
           {"a", "b", "axis", "point_a", always.empty() ? "stiffness" : "",
            always.empty() ? "damping" : ""},
           always);
    write("}");
  }

  /// A part of what carries it: what belongs to a joint it has not.
  void fixed_link(const std::string& trail) {
    write("joint = fixed;");
    static const std::set<std::string> has{
        "mass",    "center_of_mass", "inertia", "material",       "dhlength",
        "dhtwist", "dhoffset",       "dhangle", "joint_location", "joint_orientation"};
    std::set<std::string> without;
    for (const auto& field : schema_.find("Link")->fields)
      if (!has.contains(field.name)) without.insert(field.name);
    body("Link", without);
    write("}");
    if (!moving_.empty() && moving_.back().starts_with(trail.substr(0, trail.rfind('.') + 1)))
      moving_.push_back(trail);
  }

  void chain(const std::string& robot) {
    const std::string name = "c" + std::to_string(named_++);
    write("Chain " + name + " {");
    fields("Chain", {});
    for (std::size_t i = chance(0.3 * degenerate_) ? 0 : 1 + below(3); i > 0; --i) {
      const std::string link = "l" + std::to_string(named_++),
                        trail = robot + "." + name + "." + link;
      write("Link " + link + " {");
      if (chance(0.15)) {
        fixed_link(trail);
        continue;
      }
      const bool turns = chance(0.75);
      if (!turns) write("joint = prismatic;");
      std::set<std::string> without{"joint", "angle", "mimic", "mimic_ratio", "mimic_offset"};
      if (const std::vector<std::string> leaders = links_of(robot);
          !leaders.empty() && chance(0.1 * constrains_)) {
        write("mimic = " + one_of(leaders) + "; mimic_ratio = " + number(between(-2., 2.)) + ";");
        without.insert("rate");
      }
      body("Link", without);
      write("}");
      links_.push_back(trail);
      bodies_.push_back(trail);
      moving_.push_back(trail);
      joint_ports(trail, turns);
    }
    write("}");
  }

  void robot() {
    const std::string name = "r" + std::to_string(named_++);
    const bool fixed = chance(0.3);
    write("Robot " + name + " {");
    write(fixed ? "Base.fixed {" : "Base.mobile {");
    const bool placed = !chance(0.5) || terrains_.empty();
    if (placed && !fixed) write("location = 0, 0, " + number(between(0., 0.6)) + ";");
    if (!placed && !fixed) write("rest_on = " + one_of(terrains_) + ";");
    std::set<std::string> without{"rest_on", "at", "yaw", "settled", "location"};
    if (!placed) without = {"rest_on", "location", "orientation"};
    if (fixed) without.insert({"velocity", "angular_velocity"});
    body(fixed ? "Base.fixed" : "Base.mobile", without);
    write("}");
    bodies_.push_back(name + ".base");
    if (!fixed) moving_.push_back(name + ".base");
    for (const char* port :
         {".base.location.x", ".base.location.z", ".base.velocity.y", ".base.angular_velocity.x",
          ".base.contact.force.z", ".base.linear_acceleration.z", ".kinetic_energy"})
      trails_.push_back("w." + name + port);
    sources_.push_back({name + ".base.location.z", "m"});
    sources_.push_back({name + ".base.velocity.x", "m/s"});
    for (std::size_t i = chance(0.3) ? 0 : 1 + below(3); i > 0; --i) chain(name);
    loop(name);
    write("}");
    robots_.push_back(name);
  }

  /// Classes that may stand where a controller does and need no file.
  const std::vector<std::string>& component_classes() {
    if (!components_.empty()) return components_;
    for (const auto& [name, type] : schema_.classes()) {
      const bool file = type.find("file") != nullptr;
      for (const std::string& family : simulation::component_families()) {
        if (!file && (name == family || (family.ends_with(".") && name.starts_with(family))))
          components_.push_back(name);
      }
    }
    return components_;
  }

  /// What a component of formulas needs.
  void formulas(const std::string& type) {
    static const std::vector<std::string> of_time{"sin(3 * time / 1 s)", "time / period",
                                                  "0.5 * previous + 1", "1 / (time - time)"};
    if (type == "Expression") write("formula = \"" + one_of(of_time) + "\";");
    if (type != "StateMachine") return;
    write("State still { output = \"0\"; } State moved { output = \"2 * time_in_state / 1 s\"; }");
    write("Transition start { from = still; to = moved; when = \"time_in_state > 3 ms\"; }");
    if (chance(0.5))
      write("Transition stop { from = moved; to = still; when = \"time_in_state > 1 ms\"; }");
  }

  void component() {
    const std::string& type = one_of(component_classes());
    const ClassSchema& described = *schema_.find(type);
    const std::string name = "k" + std::to_string(named_++);
    write(type + " " + name + " {");
    std::set<std::string> attached;
    for (const FieldSchema& field : described.fields) {
      if (field.type == FieldType::object) attached.insert(field.name);
    }
    fields(type, {}, attached);
    formulas(type);
    for (const FieldSchema& field : described.fields) {
      const bool scalar = field.type == FieldType::number;
      const bool out = field.port == Direction::output && !field.setting;
      const bool in = field.port == Direction::both || field.port == Direction::input;
      if (scalar && in && chance(0.1)) {
        std::vector<Port> fitting;
        std::ranges::copy_if(sources_, std::back_inserter(fitting), [&](const Port& source) {
          return field.unit == "?" || field.unit == source.unit;
        });
        if (!fitting.empty())
          write("Wire FROM " + one_of(fitting).trail + " TO " + field.name + ";");
      }
      if (!scalar || !out) continue;
      for (auto drive = drives_.begin(); drive != drives_.end(); ++drive) {
        if (!(field.unit == "?" || field.unit == drive->unit) || !chance(0.3)) continue;
        write("Wire FROM " + field.name + " TO " + drive->trail + ";");
        drives_.erase(drive);  // an input takes one wire
        break;
      }
      trails_.push_back("w." + name + "." + field.name);
      if (field.unit != "?") sources_.push_back({name + "." + field.name, field.unit});
    }
    write("}");
  }

  const double step_ = 1e-5 * std::pow(10., between(0., 2.5));
  std::vector<std::string> trails_, materials_, terrains_, robots_, links_, bodies_, moving_,
      components_;
  std::vector<Port> sources_, drives_;
  std::vector<GeneratedFile> files_;
  std::size_t named_ = 0;
  double constrains_ = 1.;  ///< how often, of what may be, a loop or a coupled joint is there
};

}  // namespace

GeneratedExperiment generate_experiment(const language::Schema& schema, std::uint64_t seed) {
  GeneratedExperiment drawn = Generator(schema, seed).world();
  drawn.dynamics = seed % 3 == 0;
  return drawn;
}

}  // namespace hookpoint::fuzz
