#include "simulation/dts_engine/object_motion.h"

namespace hookpoint::simulation {

ObjectMotion motion_of(const BodyState& body) {
  ObjectMotion motion;
  motion.p_WB = body.position;
  motion.R_WB = rotation_matrix(body.orientation);
  motion.v_WB = body.velocity;
  motion.w_WB = body.angular_velocity;
  return motion;
}

ObjectMotion motion_of(const SurfaceMotion& surface, double elapsed) {
  ObjectMotion motion;
  motion.p_WB = surface.position + elapsed * surface.velocity;
  motion.R_WB =
      rotation_matrix(exponential(elapsed * surface.angular_velocity) * surface.orientation);
  motion.v_WB = surface.velocity;
  motion.w_WB = surface.angular_velocity;
  motion.belt = surface.belt_velocity;
  return motion;
}

}  // namespace hookpoint::simulation
