// The places of all robots under `touch = shapes`: wherever features of shapes are near each other, on
// terrain, obstacles and bodies, still or moving.
#pragma once

#include <vector>

#include "simulation/dts_engine/impulse_places.h"
#include "simulation/dts_engine/memoryless_detection.h"
#include "simulation/experiment/contact_materials.h"

namespace hookpoint::simulation {

class ShapePlaces final : public ImpulsePlaces {
 public:
  /// `reach` [m]: how near things are looked at; beyond, nothing is hit in one flight. Gaps are given
  /// smaller by `margin` [m], so that what touches stays outside, where it is plain which face of a
  /// solid it touches. `ground` may be null. All that is referred to outlives it.
  ShapePlaces(const Experiment& experiment, const contact::Terrain* ground,
              const WorldInputs& inputs, double reach, double margin);

  std::size_t room() const override { return room_; }
  void begin_step() override;
  void locate(std::span<const ArticulatedRobot> robots, const contact::GroundQuery& ground,
              double elapsed) override;
  std::span<const ImpulsePlace> places() const override { return places_; }
  double margin() const override { return margin_; }
  std::optional<Vector3d> beside_ground(const Vector3d& p_W) const override;
  double longest_flight(double turn, double travel) const override;

 private:
  /// Which place of which features: a ball in a groove has several.
  struct Name {
    ContactKey key;
    std::size_t repeat = 0;
    auto operator<=>(const Name&) const = default;
  };
  /// Number of the place of that name; the next free one for a new name, none where there is no room.
  std::optional<std::size_t> number_of(const Name& name);
  void put(const ShapeContact& contact, std::span<const ArticulatedRobot> robots,
           ImpulsePlace& place) const;

  MemorylessDetection detection_;
  ContactMaterials materials_;
  const WorldInputs& inputs_;
  const contact::Terrain* ground_;
  const double margin_;
  std::size_t room_;
  std::vector<ImpulsePlace> places_;
  std::vector<Name> names_;          ///< of each place
  std::vector<std::size_t> sorted_;  ///< numbers of places, in the order of their names
};

}  // namespace hookpoint::simulation
