// The ground of an impulse law under `touch = points`: the tile under a point.
#pragma once

#include "contact/terrain/ground_query.h"
#include "contact/terrain/terrain.h"
#include "simulation/experiment/contact_materials.h"

namespace hookpoint::simulation {

class ImpulseGround {
 public:
  /// `ground` may be null. All that is referred to outlives it.
  ImpulseGround(const Experiment& experiment, const contact::Terrain* ground)
      : ground_(ground), materials_(experiment) {}

  bool exists() const { return ground_ != nullptr; }
  struct Place : contact::GroundPoint {
    bool outside = false;  ///< beside the terrain
  };
  /// Of a ball's centre: the gap of the centre.
  Place at(const Vector3d& center, int foot_material) const {
    const contact::TilePoint tile = ground_->query(center);
    return {{-tile.depth, tile.normal, &materials_.of(foot_material, tile.material)}, tile.outside};
  }

 private:
  const contact::Terrain* ground_;
  ContactMaterials materials_;
};

}  // namespace hookpoint::simulation
