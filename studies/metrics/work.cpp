// The work theorem, held against what an engine publishes: the kinetic and gravitational energy of
// a robot changes by the work of ground, joints and external forces. The ground's is
// -(dissipation + growth of the contact springs' energy), which nobody needs to tell apart.
// Over a step of h from k to k + 1, with F held or its mean, W = h F . (v_k + v_k+1)/2, at which a
// step M (v_k+1 - v_k) = h F keeps its books exactly; a force that is a function of the state,
// W = h (F_k . v_k + F_k+1 . v_k+1)/2.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "studies/measure/metric.h"
#include "studies/metrics/table.h"

namespace hookpoint::studies {
namespace {

using simulation::BodyState;
using simulation::GroundForceTime;
using simulation::WorldState;

Vector3d velocity_at(const BodyState& body, const Vector3d& point) {
  return body.velocity + cross(body.angular_velocity, rotate(body.orientation, point));
}

class EnergyResidual : public Metric {
 public:
  explicit EnergyResidual(const RunContext& context) : context_(context) {
    const auto& robots = context.experiment->robots;
    for (int i = 0; i < context.robot; ++i)
      first_joint_ += simulation::joint_count(robots[static_cast<std::size_t>(i)]);
  }

  void observe(const Observation& observation) override {
    const WorldState& world = observation.world;
    told_ = !context_.ground || world.ground_force_time != GroundForceTime::unknown;
    const double kinetic = kinetic_energy(context_, world);
    const double energy = mechanical_energy(context_, world);
    const double power = power_of_ground(world);
    if (watching_) {
      const double h = world.time - last_.time;
      add(work_of_ground(world, h, power));
      add(work_of_joints(world, h));
      add(work_of_forces(world, h));
      exchanged_ += std::abs(energy - kinetic - potential_);
    } else {
      start_ = energy;
    }
    potential_ = energy - kinetic;
    greatest_kinetic_ = std::max(greatest_kinetic_, kinetic);
    residual_ = std::max(residual_, std::abs(energy - start_ - work_));
    last_power_ = power;
    remember(observation);
  }

  std::optional<double> value() const override {
    if (!told_ || !watching_) return std::nullopt;
    constexpr double least_fall = 1e-6;  // [m]: a robot that rests exchanges nothing but rounding
    const double scale = std::max(exchanged_ + greatest_kinetic_, context_.weight * least_fall);
    return residual_ == 0. ? 0. : residual_ / scale;
  }

 private:
  void add(double work) {
    work_ += work;
    exchanged_ += std::abs(work);
  }

  void remember(const Observation& observation) {
    last_.time = observation.world.time;
    last_.bodies = observation.world.bodies;
    last_.joints = observation.world.joints;
    forces_.clear();
    if (observation.inputs != nullptr) forces_ = observation.inputs->forces;
    watching_ = true;
  }

  double power_of_ground(const WorldState& world) const {
    if (world.ground_force_time != GroundForceTime::now) return 0.;
    double power = 0.;
    for_each_ground_force(context_, world,
                          [&](const auto& force, const BodyState& body, const Vector3d&) {
                            power += dot(force.force, velocity_at(body, force.point));
                          });
    return power;
  }

  double work_of_ground(const WorldState& world, double h, double power) const {
    if (world.ground_force_time == GroundForceTime::now) return 0.5 * h * (last_power_ + power);
    double work = 0.;
    for_each_ground_force(
        context_, world, [&](const auto& force, const BodyState& body, const Vector3d&) {
          work += 0.5 * h *
                  dot(force.force, velocity_at(last_.bodies[force.body], force.point) +
                                       velocity_at(body, force.point));
        });
    return work;
  }

  /// A torque is held over the step that led to the state it is published with.
  double work_of_joints(const WorldState& world, double h) const {
    double work = 0.;
    for (std::size_t i = 0; i < simulation::joint_count(context_.robot_spec()); ++i) {
      const simulation::JointState& joint = world.joints[first_joint_ + i];
      work += 0.5 * h * joint.torque * (last_.joints[first_joint_ + i].rate + joint.rate);
    }
    return work;
  }

  /// External forces, as they were held over the step that led here.
  double work_of_forces(const WorldState& world, double h) const {
    double work = 0.;
    for (std::size_t i = 0; i < forces_.size(); ++i) {
      const simulation::ForceSpec& spec = context_.experiment->forces[i];
      if (spec.robot != context_.robot) continue;
      const std::size_t index = context_.body + static_cast<std::size_t>(spec.body);
      const BodyState &before = last_.bodies[index], &now = world.bodies[index];
      const simulation::ForceInput& force = forces_[i];
      work += 0.5 * h *
              (dot(force.force, velocity_at(before, force.point) + velocity_at(now, force.point)) +
               dot(force.torque, before.angular_velocity + now.angular_velocity));
    }
    return work;
  }

  const RunContext& context_;
  std::size_t first_joint_ = 0;                 ///< of the robot among all that are published
  WorldState last_;                             ///< time, bodies and joints of the step before
  std::vector<simulation::ForceInput> forces_;  ///< of the step to come
  bool watching_ = false, told_ = false;
  double start_ = 0., potential_ = 0., last_power_ = 0.;
  double work_ = 0., residual_ = 0., exchanged_ = 0., greatest_kinetic_ = 0.;  ///< [J]
};

std::unique_ptr<Metric> make_energy_residual(const RunContext& context) {
  return std::make_unique<EnergyResidual>(context);
}

}  // namespace

std::span<const MetricDefinition> work_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "energy_residual",
       .unit = "",
       .doc =
           "greatest difference, since the start, between the change of kinetic and gravitational energy and the work of ground, joints and external forces, per energy exchanged",
       .make = make_energy_residual,
       .needs = {.forces = true}},
  });
  return rows;
}

}  // namespace hookpoint::studies
