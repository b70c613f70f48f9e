// An inertial measurement unit: an accelerometer, which feels everything but gravity, and a
// gyroscope, with their errors.
//
//   accelerometer = R^T (dv/dt - g) + bias + noise        gyroscope = R^T w + bias + noise
//
// R = R_WB R_BS turns the unit's axes S, which its mounting turns from the body's B, into the
// world's.
// dv/dt is the difference of velocities over the unit's own period: the mean acceleration of that
// period, as a unit that integrates between readings reports it.
#include <cmath>

#include "control/components/mounting.h"
#include "control/random.h"
#include "control/registry.h"
#include "math/rotation.h"

namespace hookpoint::control {
namespace {

class InertialMeasurementUnit final : public Component {
 public:
  Parameter gravity = Parameter{*this, "gravity", "m/s^2", 9.81, "along the world's -z"}.of_world(
      WorldValue::gravity_down);
  Parameter horizontal_gravity =
      Parameter{*this, "horizontal_gravity", "m/s^2", 0., "its x and y", 2}.of_world(
          WorldValue::gravity_sideways);
  Parameter mounting{*this, "mounting", "m", 0., "place of the unit in the body's frame", 3};
  Parameter mounting_orientation = mounting_orientation_of(*this);
  Parameter accelerometer_bias{
      *this, "accelerometer_bias", "m/s^2", 0., "constant error, the unit's axes", 3};
  Parameter accelerometer_noise =
      Parameter{*this, "accelerometer_noise", "m/s^2", 0., "standard deviation of a reading"}.range(
          0., 1e9);
  Parameter accelerometer_walk =
      Parameter{*this, "accelerometer_walk", "m/s^2", 0.,
                "random walk of the bias: standard deviation of its change in 1 s"}
          .range(0., 1e9);
  Parameter gyroscope_bias{*this, "gyroscope_bias", "rad/s", 0., "constant error, the unit's axes",
                           3};
  Parameter gyroscope_noise =
      Parameter{*this, "gyroscope_noise", "rad/s", 0., "standard deviation of a reading"}.range(
          0., 1e9);
  Parameter gyroscope_walk =
      Parameter{*this, "gyroscope_walk", "rad/s", 0.,
                "random walk of the bias: standard deviation of its change in 1 s"}
          .range(0., 1e9);

  Input orientation =
      Input{*this, "orientation", "", "R_WB as a quaternion w, x, y, z", 0., 4}.attached(
          "orientation");
  Input velocity =
      Input{*this, "velocity", "m/s", "of the body's origin, world axes", 0., 3}.attached(
          "velocity");
  Input angular_velocity =
      Input{*this, "angular_velocity", "rad/s", "of the body, world axes", 0., 3}.attached(
          "angular_velocity");

  Output accelerometer{*this, "accelerometer", "m/s^2", "specific force, the unit's axes x, y, z",
                       3};
  Output gyroscope{*this, "gyroscope", "rad/s", "angular velocity, the unit's axes x, y, z", 3};

  State last_velocity{*this, "last_velocity", "m/s", "of the unit at its last reading, world axes",
                      3};
  State accelerometer_drift{*this, "accelerometer_drift", "m/s^2",
                            "bias gained by the random walk, the unit's axes", 3};
  State gyroscope_drift{*this, "gyroscope_drift", "rad/s",
                        "bias gained by the random walk, the unit's axes", 3};

  void start(double) override {
    for (std::uint32_t channel = 0; channel < 12; ++channel) {
      noise_[channel] = RandomStream(stream(), channel);
    }
  }

  void update(const Tick& tick) override {
    const Quaterniond q_SW = conjugate(unit_orientation(orientation, mounting_orientation));
    const Vector3d w_WB = vector(angular_velocity);
    const Vector3d v_W =
        vector(velocity) + cross(w_WB, rotate(quaternion_of(orientation), vector(mounting)));
    const Vector3d last_W{last_velocity.get(0), last_velocity.get(1), last_velocity.get(2)};
    // The first reading has no difference to take: the unit is then taken to be unaccelerated.
    const Vector3d a_W = tick.count == 0 ? Vector3d{} : (1. / tick.period) * (v_W - last_W);
    const Vector3d g_W{horizontal_gravity[0], horizontal_gravity[1], -gravity};
    put(last_velocity, v_W);
    put(accelerometer,
        rotate(q_SW, a_W - g_W) + vector(accelerometer_bias) +
            error(0, accelerometer_drift, accelerometer_walk, accelerometer_noise, tick));
    put(gyroscope, rotate(q_SW, w_WB) + vector(gyroscope_bias) +
                       error(6, gyroscope_drift, gyroscope_walk, gyroscope_noise, tick));
  }

 private:
  template <class Port>
  static Vector3d vector(const Port& port) {
    return {port[0], port[1], port[2]};
  }
  template <class Port>
  static void put(Port& port, const Vector3d& a) {
    port.set(0, a.x);
    port.set(1, a.y);
    port.set(2, a.z);
  }

  /// Drift, which first takes its step, plus white noise; from the six streams from `channel` on.
  Vector3d error(std::size_t channel, State& drift, double walk, double noise,
                 const Tick& tick) const {
    const auto n = static_cast<std::uint64_t>(tick.count);
    double sum[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Independent steps add their variances: walk^2 T a period T.
      if (walk > 0. && tick.count > 0) {
        drift.set(axis, drift.get(axis) +
                            walk * std::sqrt(tick.period) * noise_[channel + axis].gaussian(n));
      }
      sum[axis] = drift.get(axis);
      if (noise > 0.) sum[axis] += noise * noise_[channel + 3 + axis].gaussian(n);
    }
    return {sum[0], sum[1], sum[2]};
  }

  RandomStream noise_[12];
};

HOOKPOINT_REGISTER_COMPONENT(InertialMeasurementUnit, "Sensor.IMU",
                             "accelerometer and gyroscope of a body, with bias, drift and noise",
                             Attachment::body, "", "accelerometer")

}  // namespace
}  // namespace hookpoint::control
