// The scene of a tuning: a world, another ground under it where one is named, and constants set
// from outside.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "language/document/document.h"
#include "studies/blocks/varied_scene.h"
#include "studies/plan/scene.h"

namespace hookpoint::studies {

/// What a constant of a tuning is in its files; a Param of the scene, of its ground, or of both.
enum class ConstantPlace { parameter, material_field, world_field };

/// A constant and the text of its value.
struct ConstantSetting {
  ConstantPlace place = ConstantPlace::parameter;
  std::string name;
  std::string text;
};

/// The files and what does not change from candidate to candidate.
struct SceneSource {
  std::filesystem::path scene;
  std::filesystem::path terrain;         ///< empty: the scene's own ground
  std::string material;                  ///< "": that of the ground, where it has one alone
  std::vector<ConstantSetting> settled;  ///< Fix blocks
  Composition words;                     ///< that the subject says
};

/// The Fix blocks of `owner`, as Params of the scene.
std::vector<ConstantSetting> fixed_constants(const language::Object& owner);

/// The file that a field of `owner`, a Tune or a Calibrate in `file`, names; empty where it is left
/// out, and after an error.
std::filesystem::path file_beside(const language::Object& owner,
                                  const language::Placed<std::string>& name,
                                  const std::string& file, const language::Library& library,
                                  language::Diagnostics& diagnostics);

/// What `owner`, whose fields are `block`, and its Subject block say of the scene. `subject`: null
/// for none.
SceneSource scene_source(const language::Object& owner, const VariedSceneBlock& block,
                         const language::Object* subject, const Composition& words,
                         const std::string& file, const language::Library& library,
                         language::Diagnostics& diagnostics);

class VariedScene {
 public:
  /// Reads what the files declare; errors at `place` go to `diagnostics`. The library outlives it.
  VariedScene(language::Library& library, SceneSource source, const language::Position& place,
              language::Diagnostics& diagnostics);

  /// Where the name stands: the first of the Params, the Material's fields and the World's. Nothing
  /// if nowhere.
  std::optional<ConstantPlace> place_of(const std::string& name) const;
  /// All names that have a place.
  std::vector<std::string> names() const;
  /// The value that the files themselves give a constant, the terrain's before the scene's, in SI;
  /// nothing where they give none.
  std::optional<double> own_value(const ConstantSetting& constant) const;

  /// What a constant is set by from outside: "stiffness", "world.floor.restitution".
  std::string trail_of(const std::string& name, ConstantPlace place) const;

  /// The files and what is set in them for these constants. Every stream of random numbers, and a
  /// Param `seed` of the scene or the terrain, gets `seed`.
  ScenePlan under(std::span<const ConstantSetting> constants, std::uint64_t seed) const;
  /// Its tree; null after errors. May be called from several threads.
  std::unique_ptr<language::Object> compose(std::span<const ConstantSetting> constants,
                                            std::uint64_t seed,
                                            language::Diagnostics& diagnostics) const;
  /// The experiment of that tree.
  std::optional<LoadedScene> load(std::span<const ConstantSetting> constants, std::uint64_t seed,
                                  language::Diagnostics& diagnostics) const;

  /// The Material of a composed tree that is tuned.
  const language::Object& material_of(const language::Object& tree) const;
  const std::string& material() const { return source_.material; }
  /// What a World may say.
  const language::ClassSchema& world_schema() const;
  const std::filesystem::path& scene_file() const { return source_.scene; }

 private:
  using Names = std::vector<std::string>;

  bool find_material(const language::Object& tree, const language::Position& place,
                     language::Diagnostics& diagnostics);

  language::Library& library_;
  SceneSource source_;
  DeclaredParameters parameters_;
  Names material_fields_, world_fields_;
  std::string world_;                                                    ///< trail of the World
  std::string material_trail_;                                           ///< from the top
  std::vector<language::ParameterValue> terrain_values_, scene_values_;  ///< of Params
  std::unique_ptr<language::Object> own_;                                ///< composed plain
};

}  // namespace hookpoint::studies
