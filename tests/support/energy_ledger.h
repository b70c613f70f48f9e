// The energy ledger of a robot on its ground: heat and the work of its drives are integrated along
// with the motion, by the same integrator to the same tolerance. What each law turns into heat is
// written down here from its equations.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "dts/configuration.h"
#include "dts/energy.h"
#include "dts/forward_kinematics.h"
#include "tests/support/accompanied_robot.h"

namespace hookpoint::test_support {

using contact::MaterialConstants;

/// Force of a law's normal spring [N] at `depth` [m].
template <class Law>
double spring_force(double depth, const MaterialConstants<double>& m) {
  if constexpr (std::is_same_v<Law, contact::Exponential>)
    return m.exponential_force * std::exp(m.exponential_rate * (depth + m.exponential_height));
  const double inside = std::max(0., depth);
  if constexpr (std::is_base_of_v<contact::AzadFeatherstone, Law>)
    return m.normal_stiffness * std::pow(inside, 1.5);
  if constexpr (std::is_same_v<Law, contact::HuntCrossley>)
    return m.normal_stiffness * std::pow(inside, m.exponent);
  if constexpr (std::is_base_of_v<contact::Nominal, Law>)
    return m.nominal_stiffness * inside + (m.normal_stiffness - m.nominal_stiffness) *
                                              std::max(0., inside - m.nominal_penetration);
  return m.normal_stiffness * inside;
}

/// Power turned into heat along the tile [W]: a clipped bristle's damper and sliding foot, or
/// LuGre's micro-damping sigma1 z'.v, viscous sigma2 v^2 and slip k_t z.(v - z').
template <class Law>
double bristle_heat(const Vector3d& v, const Vector3d& friction, const Vector3d& z,
                    const Vector3d& z_rate, double mu_N, const MaterialConstants<double>& m) {
  if (std::is_base_of_v<contact::LugrePredictions, Law>) {
    const double sigma1 = m.tangential_damping / (1. + m.tangential_damping * norm(v) / mu_N);
    const double held = std::min(1., mu_N / (m.tangential_stiffness * norm(z) + 1e-300));
    return sigma1 * dot(z_rate, v) + m.viscous_friction * dot(v, v) +
           m.tangential_stiffness * dot(z, held * v - z_rate);
  }
  return m.tangential_damping * dot(z_rate, z_rate) + dot(friction, v - z_rate);
}

/// The same of any law: all of the friction's power where nothing stores it; of a hook that will be
/// thrown, what its spring does not take. `stretch` is z or e.
template <class Law>
double tangential_heat(const contact::Reaction<double>& reaction, const Vector3d& v,
                       const Vector3d& stretch, const Vector3d& friction, double N,
                       const MaterialConstants<double>& m) {
  if (Law::bristle_states == 0) return dot(friction, v);
  if (std::is_same_v<Law, contact::HookpointReset::RateForm>)
    return dot(friction, v) -
           m.tangential_stiffness * dot(stretch, reaction.bristle_rate.deflection);
  const Vector3d& rate = reaction.bristle_rate.deflection;
  if (N <= 0.) return -m.tangential_stiffness * dot(stretch, rate);
  return bristle_heat<Law>(v, friction, stretch, rate, m.kinetic_friction * N, m);
}

/// One robot under an adaptive integrator, and beside its own velocities two numbers more: the heat
/// and the work so far [J].
class EnergyLedger final : public AccompaniedRobot<2> {
 public:
  explicit EnergyLedger(const simulation::Experiment& experiment)
      : AccompaniedRobot(experiment),
        law_(contact::find_force_law(experiment_.contact)->rate_form()) {
    for (const simulation::ChainSpec& chain : experiment_.robots[0].chains)
      for (const simulation::LinkSpec& link : chain.links) links_.push_back(link);
  }

  /// Kinetic, potential and spring energy less work, plus heat [J]: stays the same.
  double balance(std::span<const double> q, std::span<const double> v) {
    robot_.settle_at(q, own(v));
    double energy = dts::kinetic_energy(robot_.model(), robot_.workspace()) +
                    dts::potential_energy(robot_.model(), experiment_.gravity, robot_.workspace());
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const double angle = robot_.state().joint_positions[i] - links_[i].rest_angle;
      energy += 0.5 * links_[i].stiffness * angle * angle;
    }
    for (std::size_t i = 0; i < robot_.contacts().points().size(); ++i) energy += stored(i, v);
    return energy + heat(v) + let_go_ - work(v);
  }
  /// Integrated [J]; `let_go` is what was lost at events, of thrown hooks and at lift-off.
  double heat(std::span<const double> v) const { return v[v.size() - 2]; }
  double work(std::span<const double> v) const { return v[v.size() - 1]; }
  double let_go() const { return let_go_; }
  void write(std::span<double> q, std::span<double> v) const {
    robot_.robot().write_positions(q);
    std::ranges::fill(v, 0.);
    dts::get_velocity<double>(robot_.model(), robot_.state(), v);
  }

  integrators::Status accelerations(integrators::Stage stage, double time,
                                    std::span<const double> q, std::span<const double> v,
                                    std::span<double> a) override {
    const auto status = robot_.accelerations(stage, time, q, own(v), a.first(a.size() - 2));
    double& heat_rate = a[a.size() - 2] = 0.;
    double& power = a[a.size() - 1] = 0.;
    for (std::size_t i = 0; i < robot_.contacts().points().size(); ++i)
      heat_rate += contact_heat(i, v);
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const double rate = robot_.state().joint_rates[i];
      heat_rate += links_[i].damping * rate * rate;
      power += inputs_.joint_torques[i] * rate;
    }
    return status;
  }
  void commit(double time, std::span<const double> q, std::span<const double> v) override {
    robot_.settle_at(q, own(v));
    for (std::size_t i = 0; i < robot_.contacts().points().size(); ++i) let_go_ += stored(i, v);
    robot_.commit(time, q, own(v));
    for (std::size_t i = 0; i < robot_.contacts().points().size(); ++i) let_go_ -= stored(i, v);
  }
  void reinitialize(std::span<double> v) override {
    for (std::size_t i = 0; i < robot_.contacts().points().size(); ++i) let_go_ += stored(i, v);
    robot_.reinitialize(own(v));
    for (std::size_t i = 0; i < robot_.contacts().points().size(); ++i) let_go_ -= stored(i, v);
  }

 private:
  /// A boundary point at the robot's present state, as an adaptive integrator shows it to the law.
  contact::PointKinematics<double> kinematics(std::size_t index, std::span<const double> v) const {
    const simulation::ContactPoint& point = robot_.contacts().points()[index];
    const auto place =
        simulation::contact_kinematics(point, robot_.workspace().bodies[point.body], *ground_);
    contact::Bristle<double> bristle;
    if (const std::size_t states = law_.bristle_states) {
      const double* z = &v[dts::velocity_count(robot_.model()) + states * index];
      bristle = {{z[0], z[1], z[2]}, states > 3 ? z[3] : 0.};
    }
    return {place.position, place.velocity, place.tile.normal,
            simulation::depth_on_side(point.inside, place.tile.depth, law_.reach(material())),
            bristle};
  }
  const MaterialConstants<double>& material() const { return experiment_.materials[0].constants; }
  /// The bristle's deflection, or how far the point is from its hook [m].
  Vector3d stretch(std::size_t index, const contact::PointKinematics<double>& point) const {
    if (law_.bristle_states > 0) return tangential(point.bristle.deflection, point.normal);
    const contact::Memory<double>& memory = robot_.contacts().points()[index].committed;
    return memory.attached ? tangential(point.position - memory.hook, point.normal) : Vector3d{};
  }
  double stored(std::size_t index, std::span<const double> v) const {
    const auto point = kinematics(index, v);
    return law_.stored_energy(point.depth, stretch(index, point), material());
  }
  double contact_heat(std::size_t index, std::span<const double> v) const {
    const auto point = kinematics(index, v);
    const Vector3d e = stretch(index, point);
    return std::visit(
        [&]<class Law>(const Law& law) {
          const auto reaction = law.evaluate(point, robot_.contacts().points()[index].committed,
                                             material(), contact::differential_equation);
          if (!reaction.next.attached) return 0.;
          const double N = dot(reaction.force, point.normal);
          const double depth_rate = -dot(point.velocity, point.normal);
          return (N - spring_force<Law>(point.depth, material())) * depth_rate +
                 tangential_heat<Law>(reaction, tangential(point.velocity, point.normal), e,
                                      -tangential(reaction.force, point.normal), N, material());
        },
        law_.variant);
  }

  const contact::LawDescription& law_;
  std::vector<simulation::LinkSpec> links_;
  double let_go_ = 0.;
};

}  // namespace hookpoint::test_support
