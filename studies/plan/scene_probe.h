// What a scene has by which names, before any run is planned: the ports that a study measures and
// the constants that its closed forms take.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "language/document.h"
#include "simulation/scene/trails.h"

namespace hookpoint::studies {

/// A port of the scene.
struct ScenePort {
  std::string trail;                             ///< as a run knows it
  std::optional<language::Dimension> dimension;  ///< nothing where its class leaves it open
  std::string missing;  ///< why a run of the experiment has none, where one is given; "": it has
};

/// A number that stands in the scene.
struct SceneNumber {
  double value = 0.;  ///< SI
  std::optional<language::Dimension> dimension;
};

/// Looks names up in a scene that is laid down; trails from the top, or from within its World.
class SceneNames {
 public:
  /// `tree` outlives it.
  explicit SceneNames(const language::Object& tree);
  const language::Object& tree() const { return tree_; }
  /// Nothing, with `why`, where `trail` is no number of a run. `experiment`: of `tree`; may be
  /// null.
  std::optional<ScenePort> port(const std::string& trail, std::string& why,
                                const simulation::Experiment* experiment = nullptr);
  /// A Param of the scene, or a field that holds a number. Nothing, with `why`, for anything else.
  std::optional<SceneNumber> number(const std::string& name, std::string& why);

 private:
  std::optional<language::Target> resolve(const std::string& trail, std::string& why);

  const language::Object& tree_;
  const language::Object* world_ = nullptr;
  simulation::ObjectTrails trails_;
  language::Names names_;
};

}  // namespace hookpoint::studies
