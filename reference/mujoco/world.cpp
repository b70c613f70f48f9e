#include "reference/mujoco/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

#include "reference/contact_limit.h"
#include "reference/experiment_checks.h"
#include "reference/external_forces.h"
#include "reference/mujoco/friction.h"
#include "reference/mujoco/model.h"
#include "reference/mujoco_materials.h"
#include "reference/pair_materials.h"
#include "reference/touching_points.h"
#include "simulation/experiment/loop_places.h"
#include "simulation/experiment/names.h"

static_assert(std::is_same_v<mjtNum, double>,
              "the tables say that MuJoCo runs in double precision");

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::JointState;

bool finite(const mjtNum* values, int count) {
  return std::all_of(values, values + count, [](double x) { return std::isfinite(x); });
}

/// MuJoCo has their rows, three each, ahead of all others.
std::size_t loop_place_count(const simulation::Experiment& experiment) {
  std::size_t count = 0;
  for (const simulation::LoopSpec& loop : experiment.loops)
    count += simulation::loop_places(loop).size();
  return count;
}

void write(const Vector3d& a, mjtNum* to) {
  to[0] = a.x;
  to[1] = a.y;
  to[2] = a.z;
}

class MujocoWorld final : public PeerWorld {
 public:
  MujocoWorld(const simulation::Experiment& experiment, const MujocoSettings& settings)
      : experiment_(experiment),
        settings_(settings),
        materials_(experiment_),
        tree_(robot_tree(experiment_)),
        touching_(touching_points(experiment_, tree_)),
        forced_(forced_bodies(experiment_, tree_)),
        built_(make_mujoco_model(experiment_, tree_, settings)),
        model_(*built_.model),
        data_(make_mujoco_data(model_)),
        body_of_(static_cast<std::size_t>(model_.nbody)),
        trails_(simulation::body_trails(experiment_)),
        contact_forces_(tree_.bodies.size()),
        contact_counts_(tree_.bodies.size()),
        point_forces_(touching_.size()),
        loop_forces_(3 * loop_place_count(experiment_)) {
    if (experiment_.terrain) terrain_.emplace(*experiment_.terrain);
    for (std::size_t i = 0; i < tree_.bodies.size(); ++i) {
      const auto id = static_cast<std::size_t>(built_.bodies[i].id);
      body_of_[id] = i;
      set_initial(tree_.bodies[i], built_.bodies[i]);
    }
    touch_.reserve(static_cast<std::size_t>(model_.nconmax));
    place_obstacles(simulation::initial_inputs(experiment_).obstacles);
    see();
  }

  std::string advance(const simulation::WorldInputs& inputs) override {
    try {
      apply(inputs);
      move_surfaces(inputs);
      // The second half of mj_step, without its check that on a value which is not finite starts
      // again at the reference pose.
      mj_fwdActuation(&model_, data_.get());
      mj_fwdAcceleration(&model_, data_.get());
      mj_fwdConstraint(&model_, data_.get());
      collect_forces();
      mj_Euler(&model_, data_.get());
      std::vector<simulation::SurfaceMotion> obstacles = inputs.obstacles;
      for (simulation::SurfaceMotion& obstacle : obstacles)
        simulation::advance(obstacle, experiment_.deltat);
      place_obstacles(obstacles);
      return see();
    } catch (const MujocoFailure& failure) {
      return std::string("MuJoCo gave up: ") + failure.what();
    }
  }

  std::string notice() override {
    for (int kind = 0; kind < mjNWARNING; ++kind) {
      const mjWarningStat& warning = data_->warning[kind];
      if (warning.number == 0 || std::exchange(warned_[static_cast<std::size_t>(kind)], true))
        continue;
      if (kind == mjWARN_CONTACTFULL || kind == mjWARN_CNSTRFULL)
        return fmt::format(
            "MuJoCo has room for {} contacts, and leaves the others out: bodies may "
            "fall through; give shapes fewer boundary points, or run fewer bodies",
            model_.nconmax);
      return std::string("MuJoCo warned: ") + mju_warningText(kind, warning.lastinfo) +
             "; later warnings of this kind are not repeated";
    }
    return limit_.take_notice();
  }

  void read(std::span<BodyState> bodies, std::span<JointState> joints) const override {
    for (std::size_t i = 0; i < tree_.bodies.size(); ++i) {
      const TreeBody& body = tree_.bodies[i];
      const MujocoBody& mine = built_.bodies[i];
      if (!body.mobile) continue;
      read_motion(mine, bodies[i]);
      bodies[i].contact_force = contact_forces_[i];
      bodies[i].contacts = contact_counts_[i];
      if (body.link == nullptr) continue;
      JointState& joint = joints[static_cast<std::size_t>(body.joint)];
      joint.angle = data_->qpos[mine.position];
      joint.rate = data_->qvel[mine.velocity];
    }
  }

  void read_loops(std::span<simulation::LoopState> loops) const override {
    std::ranges::fill(loops, simulation::LoopState{});
    std::size_t row = 0;
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const simulation::LoopSpec& loop = experiment_.loops[i];
      const int body = built_.bodies[tree_.index(loop.robot, loop.body_a)].id;
      for (const simulation::LoopPlace& place : simulation::loop_places(loop)) {
        const Vector3d force = vector(loop_forces_.data() + row);
        row += 3;
        loops[i].force += force;
        const Vector3d lever = rotate(quaternion(data_->xquat + 4 * body), place[0] - loop.point_a);
        loops[i].moment += cross(lever, force);
      }
    }
  }

  void read_points(std::span<Vector3d> forces) const override {
    std::ranges::copy(point_forces_, forces.begin());
  }

  void read_shapes(std::vector<ShapeForce>& forces) const override {
    forces.insert(forces.end(), shape_forces_.begin(), shape_forces_.end());
  }

 private:
  void set_initial(const TreeBody& body, const MujocoBody& mine) {
    mjtNum* const position = data_->qpos + mine.position;
    mjtNum* const velocity = data_->qvel + mine.velocity;
    if (body.link != nullptr) {
      *position = body.link->angle;
      *velocity = body.link->rate;
    } else if (body.mobile) {
      // qpos holds the pose already: it is the model's reference, at which the joints of a plane
      // are 0. The speeds of a free joint are in world axes, its rates in the body's.
      const BodyState& state = body.initial;
      const Vector3d arm = rotate(state.orientation, mine.offset);
      const Vector3d v = state.velocity + cross(state.angular_velocity, arm);
      if (body.plane_normal) {
        const PlaneAxes axes = plane_axes(*body.plane_normal);
        return write(
            {dot(v, axes.first), dot(v, axes.second), dot(state.angular_velocity, axes.normal)},
            velocity);
      }
      write(v, velocity);
      write(rotate(conjugate(state.orientation), state.angular_velocity), velocity + 3);
    }
  }

  /// The first half of mj_step: all that follows from positions and velocities. Where they are not
  /// finite, only what read() needs to tell of it.
  std::string see() {
    mjData* const data = data_.get();
    const bool sound = finite(data->qpos, model_.nq) && finite(data->qvel, model_.nv);
    mj_kinematics(&model_, data);
    mj_comPos(&model_, data);
    if (!sound) {
      mj_comVel(&model_, data);
      return std::string("a coordinate or speed is not finite") + smaller_step_helps;
    }
    if (std::any_of(data->qpos, data->qpos + model_.nq, mju_isBad) ||
        std::any_of(data->qvel, data->qvel + model_.nv, mju_isBad))
      return std::string("MuJoCo takes no coordinate or speed above 1e10") + smaller_step_helps;
    mj_crb(&model_, data);
    mj_factorM(&model_, data);
    mj_collision(&model_, data);
    set_contacts();
    mj_makeConstraint(&model_, data);
    mj_projectConstraint(&model_, data);
    mj_fwdVelocity(&model_, data);
    return {};
  }

  /// The two sides of a contact, as geometries. MuJoCo has them in the order of their kinds.
  struct Sides {
    int robot = 0, ground = 0;
    double sign = 1.;  ///< of the contact's normal, out of the ground
  };
  Sides sides_of(const mjContact& contact) const {
    if (of(contact.geom2).of_robot) return {contact.geom2, contact.geom1, 1.};
    return {contact.geom1, contact.geom2, -1.};
  }
  const MujocoGeometry& of(int geometry) const {
    return built_.geometries[static_cast<std::size_t>(geometry)];
  }

  /// The constants of both materials for each contact that MuJoCo found of a shape, and a contact of
  /// each boundary point that is in the ground.
  void set_contacts() {
    touch_.clear();
    std::size_t of_shape = 0;
    int last = -1;
    for (int i = 0; i < data_->ncon; ++i) {
      mjContact& contact = data_->contact[i];
      const Sides sides = sides_of(contact);
      const int obstacle = of(sides.ground).material;
      set_material(contact, of(sides.robot).material,
                   obstacle == simulation::no_material && terrain_
                       ? terrain_->query(vector(contact.pos)).material
                       : obstacle);
      touch_.push_back(-1);
      // A shape's contacts follow one another.
      of_shape = sides.robot == last ? of_shape + 1 : 1;
      last = sides.robot;
      if (of_shape == mjMAXCONPAIR) limit_.check(of_shape, trail_of(sides.robot));
    }
    if (!terrain_) return;
    BodyState body;
    for (std::size_t i = 0; i < touching_.size(); ++i) {
      const MujocoBody& mine = built_.bodies[touching_[i].body];
      read_pose(mine, body);
      const Meeting meeting = meet(*terrain_, touching_[i], body);
      if (meeting.depth > 0. && add_contact(meeting, touching_[i].material, mine.geometry))
        touch_.push_back(static_cast<int>(i));
    }
  }

  std::size_t body_index(int geometry) const {
    return body_of_[static_cast<std::size_t>(model_.geom_bodyid[geometry])];
  }

  const std::string& trail_of(int geometry) const { return trails_[body_index(geometry)]; }

  bool add_contact(const Meeting& meeting, int foot, int geometry) {
    mjContact contact{};
    contact.dist = -meeting.depth;
    // Between the two surfaces, as MuJoCo's own colliders put it.
    write(meeting.position + 0.5 * meeting.depth * meeting.normal, contact.pos);
    const auto [first, second] = mujoco_tangents(meeting.normal);
    write(meeting.normal, contact.frame);
    write(first, contact.frame + 3);
    write(second, contact.frame + 6);
    contact.geom1 = built_.ground;
    contact.geom2 = geometry;
    set_material(contact, foot, meeting.material);
    return mj_addContact(&model_, data_.get(), &contact) == 0;
  }

  void set_material(mjContact& contact, int foot, int ground) const {
    const contact::MaterialConstants<double>& material = materials_.of(foot, ground);
    // The constraint's "diagApprox" of a contact with the world (manual, Computation).
    const int body = model_.geom_bodyid[sides_of(contact).robot];
    const MujocoRow row = settings_.of_file ? mujoco_row_of(experiment_, foot, ground)
                                            : mujoco_row(settings_, experiment_.deltat, material,
                                                         model_.body_invweight0[2 * body]);
    const double friction = single_friction(material);
    // Without friction a contact has one row: the least coefficient of one with three is 1e-5.
    contact.dim = friction > 0. ? 3 : 1;
    contact.friction[0] = contact.friction[1] = std::max(friction, mjMINMU);
    std::ranges::copy(row.reference, contact.solref);
    std::ranges::copy(row.impedance, contact.solimp);
  }

  void apply(const simulation::WorldInputs& inputs) {
    mju_zero(data_->qfrc_applied, model_.nv);
    for_each_force(forced_, inputs, [&](std::size_t index, const simulation::ForceInput& force) {
      const MujocoBody& body = built_.bodies[index];
      const Vector3d point =
          vector(data_->xpos + 3 * body.id) +
          rotate(quaternion(data_->xquat + 4 * body.id), force.point - body.offset);
      std::array<mjtNum, 9> numbers{};
      write(force.force, numbers.data());
      write(force.torque, numbers.data() + 3);
      write(point, numbers.data() + 6);
      mj_applyFT(&model_, data_.get(), numbers.data(), numbers.data() + 3, numbers.data() + 6,
                 body.id, data_->qfrc_applied);
    });
    for (std::size_t i = 0; i < tree_.bodies.size(); ++i)
      if (tree_.bodies[i].link != nullptr)
        data_->qfrc_applied[built_.bodies[i].velocity] +=
            inputs.joint_torques[static_cast<std::size_t>(tree_.bodies[i].joint)];
  }

  void place_obstacles(const std::vector<simulation::SurfaceMotion>& obstacles) {
    for (int geometry = 0; geometry < model_.ngeom; ++geometry) {
      if (!of(geometry).obstacle) continue;
      const simulation::SurfaceMotion& motion = obstacles[*of(geometry).obstacle];
      const int place = model_.body_mocapid[model_.geom_bodyid[geometry]];
      const Quaterniond& q = motion.orientation;
      write(motion.position, data_->mocap_pos + 3 * place);
      std::ranges::copy(std::array{q.w, q.x, q.y, q.z}, data_->mocap_quat + 4 * place);
    }
  }

  /// MuJoCo takes a body that is moved for one at rest where it is. Its rows ask for the acceleration
  /// a = -B v - K d r with the robot's velocity v along the row; v is to be that over the surface.
  void move_surfaces(const simulation::WorldInputs& inputs) {
    for (int i = 0; i < data_->ncon; ++i) {
      const mjContact& contact = data_->contact[i];
      const Sides sides = sides_of(contact);
      Vector3d velocity = inputs.ground.belt_velocity;
      if (const auto obstacle = of(sides.ground).obstacle) {
        const simulation::SurfaceMotion& motion = inputs.obstacles[*obstacle];
        velocity =
            motion.velocity + cross(motion.angular_velocity, vector(contact.pos) - motion.position);
      }
      if (velocity == Vector3d{}) continue;
      for (int row = 0; row < row_count(contact); ++row) {
        const int at = contact.efc_address + row;
        data_->efc_aref[at] +=
            data_->efc_KBIP[4 * at + 1] * sides.sign * dot(velocity, row_direction(contact, row));
      }
    }
  }
  bool pyramid(const mjContact& contact) const {
    return model_.opt.cone == mjCONE_PYRAMIDAL && contact.dim > 1;
  }
  int row_count(const mjContact& contact) const {
    if (contact.efc_address < 0) return 0;
    return pyramid(contact) ? 2 * (contact.dim - 1) : contact.dim;
  }
  Vector3d row_direction(const mjContact& contact, int row) const {
    if (!pyramid(contact)) return vector(contact.frame + 3 * row);
    const double slope = (row % 2 == 0 ? 1. : -1.) * contact.friction[row / 2];
    return vector(contact.frame) + slope * vector(contact.frame + 3 * (1 + row / 2));
  }

  void collect_forces() {
    std::ranges::fill(contact_forces_, Vector3d{});
    std::ranges::fill(contact_counts_, 0);
    std::ranges::fill(point_forces_, Vector3d{});
    shape_forces_.clear();
    std::copy_n(data_->efc_force, loop_forces_.size(), loop_forces_.begin());
    for (int i = 0; i < data_->ncon; ++i) {
      const mjContact& contact = data_->contact[i];
      std::array<mjtNum, 6> components{};  // of force and torque, along the rows of the frame
      mj_contactForce(&model_, data_.get(), i, components.data());
      if (!(components[0] > 0.)) continue;
      const Sides sides = sides_of(contact);
      const Vector3d force = sides.sign * (components[0] * vector(contact.frame) +
                                           components[1] * vector(contact.frame + 3) +
                                           components[2] * vector(contact.frame + 6));
      const std::size_t body = body_index(sides.robot);
      contact_forces_[body] += force;
      ++contact_counts_[body];
      const int point = touch_[static_cast<std::size_t>(i)];
      if (point >= 0)
        point_forces_[static_cast<std::size_t>(point)] = force;
      else
        shape_forces_.push_back({body, vector(contact.pos), force});
    }
  }

  void read_motion(const MujocoBody& body, BodyState& state) const {
    std::array<mjtNum, 6> motion{};  // angular, linear; of the frame's origin in world axes
    mj_objectVelocity(&model_, data_.get(), mjOBJ_XBODY, body.id, motion.data(), 0);
    read_pose(body, state);
    state.angular_velocity = vector(motion.data());
    state.velocity = vector(motion.data() + 3) -
                     cross(state.angular_velocity, rotate(state.orientation, body.offset));
  }

  void read_pose(const MujocoBody& body, BodyState& state) const {
    state.orientation = quaternion(data_->xquat + 4 * body.id);
    state.position = vector(data_->xpos + 3 * body.id) - rotate(state.orientation, body.offset);
  }

  simulation::Experiment experiment_;
  MujocoSettings settings_;
  PairMaterials materials_;
  RobotTree tree_;
  std::vector<TouchingPoint> touching_;
  std::vector<std::size_t> forced_;  ///< body of each force
  MujocoModel built_;
  const mjModel& model_;
  MujocoPointer<mjData> data_;
  std::optional<contact::Terrain> terrain_;
  std::vector<std::size_t> body_of_;  ///< index in the tree by MuJoCo's number
  std::vector<std::string> trails_;   ///< of the bodies of the tree
  ContactLimit limit_{"MuJoCo", mjMAXCONPAIR};
  std::vector<int> touch_;  ///< of each contact: index in touching_, -1 of a shape
  std::vector<Vector3d> contact_forces_;
  std::vector<int> contact_counts_;
  std::vector<Vector3d> point_forces_;
  std::vector<mjtNum> loop_forces_;  ///< rows of the loops in the last step, world axes [N]
  std::vector<ShapeForce> shape_forces_;
  std::array<bool, mjNWARNING> warned_{};
};

}  // namespace

std::unique_ptr<PeerWorld> make_mujoco_world(const simulation::Experiment& experiment,
                                             Settings settings) {
  return std::make_unique<MujocoWorld>(experiment, mujoco_settings(experiment, settings));
}

}  // namespace hookpoint::reference
