#include "control/components/foot_path.h"

#include <algorithm>
#include <cmath>

#include "math/scalar.h"

namespace hookpoint::control {
namespace {

/// Time [s] in which a foot that has found the ground off its nominal height returns to it.
constexpr double height_recovery = 0.5;

Vector3d turned(const Vector3d& p, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  return {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y, p.z};
}

}  // namespace

Vector3d carried(const Vector3d& p, const PlanarTwist& twist, double time) {
  const double half = 0.5 * twist.turn * time;
  // The chord of the body's arc: t sinc(w t / 2) v, turned by half the angle.
  const double chord =
      std::abs(half) < 1e-4 ? time * (1. - half * half / 6.) : time * std::sin(half) / half;
  const Vector3d moved = turned({chord * twist.forward, chord * twist.sideways, 0.}, half);
  return turned(p - moved, -2. * half);
}

Vector3d ground_velocity(const Vector3d& p, const PlanarTwist& twist) {
  return {twist.turn * p.y - twist.forward, -twist.turn * p.x - twist.sideways, 0.};
}

void FootPath::stand(const PlanarTwist& twist, double dt, const GroundSearch& search) {
  double height = position.z;
  if (search.sensed && !search.contact) {
    height = std::max(height - search.speed * dt, std::min(height, -search.depth));
  } else {
    height *= std::exp(-dt / height_recovery);
  }
  position = carried(position, twist, dt);
  position.z = height;
}

void FootPath::lift_off(const PlanarTwist& twist) {
  origin = position;
  origin_velocity = ground_velocity(position, twist);
  progress = 0.;
}

void FootPath::swing(double done, const Vector3d& target, const PlanarTwist& twist, double duration,
                     double step_height) {
  const double s = done, r = 1. - s;
  const double arrived = s * s * (3. - 2. * s);
  const Vector3d end_velocity = ground_velocity(target, twist);
  position = (1. - arrived) * origin + arrived * target + (duration * s * r * r) * origin_velocity -
             (duration * s * s * r) * end_velocity;
  position.z = (1. - arrived) * origin.z + step_height * 64. * s * s * s * r * r * r;
  progress = s;
}

}  // namespace hookpoint::control
