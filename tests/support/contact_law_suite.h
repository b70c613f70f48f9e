// What every force law must hold in every run (docs/contact.md): the friction cone, dissipation,
// independence of direction and frame, hook on the surface, purity, lanes that do not touch each
// other, and what it says of itself. A test program instantiates the suite ContactLaw with its list
// of laws.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "contact/law_interface.h"
#include "contact/laws/lugre_bristle.h"
#include "simulation/experiment/material_fields.h"
#include "tests/support/contact_path.h"
#include "tests/support/lanes.h"

namespace hookpoint::contact::law_suite {

using namespace hookpoint::test_support;

inline constexpr double dt = 1e-3;
inline constexpr Vector3d up{0., 0., 1.};

template <class Law>
class ContactLaw : public ::testing::Test {};
TYPED_TEST_SUITE_P(ContactLaw);

/// What the law claims of its friction at the speed v: the cone; LuGre's damping terms are beside
/// it.
template <class Law>
double friction_limit(double normal_force, double speed, const MaterialConstants<double>& m) {
  const double cone = m.static_friction * normal_force;
  return std::is_base_of_v<LugrePredictions, Law> ? 3. * cone + m.viscous_friction * speed : cone;
}

/// The largest force that the path can bring about, to which rounding is compared [N].
inline double force_scale(const MaterialConstants<double>& m) {
  return 1e-3 * (m.normal_stiffness + m.tangential_stiffness + m.nominal_stiffness) +
         m.normal_damping + m.tangential_damping + m.viscous_friction +
         m.exponential_force * std::exp(m.exponential_rate * (1e-3 + m.exponential_height));
}

inline bool same(const Memory<double>& a, const Memory<double>& b) {
  return a.hook == b.hook && a.stretch == b.stretch && a.attached == b.attached &&
         a.sliding == b.sliding;
}

inline bool same(const Bristle<double>& a, const Bristle<double>& b) {
  return a.deflection == b.deflection && a.sliding == b.sliding;
}

TYPED_TEST_P(ContactLaw, FrictionStaysInTheConeAndTheGroundNeverPulls) {
  EXPECT_TRUE(rc::check([] {
    const auto material = any_material();
    const auto path = any_path();
    const auto reactions = reactions_along<TypeParam>(path, up, material, dt);
    for (std::size_t k = 1; k < path.size(); ++k) {
      const auto& reaction = reactions[k - 1];
      const double normal_force = dot(reaction.force, up);
      RC_ASSERT(normal_force >= 0.);
      const double speed = norm(tangential(point_at(path, k, up, dt).velocity, up));
      const double limit = friction_limit<TypeParam>(normal_force, speed, material);
      RC_ASSERT(norm(tangential(reaction.force, up)) <= limit * (1. + 1e-12));
      if (!std::is_base_of_v<LugrePredictions, TypeParam>) continue;
      const double elastic = material.tangential_stiffness * norm(reaction.bristle.deflection);
      RC_ASSERT(elastic <= material.static_friction * normal_force * (1. + 1e-12));
    }
  }));
}

/// Power that the ground takes at a state, less the rate at which its springs store it [W].
template <class Law>
double dissipation(const PointKinematics<double>& point, const Memory<double>& memory,
                   const MaterialConstants<double>& material) {
  const auto reaction = Law::evaluate(point, memory, material, 0.);
  const auto stored_after = [&](double time) {
    return Law::stored_energy(point.depth - time * dot(point.velocity, point.normal),
                              reaction.bristle.deflection + time * reaction.bristle_rate.deflection,
                              material);
  };
  constexpr double h = 1e-7;
  return -dot(reaction.force, point.velocity) - (stored_after(h) - stored_after(-h)) / (2. * h);
}

// A bristle may be integrated by any method, so that its law must take energy at each state, not
// only over a step of one of them.
template <class Law>
void bristle_takes_energy_at_every_state() {
  const auto material = any_material();
  const auto path = any_path();
  const auto reactions = reactions_along<Law>(path, up, material, dt);
  for (std::size_t k = 2; k < path.size(); ++k) {
    auto point = point_at(path, k, up, dt);
    point.depth = std::max(point.depth, 1e-6);  // away from touch-down, where energy has a kink
    point.bristle = bristle_after(reactions[k - 2], dt);
    point.velocity = Vector3d{number(-1., 1.), number(-1., 1.), number(-1., 1.)};
    RC_ASSERT(dissipation<Law>(point, reactions[k - 2].next, material) >=
              -1e-7 * force_scale(material));
  }
}

template <class Law>
void hook_takes_energy_along_a_path() {
  const auto material = any_material();
  const auto path = any_path();
  const auto reactions = reactions_along<Law>(path, up, material, dt);
  double stored = 0.;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const Reaction<double>& reaction = reactions[k - 1];
    const double work_on_ground = -dot(reaction.force, path[k] - path[k - 1]);
    const double now = Law::stored_energy(-path[k].z, reaction.next.stretch, material);
    RC_ASSERT(work_on_ground - (now - stored) >= -1e-12 * force_scale(material) * 1e-3);
    stored = now;
  }
}

TYPED_TEST_P(ContactLaw, NeverGivesMoreEnergyThanItTook) {
  EXPECT_TRUE(rc::check([] {
    if constexpr (TypeParam::bristle_states > 0) {
      bristle_takes_energy_at_every_state<TypeParam>();
    } else {
      hook_takes_energy_along_a_path<TypeParam>();
    }
  }));
}

TYPED_TEST_P(ContactLaw, StoredEnergyIsTheWorkOfASlowPress) {
  for (const double blend_width : {0., 4e-4}) {
    MaterialConstants<double> material;
    material.nominal_penetration = 3e-4;
    material.blend_width = blend_width;
    const double reach = TypeParam::reach(material);
    double work = 0.;
    const int n = 20000;
    const double slice = (1e-3 + reach) / n;
    for (int i = 0; i < n; ++i) {
      const double depth = -reach + slice * (i + 0.5);
      const PointKinematics<double> point{{0., 0., -depth}, {}, up, depth, {}};
      work += dot(TypeParam::evaluate(point, {}, material, dt).force, up) * slice;
    }
    EXPECT_NEAR(TypeParam::stored_energy(1e-3, {}, material), work, 1e-6 * work);
    EXPECT_EQ(TypeParam::stored_energy(-reach - 1e-3, {}, material), 0.);
  }
}

TYPED_TEST_P(ContactLaw, IsTheSameInEveryDirectionAndFrame) {
  EXPECT_TRUE(rc::check([] {
    const auto material = any_material();
    const auto path = any_path();
    const Quaterniond turn = any_rotation();
    auto turned_path = path;
    for (Vector3d& position : turned_path) position = rotate(turn, position);

    const auto reactions = reactions_along<TypeParam>(path, up, material, dt);
    const auto turned = reactions_along<TypeParam>(turned_path, rotate(turn, up), material, dt);
    for (std::size_t k = 0; k < reactions.size(); ++k) {
      const Vector3d difference = turned[k].force - rotate(turn, reactions[k].force);
      RC_ASSERT(norm(difference) <= 1e-12 * force_scale(material));
    }
  }));
}

TYPED_TEST_P(ContactLaw, IsTheSameAtEveryPlace) {
  EXPECT_TRUE(rc::check([] {
    const auto material = any_material();
    const auto path = any_path();
    const Vector3d origin{number(-2., 2.), number(-2., 2.), number(-2., 2.)};
    auto moved_path = path;
    for (Vector3d& position : moved_path) position += origin;
    const auto reactions = reactions_along<TypeParam>(path, up, material, dt);
    const auto moved = reactions_along<TypeParam>(moved_path, up, material, dt, origin);
    // Positions of 2 m are rounded to 4e-16 m, velocities to that over dt.
    const double rounding = 1e-14 * (material.normal_stiffness + material.tangential_stiffness +
                                     (material.normal_damping + material.tangential_damping) / dt +
                                     material.viscous_friction / dt + force_scale(material) / 1e-4);
    for (std::size_t k = 0; k < reactions.size(); ++k) {
      RC_ASSERT(norm(moved[k].force - reactions[k].force) <= rounding);
    }
  }));
}

TYPED_TEST_P(ContactLaw, KeepsTheHookOnTheTileNowUnderThePoint) {
  EXPECT_TRUE(rc::check([] {
    const auto material = any_material();
    const auto path = any_path();
    Memory<double> memory;
    Bristle<double> bristle;
    for (std::size_t k = 1; k < path.size(); ++k) {
      const Vector3d normal =
          rotate(exponential(Vector3d{number(-.4, .4), number(-.4, .4), 0.}), up);
      const auto point = accepted<TypeParam>(point_at(path, k, normal, dt), bristle, material, dt);
      const auto reaction = TypeParam::evaluate(point, memory, material, dt);
      memory = reaction.next;
      bristle = bristle_after(reaction, dt);
      RC_ASSERT(memory.attached == (point.depth > -TypeParam::reach(material)));
      RC_ASSERT(std::abs(dot(reaction.bristle_rate.deflection, normal)) <= 1e-12);
      if (!memory.attached) continue;
      RC_ASSERT(std::abs(dot(memory.hook, normal)) <= 1e-16);
      const Vector3d stretch = tangential(point.position - memory.hook, normal);
      RC_ASSERT(norm(stretch - memory.stretch) <= 1e-16);
      RC_ASSERT(std::abs(dot(memory.stretch, normal)) <= 1e-16);
    }
  }));
}

TYPED_TEST_P(ContactLaw, ForgetsThePointOutsideTheGround) {
  const MaterialConstants<double> material;
  const Memory<double> memory{{1., 2., 0.}, {1e-3, 0., 0.}, true, true};
  for (const double below_reach : {0., -1e-9, -1.}) {
    const double depth = below_reach - TypeParam::reach(material);
    const PointKinematics<double> point{
        {0., 0., -depth}, {1., 0., -1.}, up, depth, {{1e-4, 0., 0.}, 0.5}};
    const auto reaction = TypeParam::evaluate(point, memory, material, dt);
    EXPECT_EQ(reaction.force, Vector3d{});
    EXPECT_TRUE(same(reaction.next, Memory<double>{}));
    EXPECT_TRUE(same(reaction.bristle, Bristle<double>{}));
    EXPECT_TRUE(same(reaction.bristle_rate, Bristle<double>{}));
  }
}

TYPED_TEST_P(ContactLaw, IsPure) {
  EXPECT_TRUE(rc::check([] {
    const auto material = any_material();
    const auto path = any_path();
    const auto trial_path = any_path();
    const auto undisturbed = reactions_along<TypeParam>(path, up, material, dt);
    // Trial states between the accepted ones leave nothing behind.
    const auto disturbed = reactions_along<TypeParam>(
        path, up, material, dt, {}, [&](std::size_t k, const Memory<double>& memory) {
          reaction_of<TypeParam>(point_at(trial_path, k, up, dt), memory, material, dt);
        });
    for (std::size_t k = 0; k < undisturbed.size(); ++k) {
      RC_ASSERT(disturbed[k].force == undisturbed[k].force);
      RC_ASSERT(same(disturbed[k].next, undisturbed[k].next));
      RC_ASSERT(same(disturbed[k].bristle_rate, undisturbed[k].bristle_rate));
    }
  }));
}

inline Vector3<Lanes> in_lanes(const Vector3d& a, const Vector3d& b) {
  return {{a.x, b.x}, {a.y, b.y}, {a.z, b.z}};
}
inline Vector3d lane_of(const Vector3<Lanes>& a, std::size_t i) {
  return {a.x.lane[i], a.y.lane[i], a.z.lane[i]};
}

inline Bristle<Lanes> in_lanes(const Bristle<double>& a, const Bristle<double>& b) {
  return {in_lanes(a.deflection, b.deflection), {a.sliding, b.sliding}};
}

/// The constants of any_material, the same in both lanes.
inline MaterialConstants<Lanes> in_both_lanes(const MaterialConstants<double>& scalar) {
  MaterialConstants<Lanes> m;
  m.normal_stiffness = scalar.normal_stiffness;
  m.normal_damping = scalar.normal_damping;
  m.tangential_stiffness = scalar.tangential_stiffness;
  m.tangential_damping = scalar.tangential_damping;
  m.static_friction = scalar.static_friction;
  m.kinetic_friction = scalar.kinetic_friction;
  m.exponent = scalar.exponent;
  m.hysteresis_damping = scalar.hysteresis_damping;
  m.nominal_penetration = scalar.nominal_penetration;
  m.nominal_stiffness = scalar.nominal_stiffness;
  m.blend_width = scalar.blend_width;
  m.stribeck_speed = scalar.stribeck_speed;
  m.viscous_friction = scalar.viscous_friction;
  m.breakaway = scalar.breakaway;
  m.exponential_force = scalar.exponential_force;
  m.exponential_rate = scalar.exponential_rate;
  m.exponential_height = scalar.exponential_height;
  m.sliding_time = scalar.sliding_time;
  return m;
}

TYPED_TEST_P(ContactLaw, GivesEveryLaneItsOwnAnswer) {
  EXPECT_TRUE(rc::check([] {
    const std::array paths{any_path(), any_path()};
    const auto scalar = any_material();
    const auto material = in_both_lanes(scalar);
    const std::array expected{reactions_along<TypeParam>(paths[0], up, scalar, dt),
                              reactions_along<TypeParam>(paths[1], up, scalar, dt)};
    Memory<Lanes> memory;
    std::array<Bristle<double>, 2> bristles;
    for (std::size_t k = 1; k < paths[0].size(); ++k) {
      const auto a = accepted<TypeParam>(point_at(paths[0], k, up, dt), bristles[0], scalar, dt);
      const auto b = accepted<TypeParam>(point_at(paths[1], k, up, dt), bristles[1], scalar, dt);
      const PointKinematics<Lanes> point{in_lanes(a.position, b.position),
                                         in_lanes(a.velocity, b.velocity),
                                         in_lanes(up, up),
                                         {a.depth, b.depth},
                                         in_lanes(a.bristle, b.bristle)};
      const auto reaction = TypeParam::evaluate(point, memory, material, Lanes(dt));
      for (const std::size_t i : {0u, 1u}) {
        const auto& own = expected[i][k - 1];
        RC_ASSERT(norm(lane_of(reaction.force, i) - own.force) <= 1e-12 * force_scale(scalar));
        RC_ASSERT(reaction.next.attached.lane[i] == own.next.attached);
        RC_ASSERT(reaction.next.sliding.lane[i] == own.next.sliding);
        const Vector3d rate = lane_of(reaction.bristle_rate.deflection, i);
        RC_ASSERT(norm(rate - own.bristle_rate.deflection) <= 1e-12);
        bristles[i] = bristle_after(own, dt);
      }
      memory = reaction.next;
    }
  }));
}

TYPED_TEST_P(ContactLaw, StaticDepthCarriesTheLoad) {
  EXPECT_TRUE(rc::check([] {
    const auto material = any_material();
    const double load = number(0.1, 1e3);
    const double depth = TypeParam::static_depth(load, material);
    const PointKinematics<double> point{{0., 0., -depth}, {}, up, depth, {}};
    const auto reaction = TypeParam::evaluate(point, {}, material, dt);
    RC_ASSERT(norm(reaction.force - load * up) <= 1e-12 * load);
  }));
}

TYPED_TEST_P(ContactLaw, LinearisesItsOwnForce) {
  MaterialConstants<double> material;
  material.regularisation_speed = 0.1;
  material.viscous_friction = 7.;
  const double load = 20.;
  const double depth = TypeParam::static_depth(load, material);
  const LinearContact linear = TypeParam::linearise(load, material);
  const auto force = [&](double deeper, double depth_rate, double shift, double speed) {
    Memory<double> memory{{0., 0., 0.}, {}, true, false};
    const PointKinematics<double> point{{shift, 0., -depth - deeper},
                                        {speed, 0., -depth_rate},
                                        up,
                                        depth + deeper,
                                        {{shift, 0., 0.}, 0.}};
    return TypeParam::evaluate(point, memory, material, dt).force;
  };
  const double h = 1e-8;
  EXPECT_NEAR((force(h, 0, 0, 0).z - force(-h, 0, 0, 0).z) / (2 * h), linear.normal_stiffness,
              1e-4 * linear.normal_stiffness);
  EXPECT_NEAR((force(0, h, 0, 0).z - force(0, -h, 0, 0).z) / (2 * h), linear.normal_damping,
              1e-4 * linear.normal_damping);
  EXPECT_NEAR(-(force(0, 0, h, 0).x - force(0, 0, -h, 0).x) / (2 * h), linear.tangential_stiffness,
              1e-4 * linear.tangential_stiffness);
  EXPECT_NEAR(-(force(0, 0, 0, h).x - force(0, 0, 0, -h).x) / (2 * h), linear.tangential_damping,
              1e-4 * linear.tangential_damping);
}

/// The law's closed forms about a load of 20 N, but for its rebound.
template <class Law>
std::vector<double> predictions(const Constants& material) {
  const LinearContact linear = Law::linearise(20., material);
  return {Law::static_depth(20., material),
          Law::stick_displacement(5., 20., material).value_or(-1.),
          Law::creep_speed(0.3, material).value_or(-1.),
          linear.normal_stiffness,
          linear.normal_damping,
          linear.tangential_stiffness,
          linear.tangential_damping,
          Law::stored_energy(1e-3, {1e-4, 0., 0.}, material),
          Law::reach(material),
          Law::resolved_speed(20., 1e-3, material)};
}

/// Whether two numbers differ by more than two compilations of one expression may.
inline bool differ(double a, double b) {
  return std::abs(a - b) > 1e-6 * std::max(std::abs(a), std::abs(b));
}
inline bool differ(const Vector3d& a, const Vector3d& b) {
  return norm(a - b) > 1e-6 * std::max(norm(a), norm(b));
}
inline bool differ(const Reaction<double>& a, const Reaction<double>& b) {
  return differ(a.force, b.force) || differ(a.next.stretch, b.next.stretch) ||
         a.next.attached != b.next.attached || a.next.sliding != b.next.sliding ||
         differ(a.bristle.deflection, b.bristle.deflection) ||
         differ(a.bristle_rate.deflection, b.bristle_rate.deflection) ||
         differ(a.bristle_rate.sliding, b.bristle_rate.sliding);
}
inline bool differ(const std::vector<double>& a, const std::vector<double>& b) {
  return !std::ranges::equal(a, b, [](double x, double y) { return !differ(x, y); });
}

/// With another value of the constant, so far off that thresholds are crossed.
inline Constants with_another(Constants material, Constant constant) {
  material.*constant = material.*constant > 0. ? 1e-3 * material.*constant : 1.;
  return material;
}

/// A state as an integrator may show it to a law: also slow ones, in which a point sticks.
struct AnyState {
  PointKinematics<double> point;
  Memory<double> memory;

  AnyState() {
    const double speed = std::pow(10., number(-4., 0.)), bend = std::pow(10., number(-7., -4.));
    const Vector3d position{number(-1e-3, 1e-3), number(-1e-3, 1e-3), number(-1e-3, 1e-4)};
    point = {position,
             speed * Vector3d{number(-1., 1.), number(-1., 1.), number(-1., 1.)},
             up,
             -position.z,
             {bend * Vector3d{number(-1., 1.), number(-1., 1.), 0.}, number(0., 1.)}};
    memory.stretch = point.bristle.deflection;
    memory.hook = position - dot(position, up) * up - memory.stretch;
    memory.attached = true;
    memory.sliding = number(0., 1.) > 0.5;
  }
};

// The truth is found by changing each constant there is: some force or prediction changes, or none.
TYPED_TEST_P(ContactLaw, ReadsTheConstantsThatItDeclares) {
  std::set<std::string> read, declared;
  EXPECT_TRUE(rc::check([&] {
    const auto material = any_material();
    std::array<AnyState, 20> states;
    const auto changes = [&](const Constants& other) {
      return std::ranges::any_of(states, [&](const AnyState& state) {
        return differ(TypeParam::evaluate(state.point, state.memory, material, dt),
                      TypeParam::evaluate(state.point, state.memory, other, dt));
      });
    };
    for (const simulation::MaterialField& field : simulation::material_fields()) {
      const Constants other = with_another(material, field.member);
      if (changes(other) || differ(predictions<TypeParam>(material), predictions<TypeParam>(other)))
        read.insert(field.name);
    }
  }));
  const Constants material;
  for (const simulation::MaterialField& field : simulation::material_fields()) {
    if (differ(TypeParam::restitution(1., 0.1, material),
               TypeParam::restitution(1., 0.1, with_another(material, field.member))))
      read.insert(field.name);
  }
  for (const Constant constant : TypeParam::constants)
    declared.insert(simulation::field_of(constant).name);
  EXPECT_EQ(declared.size(), TypeParam::constants.size());
  EXPECT_EQ(declared, read);
  for (const Constant own : TypeParam::own_constants)
    EXPECT_TRUE(declared.contains(simulation::field_of(own).name));
}

TYPED_TEST_P(ContactLaw, RestsDeeperAndReboundsMoreWithLessOfTheConstantsThatItNames) {
  const Constants material;
  const auto less = [&](Constant constant) {
    Constants changed = material;
    changed.*constant *= 0.99;
    return changed;
  };
  const NormalConstants named = TypeParam::normal_constants;
  ASSERT_NE(named.stiffness, nullptr);
  EXPECT_GT(TypeParam::static_depth(20., less(named.stiffness)),
            TypeParam::static_depth(20., material));
  ASSERT_NE(named.damping, nullptr);
  EXPECT_GT(TypeParam::restitution(1., 0.1, less(named.damping)),
            TypeParam::restitution(1., 0.1, material));
}

REGISTER_TYPED_TEST_SUITE_P(ContactLaw, FrictionStaysInTheConeAndTheGroundNeverPulls,
                            NeverGivesMoreEnergyThanItTook, StoredEnergyIsTheWorkOfASlowPress,
                            IsTheSameInEveryDirectionAndFrame, IsTheSameAtEveryPlace,
                            KeepsTheHookOnTheTileNowUnderThePoint, ForgetsThePointOutsideTheGround,
                            IsPure, GivesEveryLaneItsOwnAnswer, StaticDepthCarriesTheLoad,
                            LinearisesItsOwnForce, ReadsTheConstantsThatItDeclares,
                            RestsDeeperAndReboundsMoreWithLessOfTheConstantsThatItNames);

}  // namespace hookpoint::contact::law_suite
