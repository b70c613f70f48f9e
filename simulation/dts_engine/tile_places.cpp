#include "simulation/dts_engine/tile_places.h"

#include <utility>

namespace hookpoint::simulation {

TilePlaces::TilePlaces(std::vector<BoundaryPoint> points)
    : points_(std::move(points)), places_(points_.size()) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    places_[i].sides[0].body = points_[i].body;
    places_[i].side_count = 1;
    places_[i].surface = 0;
  }
}

void TilePlaces::locate(std::span<const ArticulatedRobot> robots,
                        const contact::GroundQuery& ground, double /*elapsed*/) {
  const auto& bodies = robots[0].workspace().bodies;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const BoundaryPoint& point = points_[i];
    const dts::BodyMotion<double>& body = bodies[point.body];
    ImpulsePlace& place = places_[i];
    PlaceSide& side = place.sides[0];
    side.center = body.R_WB * point.p_BP;
    place.ground = ground(body.p_WB + side.center, point.foot_material);
    place.ground.gap -= point.radius;
    side.arm = side.center - point.radius * place.ground.normal;
  }
}

}  // namespace hookpoint::simulation
