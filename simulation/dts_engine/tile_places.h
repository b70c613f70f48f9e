// The places of one robot on tiles: its boundary points, each over the tile under it.
#pragma once

#include <vector>

#include "simulation/dts_engine/contact_point.h"
#include "simulation/dts_engine/impulse_places.h"

namespace hookpoint::simulation {

class TilePlaces final : public ImpulsePlaces {
 public:
  explicit TilePlaces(std::vector<BoundaryPoint> points);

  std::size_t room() const override { return places_.size(); }
  void locate(std::span<const ArticulatedRobot> robots, const contact::GroundQuery& ground,
              double elapsed) override;
  std::span<const ImpulsePlace> places() const override { return places_; }

 private:
  std::vector<BoundaryPoint> points_;
  std::vector<ImpulsePlace> places_;
};

}  // namespace hookpoint::simulation
