// A scene in Foxglove's own messages, as JSON: FrameTransforms with the bodies' poses at an
// instant, SceneUpdate with what is drawn. Their schemas have the properties that are written here.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/records/scene.h"

namespace hookpoint::output::foxglove {

/// The frame of all poses: they are published in world axes, and so nothing is rounded on the way.
inline constexpr std::string_view world_frame = "world";

std::string frame_transforms_schema();
std::string scene_update_schema();

class FrameTransforms {
 public:
  explicit FrameTransforms(std::span<const SceneBody> bodies);
  /// No message has more bytes.
  std::size_t longest() const { return longest_; }
  /// Appends the message of an instant [ns]. `poses`: numbers_of_pose a body. JSON has no word for
  /// what is not finite: a body with such a number has no transform in that message. Allocates
  /// nothing where `text` has the room.
  void append(std::string& text, std::uint64_t time, std::span<const double> poses) const;

 private:
  std::vector<std::string> frames_;  ///< the members that stay, a body each
  std::size_t longest_ = 0;
};

/// Every body's shapes in the body's frame, and the ground in its own or the world's: sent once,
/// they move with the transforms.
class SceneUpdate {
 public:
  explicit SceneUpdate(const Scene& scene);
  std::size_t longest() const { return longest_; }
  void append(std::string& text, std::uint64_t time) const;

 private:
  std::vector<std::string> entities_;  ///< without their opening and their timestamp
  std::size_t longest_ = 0;
};

}  // namespace hookpoint::output::foxglove
