// What a scene has by which names, before any run is planned: the ports that a study measures and
// the constants that its closed forms take.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "language/document/document.h"
#include "language/values/formula.h"
#include "simulation/scene/trails.h"

namespace hookpoint::studies {

/// Whether a name of a formula, or a value's text, is a string in its quotes.
bool is_string(std::string_view text);

/// A port of the scene.
struct ScenePort {
  std::string trail;                             ///< as a run knows it
  std::optional<language::Dimension> dimension;  ///< nothing where its class leaves it open
  std::string missing;  ///< why a run of the experiment has none, where one is given; "": it has
};

/// A number that stands in the scene, or a word as the number of its place among those that were
/// compared.
struct SceneNumber {
  double value = 0.;  ///< SI
  std::optional<language::Dimension> dimension;
};

/// Looks names up in a scene that is created; trails from the top, or from within its World.
class SceneNames {
 public:
  /// `tree` outlives it, and `experiment`, which is of `tree`; without one it is loaded where a
  /// name needs it. `words`: what names hold words, and which.
  explicit SceneNames(const language::Object& tree, std::map<std::string, std::string> words = {},
                      const simulation::Experiment* experiment = nullptr);
  const language::Object& tree() const { return tree_; }
  /// A word that is compared must be one of `words`, one that a name holds, or an object's name;
  /// unless this is called, it may be any.
  void expect_words(std::vector<std::string> words);
  /// Nothing, with `why`, where `trail` is no number of a run. `experiment`: of `tree`; may be
  /// null.
  std::optional<ScenePort> port(const std::string& trail, std::string& why,
                                const simulation::Experiment* experiment = nullptr);
  /// What each name of the formula is. A first name that holds a word stands for it; names that are
  /// compared with one by == or != are words. `wrong`: where it is set, called with the number of a
  /// name that is neither and with why; the name then has no value.
  std::vector<std::optional<SceneNumber>> numbers(
      const language::Formula& formula,
      const std::function<void(std::size_t name, const std::string& why)>& wrong = {});

 private:
  std::optional<language::Target> resolve(const std::string& trail, std::string& why);
  /// A Param of the scene, or a field that holds a number. Nothing, with `why`, for anything else.
  std::optional<SceneNumber> number(const std::string& name, std::string& why);
  /// A constant of a Material that its file does not state, as the run has it.
  std::optional<double> loaded_constant(const language::Target& target);
  /// A name that is compared with a word.
  std::optional<SceneNumber> word(const std::string& name, std::string& why);
  bool holds_word(const std::string& name) const;
  /// The name with the word in the place of a first name that holds one.
  std::string with_word(const std::string& name) const;

  const language::Object& tree_;
  std::map<std::string, std::string> words_;
  const simulation::Experiment* experiment_ = nullptr;
  std::optional<simulation::Experiment> loaded_;
  std::vector<std::string> compared_;                 ///< words
  std::optional<std::vector<std::string>> expected_;  ///< likewise
  const language::Object* world_ = nullptr;
  simulation::ObjectTrails trails_;
  language::Names names_;
};

}  // namespace hookpoint::studies
