#include "reference/mujoco/model.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "math/principal_axes.h"
#include "reference/ground.h"
#include "reference/mujoco/vertices.h"
#include "reference/solids.h"
#include "reference/touching_points.h"
#include "simulation/experiment/loop_places.h"

namespace hookpoint::reference {
namespace {

constexpr int max_contacts = 250;

/// The model's text. Numbers read back to the last bit, in any locale.
class Text {
 public:
  Text& operator<<(std::string_view words) {
    text_ += words;
    return *this;
  }
  Text& operator<<(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text_.append(digits.data(), end) += ' ';
    return *this;
  }
  Text& operator<<(const Vector3d& a) { return *this << a.x << a.y << a.z; }
  Text& operator<<(const Quaterniond& q) { return *this << q.w << q.x << q.y << q.z; }
  const std::string& str() const { return text_; }

 private:
  std::string text_;
};

std::string name(char kind, std::size_t index) { return kind + std::to_string(index); }

class Builder {
 public:
  Builder(const simulation::Experiment& experiment, const RobotTree& tree,
          const MujocoSettings& settings)
      : experiment_(experiment), tree_(tree), solids_(solids_of(experiment)) {
    write_options(settings);
    write_assets();
    text_ << "<worldbody>";
    if (experiment.terrain) write_ground(ground_of(*experiment.terrain));
    for (std::size_t i = 0; i < solids_.size(); ++i) write_solid(i);
    for (const std::size_t base : tree.bases) write_body(base);
    text_ << "</worldbody>";
    write_constraints();
    text_ << "</mujoco>";
  }

  const std::string& text() const { return text_.str(); }

  /// Heights of a grid between 0 and 1; its cells have the language's diagonal.
  void fill_heights(mjModel& model) const {
    const auto* grid = std::get_if<simulation::GridSpec>(&experiment_.terrain->surface);
    if (grid == nullptr || grid->stairs) return;
    const auto [low, high] = std::ranges::minmax(grid->heights);
    for (std::size_t i = 0; i < grid->heights.size(); ++i)
      model.hfield_data[i] =
          high > low ? static_cast<float>((grid->heights[i] - low) / (high - low)) : 0.f;
  }

  /// Places of loops, of which the compiler would take those at joint angles 0.
  void place_loops(mjModel& model) const {
    std::size_t row = 0;
    for_each_place([&](const TreeBody& a, const TreeBody& b, const simulation::LoopPlace& place) {
      const int id = mj_name2id(&model, mjOBJ_EQUALITY, name('l', row++).c_str());
      const Vector3d p = place[0] - offset(a), q = place[1] - offset(b);
      const std::array values{p.x, p.y, p.z, q.x, q.y, q.z};
      std::ranges::copy(values, model.eq_data + mjNEQDATA * id);
    });
  }

  /// Of each geometry of the model that was compiled from the text.
  std::vector<MujocoGeometry> geometries(const mjModel& model) const {
    std::vector<MujocoGeometry> result(static_cast<std::size_t>(model.ngeom));
    const auto set = [&](const std::string& named, const MujocoGeometry& geometry) {
      const int id = mj_name2id(&model, mjOBJ_GEOM, named.c_str());
      if (id >= 0) result[static_cast<std::size_t>(id)] = geometry;
    };
    for (std::size_t i = 0; i < solids_.size(); ++i)
      if (solids_[i].obstacle) set(name('o', i), {false, solids_[i].material, solids_[i].obstacle});
    for (std::size_t i = 0; i < tree_.bodies.size(); ++i) {
      set(name('g', i), {true, simulation::no_material});
      const auto& shapes = tree_.bodies[i].body->shapes;
      for (std::size_t k = 0; k < shapes.size(); ++k)
        set(name('c', i) + name('s', k), {true, shapes[k].material});
    }
    return result;
  }

  /// Where MuJoCo has the body's frame: of a base that moves at its centre of mass, because a free
  /// joint is integrated where its frame is.
  static Vector3d offset(const TreeBody& body) {
    return body.link == nullptr && body.mobile ? body.body->mass.center_of_mass : Vector3d{};
  }

 private:
  void write_options(const MujocoSettings& settings) {
    // The compiler changes nothing: masses and inertias are those written.
    text_ << "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\" balanceinertia=\"false\""
             " boundmass=\"0\" boundinertia=\"0\" autolimits=\"true\"/><option timestep=\""
          << experiment_.deltat << "\" gravity=\"" << experiment_.gravity << "\" cone=\""
          << (settings.friction.elliptic ? "elliptic" : "pyramidal") << "\" impratio=\""
          << settings.friction.impedance_ratio << "\" tolerance=\"" << settings.tolerance
          << "\" noslip_iterations=\"" << std::to_string(settings.no_slip_iterations)
          << "\" integrator=\"Euler\" solver=\"Newton\"/>";
    // Room for contacts and their rows, whose square is the size of a matrix. Beyond it MuJoCo
    // drops some and warns, which becomes a notice.
    text_ << "<size nconmax=\"" << std::to_string(max_contacts) << "\" njmax=\""
          << std::to_string(4 * max_contacts) << "\"/>";
    // A robot's shapes (affinity 1) meet the ground (type 1), never each other.
    text_ << "<default><geom contype=\"0\" conaffinity=\"1\" margin=\"0\" gap=\"0\"/></default>";
  }

  void write_assets() {
    text_ << "<asset>";
    if (experiment_.terrain)
      if (const auto* grid = std::get_if<simulation::GridSpec>(&experiment_.terrain->surface);
          grid != nullptr && !grid->stairs)
        write_height_field(*grid);
    for (std::size_t i = 0; i < solids_.size(); ++i) write_mesh(solids_[i].geometry, name('o', i));
    for (std::size_t i = 0; i < tree_.bodies.size(); ++i)
      for (std::size_t k = 0; k < tree_.bodies[i].body->shapes.size(); ++k)
        write_mesh(tree_.bodies[i].body->shapes[k].geometry, name('c', i) + name('s', k));
    text_ << "</asset>";
  }

  /// Of a shape that is none of MuJoCo's own.
  void write_mesh(const simulation::ShapeGeometry& geometry, const std::string& named) {
    const std::vector<Vector3d> vertices = mujoco_vertices(geometry);
    if (vertices.empty()) return;
    text_ << "<mesh name=\"" << named << "\" vertex=\"";
    for (const Vector3d& vertex : vertices) text_ << vertex;
    text_ << "\"/>";
  }

  void write_height_field(const simulation::GridSpec& grid) {
    const auto [low, high] = std::ranges::minmax(grid.heights);
    const double spacing = experiment_.terrain->spacing;
    text_ << "<hfield name=\"ground\" nrow=\"" << std::to_string(grid.rows) << "\" ncol=\""
          << std::to_string(grid.columns) << "\" size=\"" << 0.5 * spacing * (grid.columns - 1)
          << 0.5 * spacing * (grid.rows - 1) << std::max(high - low, 1e-3) << 1. << "\"/>";
  }

  /// A step of stairs is the world's, an obstacle a body of its own that is put where it is to be.
  void write_solid(std::size_t index) {
    const Solid& solid = solids_[index];
    const std::string named = name('o', index);
    if (solid.obstacle)
      text_ << "<body name=\"" << named << "\" mocap=\"true\" pos=\"" << solid.pose.position
            << "\" quat=\"" << solid.pose.orientation << "\">";
    text_ << "<geom name=\"" << named << "\" contype=\"1\" conaffinity=\"0\" ";
    if (!solid.obstacle)
      text_ << "pos=\"" << solid.pose.position << "\" quat=\"" << solid.pose.orientation << "\" ";
    std::visit([&](const auto& geometry) { write_shape(geometry, named); }, solid.geometry);
    text_ << (solid.obstacle ? "\"/></body>" : "\"/>");
  }

  void write_ground(const Ground& ground) {
    if (std::holds_alternative<GroundStairs>(ground)) return;
    text_ << "<geom name=\"ground\" contype=\"1\" conaffinity=\"0\" ";
    if (const auto* plane = std::get_if<GroundPlane>(&ground)) {
      const Vector3d& n = plane->normal;
      // The shortest turn from z to n.
      const Quaterniond turn = normalized(Quaterniond{1. + n.z, -n.y, n.x, 0.});
      text_ << "type=\"plane\" size=\"0 0 1\" pos=\"" << plane->offset * n << "\" quat=\"" << turn
            << "\"/>";
      return;
    }
    const auto& grid = std::get<simulation::GridSpec>(experiment_.terrain->surface);
    const double spacing = experiment_.terrain->spacing;
    const Vector3d center{grid.origin_x + 0.5 * spacing * (grid.columns - 1),
                          grid.origin_y + 0.5 * spacing * (grid.rows - 1),
                          std::ranges::min(grid.heights)};
    text_ << "type=\"hfield\" hfield=\"ground\" pos=\"" << center << "\"/>";
  }

  void write_body(std::size_t index) {
    const TreeBody& body = tree_.bodies[index];
    simulation::Pose at{body.initial.position, body.initial.orientation};
    if (body.parent >= 0) {
      at = body.X_PL0;
      at.position = at.position - offset(tree_.bodies[static_cast<std::size_t>(body.parent)]);
    }
    at.position += rotate(at.orientation, offset(body));
    text_ << "<body name=\"" << name('b', index) << "\" pos=\"" << at.position << "\" quat=\""
          << at.orientation << "\">";
    write_joint(body, index);
    if (body.mobile) write_inertia(body);
    write_geometries(body, index);
    for (std::size_t i = index + 1; i < tree_.bodies.size(); ++i)
      if (tree_.bodies[i].parent == static_cast<int>(index)) write_body(i);
    text_ << "</body>";
  }

  void write_joint(const TreeBody& body, std::size_t index) {
    if (body.link == nullptr) {
      // Without it a body is part of the world and stays where it is.
      if (body.plane_normal) return write_plane(body, index);
      if (body.mobile) text_ << "<freejoint name=\"" << name('j', index) << "\"/>";
      return;
    }
    text_ << "<joint name=\"" << name('j', index) << "\" type=\""
          << (body.turns() ? "hinge" : "slide") << "\" axis=\"0 0 1\" damping=\"0\" armature=\""
          << body.link->rotor_inertia << "\"/>";
  }

  /// Two slides and a turn about where the body's frame is. Their axes are in the body's own frame
  /// as it stands in the model.
  void write_plane(const TreeBody& body, std::size_t index) {
    const PlaneAxes axes = plane_axes(*body.plane_normal);
    const Quaterniond to_body = conjugate(body.initial.orientation);
    text_ << "<joint name=\"" << name('j', index) << "\" type=\"slide\" axis=\""
          << rotate(to_body, axes.first) << "\"/><joint type=\"slide\" axis=\""
          << rotate(to_body, axes.second) << "\"/><joint type=\"hinge\" axis=\""
          << rotate(to_body, axes.normal) << "\"/>";
  }

  template <class Visit>
  void for_each_place(const Visit& visit) const {
    for (const simulation::LoopSpec& loop : experiment_.loops)
      for (const simulation::LoopPlace& place : simulation::loop_places(loop))
        visit(tree_.bodies[tree_.index(loop.robot, loop.body_a)],
              tree_.bodies[tree_.index(loop.robot, loop.body_b)], place);
  }

  /// Loops and coupled joints. `matched`: as stiff as MuJoCo lets a step of that length be.
  void write_constraints() {
    text_ << "<equality>";
    std::size_t row = 0;
    for_each_place([&](const TreeBody& a, const TreeBody& b, const simulation::LoopPlace&) {
      text_ << "<connect name=\"" << name('l', row++) << "\" body1=\"" << body_name(a)
            << "\" body2=\"" << body_name(b) << "\" anchor=\"0 0 0\"" << stiffest() << "/>";
    });
    for (const simulation::CouplingSpec& coupling : experiment_.couplings)
      text_ << "<joint joint1=\"" << joint_name(coupling.robot, coupling.follower) << "\" joint2=\""
            << joint_name(coupling.robot, coupling.leader) << "\" polycoef=\"" << coupling.offset
            << coupling.ratio << "0 0 0\"" << stiffest() << "/>";
    text_ << "</equality>";
  }
  std::string stiffest() const {
    if (experiment_.settings != "matched") return "";
    Text text;
    text << " solref=\"" << 2. * experiment_.deltat << "1\" solimp=\"0.9999 0.9999 0.001\"";
    return text.str();
  }
  std::string body_name(const TreeBody& body) const {
    return name('b', static_cast<std::size_t>(&body - tree_.bodies.data()));
  }
  std::string joint_name(int robot, std::size_t joint) const {
    return name('j', tree_.index(robot, static_cast<int>(joint) + 1));
  }

  void write_inertia(const TreeBody& body) {
    const simulation::MassSpec& mass = body.body->mass;
    const PrincipalAxes axes = principal_axes(mass.inertia);
    text_ << "<inertial mass=\"" << mass.mass << "\" pos=\"" << mass.center_of_mass - offset(body)
          << "\" quat=\"" << axes.orientation << "\" diaginertia=\"" << axes.moments << "\"/>";
  }

  void write_geometries(const TreeBody& body, std::size_t index) {
    if (!body.mobile) return;
    if (!touching_points(experiment_, *body.body, index).empty())
      text_ << "<geom name=\"" << name('g', index)
            << "\" type=\"sphere\" size=\"0.001\" conaffinity=\"0\"/>";
    for (std::size_t k = 0; k < body.body->shapes.size(); ++k) {
      const simulation::ShapeSpec& shape = body.body->shapes[k];
      if (!touches_as_it_is(experiment_, shape)) continue;
      const std::string named = name('c', index) + name('s', k);
      text_ << "<geom name=\"" << named << "\" pos=\"" << shape.location - offset(body)
            << "\" quat=\"" << shape.orientation << "\" ";
      std::visit([&](const auto& geometry) { write_shape(geometry, named); }, shape.geometry);
      text_ << "\"/>";
    }
  }

  void write_shape(const simulation::Box& box, const std::string& /*named*/) {
    text_ << "type=\"box\" size=\"" << 0.5 * box.dimensions;
  }
  void write_shape(const simulation::Sphere& sphere, const std::string& /*named*/) {
    text_ << "type=\"sphere\" size=\"" << sphere.radius;
  }
  void write_shape(const simulation::Cylinder& cylinder, const std::string& /*named*/) {
    text_ << "type=\"cylinder\" size=\"" << cylinder.radius << 0.5 * cylinder.length;
  }
  void write_shape(const simulation::Capsule& capsule, const std::string& /*named*/) {
    text_ << "type=\"capsule\" size=\"" << capsule.radius << 0.5 * capsule.length;
  }
  template <class Meshed>
  void write_shape(const Meshed&, const std::string& named) {
    text_ << "type=\"mesh\" mesh=\"" << named;
  }

  const simulation::Experiment& experiment_;
  const RobotTree& tree_;
  std::vector<Solid> solids_;
  Text text_;
};

}  // namespace

MujocoModel make_mujoco_model(const simulation::Experiment& experiment, const RobotTree& tree,
                              const MujocoSettings& settings) {
  const Builder builder(experiment, tree, settings);
  MujocoModel result;
  try {
    result.model = compile_mujoco(builder.text());
  } catch (const MujocoFailure& failure) {
    throw simulation::ExperimentError(std::string("engine mujoco: ") + failure.what());
  }
  const mjModel& model = *result.model;
  if (experiment.terrain) builder.fill_heights(*result.model);
  builder.place_loops(*result.model);
  result.geometries = builder.geometries(model);
  result.ground = std::max(mj_name2id(&model, mjOBJ_GEOM, "ground"), 0);
  for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
    MujocoBody body;
    body.id = mj_name2id(&model, mjOBJ_BODY, name('b', i).c_str());
    body.geometry = mj_name2id(&model, mjOBJ_GEOM, name('g', i).c_str());
    body.offset = Builder::offset(tree.bodies[i]);
    const int joint = mj_name2id(&model, mjOBJ_JOINT, name('j', i).c_str());
    if (joint >= 0) {
      body.position = model.jnt_qposadr[joint];
      body.velocity = model.jnt_dofadr[joint];
    }
    result.bodies.push_back(body);
  }
  return result;
}

}  // namespace hookpoint::reference
