// Sensors against rigid-body kinematics in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "control/random.h"
#include "math/rotation.h"
#include "tests/support/component_bench.h"

namespace hookpoint {
namespace {

using testing::ComponentBench;

void set(ComponentBench& bench, const std::string& name, const Vector3d& v) {
  bench[name + "[0]"] = v.x;
  bench[name + "[1]"] = v.y;
  bench[name + "[2]"] = v.z;
}
void set(ComponentBench& bench, const Quaterniond& q_WB) {
  bench["orientation[0]"] = q_WB.w;
  bench["orientation[1]"] = q_WB.x;
  bench["orientation[2]"] = q_WB.y;
  bench["orientation[3]"] = q_WB.z;
}
void set_mounting(ComponentBench& bench, const Quaterniond& q_BS) {
  bench["mounting_orientation[0]"] = q_BS.w;
  bench["mounting_orientation[1]"] = q_BS.x;
  bench["mounting_orientation[2]"] = q_BS.y;
  bench["mounting_orientation[3]"] = q_BS.z;
}
void expect_vector(ComponentBench& bench, const std::string& name, const Vector3d& v,
                   double tolerance) {
  EXPECT_NEAR(bench[name + "[0]"], v.x, tolerance) << name;
  EXPECT_NEAR(bench[name + "[1]"], v.y, tolerance) << name;
  EXPECT_NEAR(bench[name + "[2]"], v.z, tolerance) << name;
}

/// On a circle of radius r at rate W, the velocities of two readings T apart differ by 2 W r sin(W
/// T/2) towards the centre as seen halfway, W T/2 before the later reading; as T -> 0 that is W^2 r
/// towards the centre.
Vector3d on_a_circle(double radius, double rate, double period) {
  const double half = 0.5 * rate * period;
  const double inward = 2. * rate * radius * std::sin(half) / period;
  return {-inward * std::cos(half), inward * std::sin(half), 9.81};
}

void expect_attached(const std::string& class_name, control::Attachment attachment,
                     const std::map<std::string, std::string>& ports) {
  const control::ComponentClass* type = control::Registry::instance().find(class_name);
  ASSERT_NE(type, nullptr) << class_name;
  EXPECT_EQ(type->attachment, attachment);
  std::map<std::string, std::string> found;
  const auto component = type->make();
  for (const control::PortDescription& port : component->ports()) {
    if (port.attached.empty()) continue;
    found[port.name] = port.attached;
    const bool scalar = attachment == control::Attachment::joint;
    EXPECT_EQ(port.count, port.attached == "orientation" ? 4u : scalar ? 1u : 3u) << port.name;
  }
  EXPECT_EQ(found, ports) << class_name;
}

TEST(Sensor, ReadsThePortsOfWhatItIsAttachedTo) {
  using control::Attachment;
  expect_attached("Sensor.Joint", Attachment::joint, {{"angle_in", "angle"}, {"rate_in", "rate"}});
  expect_attached("Sensor.Foot", Attachment::body, {{"contact_force", "contact.force"}});
  expect_attached("Sensor.Tilt", Attachment::body, {{"orientation", "orientation"}});
  expect_attached("Sensor.Position", Attachment::body, {{"location", "location"}});
  expect_attached("Sensor.IMU", Attachment::body,
                  {{"orientation", "orientation"},
                   {"velocity", "velocity"},
                   {"angular_velocity", "angular_velocity"}});
}

TEST(JointSensor, GivesAngleAndRate) {
  ComponentBench sensor("Sensor.Joint");
  sensor["angle_in"] = 0.5;
  sensor["rate_in"] = -3.;
  sensor.tick();
  EXPECT_EQ(sensor["angle"], 0.5);
  EXPECT_EQ(sensor["angle_rate"], -3.);
}

TEST(FootSensor, GivesForceMagnitudeAndContact) {
  ComponentBench sensor("Sensor.Foot");
  sensor["threshold"] = 13.;
  set(sensor, "contact_force", {3., -4., 12.});
  sensor.tick();
  expect_vector(sensor, "force", {3., -4., 12.}, 0.);
  EXPECT_EQ(sensor["normal"], 12.);
  EXPECT_DOUBLE_EQ(sensor["magnitude"], 13.);
  EXPECT_EQ(sensor["contact"], 0.);  // not above the threshold
  sensor["threshold"] = 12.9;
  sensor.tick();
  EXPECT_EQ(sensor["contact"], 1.);
}

TEST(FootSensor, WithoutAThresholdAnyForceIsContact) {
  ComponentBench sensor("Sensor.Foot");
  sensor.tick();
  EXPECT_EQ(sensor["contact"], 0.);
  set(sensor, "contact_force", {0., 0., 1e-9});
  sensor.tick();
  EXPECT_EQ(sensor["contact"], 1.);
}

TEST(PositionSensor, GivesTheLocation) {
  ComponentBench sensor("Sensor.Position");
  set(sensor, "location", {1., 2., 3.});
  sensor.tick();
  expect_vector(sensor, "position", {1., 2., 3.}, 0.);
}

TEST(TiltSensor, GivesRollAndPitchWhateverTheHeading) {
  ComponentBench sensor("Sensor.Tilt");
  for (const double roll : {-3., -0.5, 0., 1.2, 3.1}) {
    for (const double pitch : {-1.5, -0.3, 0., 0.7, 1.5}) {
      for (const double yaw : {-2., 0., 1.1}) {
        set(sensor, from_roll_pitch_yaw(roll, pitch, yaw));
        sensor.tick();
        EXPECT_NEAR(sensor["roll"], roll, 1e-13);
        EXPECT_NEAR(sensor["pitch"], pitch, 1e-13);
      }
    }
  }
}

TEST(TiltSensor, NoseDownIsPositivePitch) {
  ComponentBench sensor("Sensor.Tilt");
  const Quaterniond q_WB = exponential(Vector3d{0., 0.2, 0.});
  ASSERT_LT(rotate(q_WB, Vector3d{1., 0., 0.}).z, 0.);
  set(sensor, q_WB);
  sensor.tick();
  EXPECT_NEAR(sensor["pitch"], 0.2, 1e-15);
}

TEST(IMU, AtRestFeelsTheGroundPushUp) {
  ComponentBench imu("Sensor.IMU");
  imu.start();
  set(imu, Quaterniond{});
  for (int i = 0; i < 3; ++i) {
    imu.tick();
    expect_vector(imu, "accelerometer", {0., 0., 9.81}, 0.);
    expect_vector(imu, "gyroscope", {}, 0.);
  }
  // Rolled by a quarter turn to the right the body's y points up; pitched nose down, its -x.
  set(imu, from_roll_pitch_yaw(std::numbers::pi / 2., 0., 0.));
  imu.tick();
  expect_vector(imu, "accelerometer", {0., 9.81, 0.}, 1e-14);
  set(imu, from_roll_pitch_yaw(0., std::numbers::pi / 2., 0.));
  imu.tick();
  expect_vector(imu, "accelerometer", {-9.81, 0., 0.}, 1e-14);
}

/// Screwed in upside down, then with its x along the body's y.
TEST(IMU, ReadsInTheAxesOfItsMounting) {
  ComponentBench imu("Sensor.IMU");
  imu.start();
  set(imu, Quaterniond{});
  set(imu, "angular_velocity", {1., 2., 3.});
  set_mounting(imu, from_roll_pitch_yaw(std::numbers::pi, 0., 0.));
  imu.tick();
  expect_vector(imu, "accelerometer", {0., 0., -9.81}, 1e-14);
  expect_vector(imu, "gyroscope", {1., -2., -3.}, 1e-14);
  set_mounting(imu, from_roll_pitch_yaw(0., 0., std::numbers::pi / 2.));
  set(imu, "accelerometer_bias", {0.1, 0.2, 0.3});
  imu.tick();
  expect_vector(imu, "accelerometer", {0.1, 0.2, 9.81 + 0.3}, 1e-14);
  expect_vector(imu, "gyroscope", {2., -1., 3.}, 1e-14);
}

/// The place is counted in the body's axes, whatever the unit's: on a circle the specific force
/// towards the centre is -x of the body, -y of a unit that is turned by -90 deg about z.
TEST(IMU, PlaceOfATurnedUnitIsInTheBodysAxes) {
  const double radius = 0.3, rate = 4., period = 0.01;
  ComponentBench imu("Sensor.IMU", period);
  imu["mounting[0]"] = radius;
  set_mounting(imu, from_roll_pitch_yaw(0., 0., -std::numbers::pi / 2.));
  imu.start();
  for (int k = 0; k < 5; ++k) {
    set(imu, from_roll_pitch_yaw(0., 0., rate * k * period));
    set(imu, "angular_velocity", {0., 0., rate});
    imu.tick();
    const Vector3d a = on_a_circle(radius, rate, period);
    if (k > 0) expect_vector(imu, "accelerometer", {-a.y, a.x, a.z}, 1e-12);
  }
}

/// Of a unit that is upside down (about x) roll is half a turn off and pitch is that of the body.
TEST(TiltSensor, ReadsTheTiltOfItsMounting) {
  ComponentBench sensor("Sensor.Tilt");
  set_mounting(sensor, from_roll_pitch_yaw(std::numbers::pi, 0., 0.));
  set(sensor, from_roll_pitch_yaw(0.4, 0.3, 1.1));
  sensor.tick();
  EXPECT_NEAR(sensor["roll"], 0.4 - std::numbers::pi, 1e-14);
  EXPECT_NEAR(sensor["pitch"], 0.3, 1e-14);
  // Turned by 90 deg about z: it rolls as the body pitches, and pitches against the body's roll.
  set_mounting(sensor, from_roll_pitch_yaw(0., 0., std::numbers::pi / 2.));
  set(sensor, from_roll_pitch_yaw(0., 0.3, 0.));
  sensor.tick();
  EXPECT_NEAR(sensor["roll"], 0.3, 1e-14);
  EXPECT_NEAR(sensor["pitch"], 0., 1e-14);
  set(sensor, from_roll_pitch_yaw(0.4, 0., 0.));
  sensor.tick();
  EXPECT_NEAR(sensor["roll"], 0., 1e-14);
  EXPECT_NEAR(sensor["pitch"], -0.4, 1e-14);
}

TEST(IMU, GravityIsAParameter) {
  ComponentBench imu("Sensor.IMU");
  imu["gravity"] = 1.62;
  imu["horizontal_gravity[0]"] = 0.5;
  imu["horizontal_gravity[1]"] = -0.25;
  imu.start();
  set(imu, Quaterniond{});
  imu.tick();
  expect_vector(imu, "accelerometer", {-0.5, 0.25, 1.62}, 0.);
}

TEST(IMU, TheFirstReadingKnowsNoAcceleration) {
  ComponentBench imu("Sensor.IMU", 0.001);
  imu.start();
  set(imu, Quaterniond{});
  set(imu, "velocity", {5., -2., 1.});
  imu.tick();
  expect_vector(imu, "accelerometer", {0., 0., 9.81}, 0.);
}

TEST(IMU, FallingFeelsNothing) {
  const double period = 1. / 128.;
  ComponentBench imu("Sensor.IMU", period);
  imu.start();
  set(imu, from_roll_pitch_yaw(0.3, -0.4, 2.));
  for (int k = 0; k < 50; ++k) {
    set(imu, "velocity", {0.7, -0.2, 3. - 9.81 * k * period});
    imu.tick();
    if (k > 0) expect_vector(imu, "accelerometer", {}, 1e-11);
  }
}

TEST(IMU, BodyThatRunsOnACircle) {
  const double radius = 0.3, rate = 4.;
  for (const double period : {0.001, 0.01, 0.1}) {
    ComponentBench imu("Sensor.IMU", period);
    imu.start();
    for (int k = 0; k < 20; ++k) {
      const double angle = rate * k * period;
      set(imu, from_roll_pitch_yaw(0., 0., angle));
      set(imu, "velocity", {-radius * rate * std::sin(angle), radius * rate * std::cos(angle), 0.});
      set(imu, "angular_velocity", {0., 0., rate});
      imu.tick();
      if (k == 0) continue;
      const Vector3d expected = on_a_circle(radius, rate, period);
      expect_vector(imu, "accelerometer", expected, 1e-11);
      EXPECT_NEAR(expected.x, -rate * rate * radius, rate * rate * radius * rate * period);
      expect_vector(imu, "gyroscope", {0., 0., rate}, 0.);
    }
  }
}

TEST(IMU, MountedOffCentreOnABodyThatSpinsInPlace) {
  const double radius = 0.3, rate = 4., period = 0.01;
  ComponentBench imu("Sensor.IMU", period);
  imu["mounting[0]"] = radius;
  imu.start();
  for (int k = 0; k < 20; ++k) {
    set(imu, from_roll_pitch_yaw(0., 0., rate * k * period));
    set(imu, "angular_velocity", {0., 0., rate});
    imu.tick();
    if (k > 0) expect_vector(imu, "accelerometer", on_a_circle(radius, rate, period), 1e-12);
  }
}

TEST(IMU, GyroscopeTurnsWithTheBody) {
  ComponentBench imu("Sensor.IMU");
  imu.start();
  // Pitched by a quarter turn, the body's x points down: the world's z is its -x.
  set(imu, from_roll_pitch_yaw(0., std::numbers::pi / 2., 0.));
  set(imu, "angular_velocity", {0., 2., 5.});
  imu.tick();
  expect_vector(imu, "gyroscope", {-5., 2., 0.}, 1e-14);
}

TEST(IMU, BiasIsAddedInBodyAxes) {
  ComponentBench imu("Sensor.IMU");
  set(imu, "accelerometer_bias", {0.1, 0.2, 0.3});
  set(imu, "gyroscope_bias", {-1., 2., -3.});
  imu.start();
  set(imu, from_roll_pitch_yaw(std::numbers::pi / 2., 0., 0.));
  imu.tick();
  expect_vector(imu, "accelerometer", {0.1, 9.81 + 0.2, 0.3}, 1e-14);
  expect_vector(imu, "gyroscope", {-1., 2., -3.}, 0.);
}

TEST(IMU, NoiseIsWhiteAndOfEachAxisItsOwn) {
  constexpr int readings = 40000;
  ComponentBench imu("Sensor.IMU");
  imu["accelerometer_noise"] = 0.05;
  imu["gyroscope_noise"] = 0.002;
  imu.component().set_stream(control::stream_key(1, "bot.imu"));
  imu.start();
  set(imu, Quaterniond{});
  const std::string names[] = {"accelerometer[0]", "accelerometer[1]", "accelerometer[2]",
                               "gyroscope[0]",     "gyroscope[1]",     "gyroscope[2]"};
  double products[6][6] = {}, successive[6] = {}, last[6] = {};
  for (int k = 0; k < readings; ++k) {
    imu.tick();
    double noise[6];
    for (int i = 0; i < 6; ++i) {
      noise[i] = (imu[names[i]] - (i == 2 ? 9.81 : 0.)) / (i < 3 ? 0.05 : 0.002);
    }
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) products[i][j] += noise[i] * noise[j] / readings;
      successive[i] += noise[i] * last[i] / readings;
      last[i] = noise[i];
    }
  }
  const double error = 4.5 / std::sqrt(readings);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(successive[i], 0., error);
    for (int j = 0; j < 6; ++j) {
      EXPECT_NEAR(products[i][j], i == j ? 1. : 0., i == j ? std::sqrt(2.) * error : error);
    }
  }
}

/// A random walk whose bias changes by w in 1 s has the variance w^2 t after t, whatever the
/// period.
TEST(IMU, BiasWalksWithTheRootOfTime) {
  constexpr int units = 600;
  for (const double period : {0.01, 0.05}) {
    double accelerometer = 0., gyroscope = 0.;
    for (int unit = 0; unit < units; ++unit) {
      ComponentBench imu("Sensor.IMU", period);
      imu["accelerometer_walk"] = 0.3;
      imu["gyroscope_walk"] = 0.1;
      imu.component().set_stream(control::stream_key(unit, "imu"));
      imu.start();
      set(imu, Quaterniond{});
      imu.tick();
      EXPECT_EQ(imu["gyroscope[0]"], 0.);
      imu.tick(static_cast<int>(std::lround(2. / period)));
      for (const char* axis : {"[0]", "[1]", "[2]"}) {
        const double drift = imu[std::string("accelerometer_drift") + axis];
        accelerometer += drift * drift / (3. * units);
        EXPECT_EQ(imu[std::string("gyroscope_drift") + axis], imu[std::string("gyroscope") + axis]);
        gyroscope += std::pow(imu[std::string("gyroscope") + axis], 2) / (3. * units);
      }
    }
    const double error = 4. * std::sqrt(2. / (3. * units));
    EXPECT_NEAR(accelerometer / (0.09 * 2.), 1., error);
    EXPECT_NEAR(gyroscope / (0.01 * 2.), 1., error);
  }
}

}  // namespace
}  // namespace hookpoint
