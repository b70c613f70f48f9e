// Where shapes touch in one state, whatever was before: for analyses and watches, which see single states.
#pragma once

#include <span>
#include <vector>

#include "simulation/dts_engine/shape_detection.h"

namespace hookpoint::simulation {

class MemorylessDetection final : private DetectionMemory {
 public:
  struct Options {
    bool self = false;  ///< bodies of one robot count too, whatever its self_contact says
    /// Nothing comes inside but by rounding: what lies on a surface is seen from outside.
    bool stays_outside = false;
  };
  /// All that is referred to outlives it; `ground` may be null. `reach` [m]: how near counts.
  MemorylessDetection(const Experiment& experiment, const contact::Terrain* ground, double reach,
                      const Options& options);

  const std::vector<ShapeObject>& objects() const { return objects_; }
  /// How the objects move that were looked at last.
  std::span<const ObjectMotion> motions() const { return motions_; }
  /// Of obstacles and terrain as `inputs` say, `elapsed` [s] later, of bodies as `body_motion(object)` says.
  template <class BodyMotion>
  std::span<const ShapeContact> detect(const WorldInputs& inputs, const BodyMotion& body_motion,
                                       double elapsed = 0.) {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      const ShapeObject& object = objects_[i];
      if (object.kind == ShapeObject::Kind::body)
        static_cast<dts::BodyMotion<double>&>(motions_[i]) = body_motion(object);
      else if (object.kind == ShapeObject::Kind::terrain)
        motions_[i] = motion_of(inputs.ground, elapsed);
      else
        motions_[i] = motion_of(inputs.obstacles[object.index], elapsed);
    }
    detection_.detect(motions_, *this, contacts_);
    return contacts_;
  }

 private:
  const ObjectMotion& before(std::size_t object) const override { return motions_[object]; }
  bool stays_outside() const override { return stays_outside_; }
  contact::Holding holding(const ContactKey&) const override { return {}; }
  std::optional<PressingPlace> place_near(std::size_t, std::size_t, const Vector3d&,
                                          double) const override {
    return std::nullopt;
  }
  std::optional<PressingPlace> place_beside(std::size_t, std::size_t,
                                            const Vector3d&) const override {
    return std::nullopt;
  }
  double begun_at(const ShapeContact&, const PressingPlace&) const override { return 0.; }

  const bool stays_outside_;
  std::vector<ShapeObject> objects_;
  ShapeDetection detection_;
  std::vector<ObjectMotion> motions_;
  std::vector<ShapeContact> contacts_;
};

}  // namespace hookpoint::simulation
