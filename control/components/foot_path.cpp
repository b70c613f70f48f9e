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

/// Height in a swing by the greatest.
double share_of_height(double s, double lift) {
  const double r = 1. - s;
  if (lift == 0.) return 64. * s * s * s * r * r * r;
  const double grown = std::min(1., std::min(s, r) / (2. * lift));
  return grown * grown * grown * (10. - 15. * grown + 6. * grown * grown);
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
                     const SwingHeight& height) {
  const Vector3d end_velocity = ground_velocity(target, twist);
  // Of the part between rising and sinking; there the foot leaves and meets points of the ground.
  const double lift = height.lift;
  const double s = std::clamp((done - lift) / (1. - 2. * lift), 0., 1.), r = 1. - s;
  const double between = (1. - 2. * lift) * duration, over = lift * duration;
  const Vector3d from = origin + over * origin_velocity, to = target - over * end_velocity;
  const double arrived = s * s * (3. - 2. * s);
  position = (1. - arrived) * from + arrived * to + (between * s * r * r) * origin_velocity -
             (between * s * s * r) * end_velocity;
  // Over the points that it leaves and meets.
  position += (std::min(done - lift, 0.) * duration) * origin_velocity +
              (std::max(done - 1. + lift, 0.) * duration) * end_velocity;
  position.z = (1. - arrived) * origin.z + height.step_height * share_of_height(done, lift);
  progress = done;
}

}  // namespace hookpoint::control
