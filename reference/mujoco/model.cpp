#include "reference/mujoco/model.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include "reference/ground.h"
#include "reference/principal_axes.h"
#include "reference/touching_points.h"

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

/// Corners of a Legcone, 32 around each end: MuJoCo has no cone, and takes the hull of them.
Text& operator<<(Text& text, const simulation::Legcone& cone) {
  constexpr int sides = 32;
  for (const auto& [x, radius] :
       {std::pair{0., cone.proximal_radius}, std::pair{cone.length, cone.distal_radius}})
    for (int i = 0; i < sides; ++i) {
      const double angle = 2. * std::numbers::pi * i / sides;
      text << Vector3d{x, radius * std::cos(angle), radius * std::sin(angle)};
    }
  return text;
}

class Builder {
 public:
  Builder(const simulation::Experiment& experiment, const RobotTree& tree,
          const MujocoSettings& settings)
      : experiment_(experiment), tree_(tree) {
    write_options(settings);
    write_assets();
    text_ << "<worldbody>";
    if (experiment.terrain) write_ground(ground_of(*experiment.terrain));
    for (const std::size_t base : tree.bases) write_body(base);
    text_ << "</worldbody></mujoco>";
  }

  const std::string& text() const { return text_.str(); }

  /// Heights of a grid between 0 and 1; its cells have the language's diagonal.
  void fill_heights(mjModel& model) const {
    const auto* grid = std::get_if<simulation::GridSpec>(&experiment_.terrain->surface);
    if (grid == nullptr) return;
    const auto [low, high] = std::ranges::minmax(grid->heights);
    for (std::size_t i = 0; i < grid->heights.size(); ++i)
      model.hfield_data[i] =
          high > low ? static_cast<float>((grid->heights[i] - low) / (high - low)) : 0.f;
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
          << (settings.elliptic ? "elliptic" : "pyramidal") << "\" impratio=\""
          << settings.friction_impedance << "\" tolerance=\"" << settings.tolerance
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
      if (const auto* grid = std::get_if<simulation::GridSpec>(&experiment_.terrain->surface))
        write_height_field(*grid);
    for (std::size_t i = 0; i < tree_.bodies.size(); ++i)
      for (std::size_t k = 0; k < tree_.bodies[i].body->shapes.size(); ++k)
        if (const auto* cone =
                std::get_if<simulation::Legcone>(&tree_.bodies[i].body->shapes[k].geometry)) {
          text_ << "<mesh name=\"" << name('c', i) << name('s', k) << "\" vertex=\"";
          text_ << *cone << "\"/>";
        }
    text_ << "</asset>";
  }

  void write_height_field(const simulation::GridSpec& grid) {
    const auto [low, high] = std::ranges::minmax(grid.heights);
    const double spacing = experiment_.terrain->spacing;
    text_ << "<hfield name=\"ground\" nrow=\"" << std::to_string(grid.rows) << "\" ncol=\""
          << std::to_string(grid.columns) << "\" size=\"" << 0.5 * spacing * (grid.columns - 1)
          << 0.5 * spacing * (grid.rows - 1) << std::max(high - low, 1e-3) << 1. << "\"/>";
  }

  void write_ground(const Ground& ground) {
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

  void write_inertia(const TreeBody& body) {
    const simulation::MassSpec& mass = body.body->mass;
    const PrincipalAxes axes = principal_axes(mass.inertia);
    text_ << "<inertial mass=\"" << mass.mass << "\" pos=\"" << mass.center_of_mass - offset(body)
          << "\" quat=\"" << axes.orientation << "\" diaginertia=\"" << axes.moments << "\"/>";
  }

  void write_geometries(const TreeBody& body, std::size_t index) {
    if (!experiment_.terrain || !body.mobile) return;
    if (touches_by_points(experiment_, body.robot)) {
      text_ << "<geom name=\"" << name('g', index)
            << "\" type=\"sphere\" size=\"0.001\" conaffinity=\"0\"/>";
      return;
    }
    for (std::size_t k = 0; k < body.body->shapes.size(); ++k) {
      const simulation::ShapeSpec& shape = body.body->shapes[k];
      text_ << "<geom pos=\"" << shape.location - offset(body) << "\" quat=\"" << shape.orientation
            << "\" ";
      std::visit([&](const auto& geometry) { write_shape(geometry, index, k); }, shape.geometry);
      text_ << "\"/>";
    }
  }

  void write_shape(const simulation::Box& box, std::size_t, std::size_t) {
    text_ << "type=\"box\" size=\"" << 0.5 * box.dimensions;
  }
  void write_shape(const simulation::Sphere& sphere, std::size_t, std::size_t) {
    text_ << "type=\"sphere\" size=\"" << sphere.radius;
  }
  void write_shape(const simulation::Cylinder& cylinder, std::size_t, std::size_t) {
    text_ << "type=\"cylinder\" size=\"" << cylinder.radius << 0.5 * cylinder.length;
  }
  void write_shape(const simulation::Legcone&, std::size_t body, std::size_t shape) {
    text_ << "type=\"mesh\" mesh=\"" << name('c', body) << name('s', shape);
  }

  const simulation::Experiment& experiment_;
  const RobotTree& tree_;
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
  result.ground = mj_name2id(&model, mjOBJ_GEOM, "ground");
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
