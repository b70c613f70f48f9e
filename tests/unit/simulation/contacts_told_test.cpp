// What touches the ground, as those see it who look on: against weights, slopes and springs.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/engines.h"
#include "tests/support/folders.h"
#include "tests/support/shown_text.h"

namespace hookpoint {
namespace {

using simulation::ContactView;
using simulation::World;

constexpr double g = 9.81;

std::vector<ContactView> contacts_of(const World& world) {
  std::vector<ContactView> contacts;
  world.tell_contacts(contacts);
  return contacts;
}

void run(World& world, double time) {
  while (world.state().time < time) ASSERT_TRUE(world.step().ok());
}

Vector3d sum_of_forces(const std::vector<ContactView>& contacts) {
  Vector3d sum;
  for (const ContactView& contact : contacts) sum += contact.force;
  return sum;
}

/// A box of 1 kg, 0.2 x 0.2 x 0.1 m, on a slope; `more` is said in the world.
std::string block(double slope, double mu, const std::string& more = "") {
  std::ostringstream text;
  text << "World w { deltat = 1 ms; " << more
       << "Material m { normal_stiffness = 20 kN/m; normal_damping = 40 N.s/m;"
          " tangential_stiffness = 20 kN/m; tangential_damping = 40 N.s/m; static_friction = "
       << mu << "; kinetic_friction = " << mu << "; }"
       << "Terrain.Slope ground { angle = " << slope << "; material = m; }"
       << "Robot b { Base.mobile { rest_on = ground; Shape.Box { dimensions = 0.2,0.2,0.1; mass = "
          "1; } } } }";
  return text.str();
}

TEST(ContactsTold, CarryAStandingHexapod) {
  Shown shown(std::filesystem::path(testing::source_folder()) /
              "configs/scenes/standing_hexapod.hook");
  run(shown.world(), 4.);
  const auto contacts = contacts_of(shown.world());
  EXPECT_EQ(contacts.size(), 6u);
  const double weight = (2. + 6. * (0.1 + 0.15 + 0.12)) * g;
  EXPECT_NEAR(sum_of_forces(contacts).z, weight, 1e-3 * weight);
  for (const ContactView& contact : contacts) {
    EXPECT_LT(norm(contact.hook - contact.point), 1e-3);
    EXPECT_EQ(contact.sliding, 0.);
    EXPECT_GT(contact.depth, 0.);
    // On the level ground z = 0 as deep as it says.
    EXPECT_NEAR(contact.point.z, -contact.depth, 1e-12);
    EXPECT_LT(contact.body, shown.world().state().bodies.size());
  }
}

// A block at rest hangs on its hooks: k_t times the stretch is the weight along the slope, m g sin
// a, of each of four corners its part.
TEST(ContactsTold, StretchTheirHooksByForceOverStiffness) {
  const double slope = 0.2, stiffness = 2e4;
  ShownText shown(block(slope, 0.8));
  const Vector3d down{std::cos(slope), 0., -std::sin(slope)};
  run(shown->world(), 3.);
  const auto contacts = contacts_of(shown->world());
  ASSERT_EQ(contacts.size(), 4u);
  double stretched = 0.;
  for (const ContactView& contact : contacts) {
    const double stretch = dot(contact.point - contact.hook, down);
    EXPECT_NEAR(stretch, -dot(contact.force, down) / stiffness, 1e-9);
    EXPECT_EQ(contact.sliding, 0.);
    stretched += stretch;
  }
  EXPECT_NEAR(stretched, g * std::sin(slope) / stiffness, 1e-8);
  // The hooks stay where they are.
  run(shown->world(), 4.);
  const auto later = contacts_of(shown->world());
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(norm(later[i].hook - contacts[i].hook), 1e-9);
}

TEST(ContactsTold, SayThatABlockSlides) {
  ShownText shown(block(0.5, 0.2));
  run(shown->world(), 1.);
  const auto contacts = contacts_of(shown->world());
  ASSERT_FALSE(contacts.empty());
  for (const ContactView& contact : contacts) EXPECT_EQ(contact.sliding, 1.);
}

TEST(ContactsTold, AreNoneInFlight) {
  ShownText shown(
      "World w { Terrain.Flat ground { } Robot b { Base.mobile { location = 0,0,3; "
      "mass = 1; Shape.Sphere radius = 0.1; } } }");
  EXPECT_TRUE(contacts_of(shown->world()).empty());
}

// An impulse law's are the mean force of the step in equal parts.
TEST(ContactsTold, AddUpToTheMeanForceUnderImpulses) {
  ShownText shown(block(0., 0.8, "contact = impulse; "));
  run(shown->world(), 1.);
  const auto contacts = contacts_of(shown->world());
  ASSERT_EQ(contacts.size(), 4u);
  EXPECT_LT(norm(sum_of_forces(contacts) - shown->world().state().bodies[0].contact_force), 1e-12);
  for (const ContactView& contact : contacts) EXPECT_EQ(contact.sliding, -1.);
}

TEST(ContactsTold, CarryABlockInPeers) {
  for (const char* engine : {"ode", "bullet"}) {
    ShownText shown(block(0., 0.8, std::string("engine = ") + engine + "; "));
    for (const reference::Peer& peer : reference::known_peers()) {
      if (peer.name != engine || !peer.found()) continue;
      World world(shown->experiment(), peer.make(shown->experiment()));
      run(world, 2.);
      const auto contacts = contacts_of(world);
      EXPECT_FALSE(contacts.empty());
      EXPECT_NEAR(sum_of_forces(contacts).z, g, 0.02 * g) << engine;
      for (const ContactView& contact : contacts) {
        EXPECT_EQ(contact.hook, contact.point);
        EXPECT_EQ(contact.sliding, -1.);
      }
    }
  }
}

// Looking on changes no bit of the run.
TEST(ContactsTold, LeaveTheRunAsItIs) {
  ShownText watched(block(0.5, 0.2)), alone(block(0.5, 0.2));
  for (int step = 0; step < 500; ++step) {
    ASSERT_TRUE(watched->world().step().ok());
    ASSERT_TRUE(alone->world().step().ok());
    contacts_of(watched->world());
  }
  EXPECT_EQ(watched->world().state().bodies[0].position, alone->world().state().bodies[0].position);
  EXPECT_EQ(watched->world().state().bodies[0].velocity, alone->world().state().bodies[0].velocity);
}

}  // namespace
}  // namespace hookpoint
