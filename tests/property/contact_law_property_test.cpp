// What every force law must hold in every run (docs/contact.md): the friction cone, dissipation,
// independence of direction and frame, hook on the surface, purity, lanes that do not touch each
// other.
#include <gtest/gtest.h>

#include "contact/force_law.h"
#include "tests/support/contact_path.h"
#include "tests/support/lanes.h"

namespace hookpoint::contact {
namespace {

using namespace hookpoint::test_support;

constexpr double dt = 1e-3;
const Vector3d up{0., 0., 1.};

template <class Law>
class ContactLaw : public ::testing::Test {};
using Laws = ::testing::Types<Hookpoint, HookpointReset, HuntCrossley>;
TYPED_TEST_SUITE(ContactLaw, Laws);

/// The largest force that the path can bring about, to which rounding is compared [N].
double force_scale(const MaterialConstants<double>& m) {
  return 1e-3 * (m.normal_stiffness + m.tangential_stiffness) + m.normal_damping +
         m.tangential_damping;
}

bool same(const Memory<double>& a, const Memory<double>& b) {
  return a.hook == b.hook && a.stretch == b.stretch && a.attached == b.attached &&
         a.sliding == b.sliding;
}

TYPED_TEST(ContactLaw, FrictionStaysInTheConeAndTheGroundNeverPulls) {
  EXPECT_TRUE(rc::check([] {
    const auto material = any_material();
    for (const auto& reaction : reactions_along<TypeParam>(any_path(), up, material, dt)) {
      const double normal_force = dot(reaction.force, up);
      RC_ASSERT(normal_force >= 0.);
      const double friction = norm(tangential(reaction.force, up));
      RC_ASSERT(friction <= material.static_friction * normal_force * (1. + 1e-12));
    }
  }));
}

TYPED_TEST(ContactLaw, NeverGivesMoreEnergyThanItTook) {
  EXPECT_TRUE(rc::check([] {
    const auto material = any_material();
    const auto path = any_path();
    const auto reactions = reactions_along<TypeParam>(path, up, material, dt);
    double stored = 0.;
    for (std::size_t k = 1; k < path.size(); ++k) {
      const Reaction<double>& reaction = reactions[k - 1];
      const double work_on_ground = -dot(reaction.force, path[k] - path[k - 1]);
      const double now = TypeParam::stored_energy(-path[k].z, reaction.next.stretch, material);
      RC_ASSERT(work_on_ground - (now - stored) >= -1e-12 * force_scale(material) * 1e-3);
      stored = now;
    }
  }));
}

TYPED_TEST(ContactLaw, StoredEnergyIsTheWorkOfASlowPress) {
  MaterialConstants<double> material;
  double work = 0.;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double depth = 1e-3 * (i + 0.5) / n;
    const PointKinematics<double> point{{0., 0., -depth}, {}, up, depth};
    work += dot(TypeParam::evaluate(point, {}, material, dt).force, up) * 1e-3 / n;
  }
  EXPECT_NEAR(TypeParam::stored_energy(1e-3, {}, material), work, 1e-6 * work);
  EXPECT_EQ(TypeParam::stored_energy(-1e-3, {}, material), 0.);
}

TYPED_TEST(ContactLaw, IsTheSameInEveryDirectionAndFrame) {
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

TYPED_TEST(ContactLaw, IsTheSameAtEveryPlace) {
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
                                     force_scale(material) / 1e-4);
    for (std::size_t k = 0; k < reactions.size(); ++k) {
      RC_ASSERT(norm(moved[k].force - reactions[k].force) <= rounding);
    }
  }));
}

TYPED_TEST(ContactLaw, KeepsTheHookOnTheTileNowUnderThePoint) {
  EXPECT_TRUE(rc::check([] {
    const auto material = any_material();
    const auto path = any_path();
    Memory<double> memory;
    for (std::size_t k = 1; k < path.size(); ++k) {
      const Vector3d normal =
          rotate(exponential(Vector3d{number(-.4, .4), number(-.4, .4), 0.}), up);
      const auto point = point_at(path, k, normal, dt);
      memory = TypeParam::evaluate(point, memory, material, dt).next;
      RC_ASSERT(memory.attached == (point.depth > 0.));
      if (!memory.attached) continue;
      RC_ASSERT(std::abs(dot(memory.hook, normal)) <= 1e-16);
      const Vector3d stretch = tangential(point.position - memory.hook, normal);
      RC_ASSERT(norm(stretch - memory.stretch) <= 1e-16);
      RC_ASSERT(std::abs(dot(memory.stretch, normal)) <= 1e-16);
    }
  }));
}

TYPED_TEST(ContactLaw, ForgetsThePointOutsideTheGround) {
  const MaterialConstants<double> material;
  const Memory<double> memory{{1., 2., 0.}, {1e-3, 0., 0.}, true, true};
  for (const double depth : {0., -1e-9, -1.}) {
    const PointKinematics<double> point{{0., 0., -depth}, {1., 0., -1.}, up, depth};
    const auto reaction = TypeParam::evaluate(point, memory, material, dt);
    EXPECT_EQ(reaction.force, Vector3d{});
    EXPECT_TRUE(same(reaction.next, Memory<double>{}));
  }
}

TYPED_TEST(ContactLaw, IsPure) {
  EXPECT_TRUE(rc::check([] {
    const auto material = any_material();
    const auto path = any_path();
    const auto trial_path = any_path();
    const auto undisturbed = reactions_along<TypeParam>(path, up, material, dt);
    Memory<double> memory;
    for (std::size_t k = 1; k < path.size(); ++k) {
      TypeParam::evaluate(point_at(trial_path, k, up, dt), memory, material, dt);
      const auto reaction = TypeParam::evaluate(point_at(path, k, up, dt), memory, material, dt);
      RC_ASSERT(reaction.force == undisturbed[k - 1].force);
      RC_ASSERT(same(reaction.next, undisturbed[k - 1].next));
      memory = reaction.next;
    }
  }));
}

Vector3<Lanes> in_lanes(const Vector3d& a, const Vector3d& b) {
  return {{a.x, b.x}, {a.y, b.y}, {a.z, b.z}};
}
Vector3d lane_of(const Vector3<Lanes>& a, std::size_t i) {
  return {a.x.lane[i], a.y.lane[i], a.z.lane[i]};
}

TYPED_TEST(ContactLaw, GivesEveryLaneItsOwnAnswer) {
  EXPECT_TRUE(rc::check([] {
    const std::array paths{any_path(), any_path()};
    const auto scalar = any_material();
    MaterialConstants<Lanes> material;
    material.normal_stiffness = scalar.normal_stiffness;
    material.normal_damping = scalar.normal_damping;
    material.tangential_stiffness = scalar.tangential_stiffness;
    material.tangential_damping = scalar.tangential_damping;
    material.static_friction = scalar.static_friction;
    material.kinetic_friction = scalar.kinetic_friction;
    material.exponent = scalar.exponent;
    material.hysteresis_damping = scalar.hysteresis_damping;
    const std::array expected{reactions_along<TypeParam>(paths[0], up, scalar, dt),
                              reactions_along<TypeParam>(paths[1], up, scalar, dt)};
    Memory<Lanes> memory;
    for (std::size_t k = 1; k < paths[0].size(); ++k) {
      const auto a = point_at(paths[0], k, up, dt);
      const auto b = point_at(paths[1], k, up, dt);
      const PointKinematics<Lanes> point{in_lanes(a.position, b.position),
                                         in_lanes(a.velocity, b.velocity),
                                         in_lanes(up, up),
                                         {a.depth, b.depth}};
      const auto reaction = TypeParam::evaluate(point, memory, material, Lanes(dt));
      for (const std::size_t i : {0u, 1u}) {
        const auto& own = expected[i][k - 1];
        RC_ASSERT(norm(lane_of(reaction.force, i) - own.force) <= 1e-12 * force_scale(scalar));
        RC_ASSERT(reaction.next.attached.lane[i] == own.next.attached);
        RC_ASSERT(reaction.next.sliding.lane[i] == own.next.sliding);
      }
      memory = reaction.next;
    }
  }));
}

TYPED_TEST(ContactLaw, StaticDepthCarriesTheLoad) {
  EXPECT_TRUE(rc::check([] {
    const auto material = any_material();
    const double load = number(0.1, 1e3);
    const double depth = TypeParam::static_depth(load, material);
    const PointKinematics<double> point{{0., 0., -depth}, {}, up, depth};
    const auto reaction = TypeParam::evaluate(point, {}, material, dt);
    RC_ASSERT(norm(reaction.force - load * up) <= 1e-12 * load);
  }));
}

TYPED_TEST(ContactLaw, LinearisesItsOwnForce) {
  MaterialConstants<double> material;
  material.regularisation_speed = 0.1;
  const double load = 20.;
  const double depth = TypeParam::static_depth(load, material);
  const LinearContact linear = TypeParam::linearise(load, material);
  const auto force = [&](double deeper, double depth_rate, double shift, double speed) {
    Memory<double> memory{{0., 0., 0.}, {}, true, false};
    const PointKinematics<double> point{
        {shift, 0., -depth - deeper}, {speed, 0., -depth_rate}, up, depth + deeper};
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

TEST(LawTable, NamesEveryLawOnceAndFindsTheForceLaws) {
  ASSERT_EQ(law_table().size(), 5u);
  for (const LawDescription& law : law_table()) {
    ASSERT_EQ(find_law(law.name), &law);
    EXPECT_EQ(find_force_law(law.name).has_value(), !law.is_impulse_law) << law.name;
    EXPECT_FALSE(law.source.empty());
  }
  EXPECT_TRUE(std::holds_alternative<HookpointReset>(*find_force_law("hookpoint_reset")));
  EXPECT_TRUE(find_law("impulse_reversal")->is_impulse_law);
  EXPECT_EQ(find_law("hookpiont"), nullptr);
  EXPECT_FALSE(find_force_law("").has_value());
}

TEST(LawTable, EvaluatesTheLawItHolds) {
  const MaterialConstants<double> material;
  const PointKinematics<double> point{{0., 0., -1e-3}, {0.2, 0., -0.1}, up, 1e-3};
  const auto direct = HuntCrossley::evaluate(point, {}, material, dt);
  EXPECT_EQ(evaluate(*find_force_law("hunt_crossley"), point, {}, material, dt).force,
            direct.force);
}

}  // namespace
}  // namespace hookpoint::contact
