// What a file is evaluated with from outside.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hookpoint::language {

class Object;

/// An assignment from outside the file (`--set SimpleWorld.deltat="1 ms"`, a study's subject):
/// `value` is the language's text.
struct Override {
  std::string trail;  ///< from the top of the file, ending in a field:
                      ///< SimpleWorld.simplebot.leg1.link1.angle
  std::string value;
};

struct EvaluateOptions {
  std::map<std::string, std::string>
      parameters;  ///< values of the file's `Param`s, the language's text
  std::vector<Override> overrides;
  /// Called with the whole tree before any override is set, any field checked for being there and
  /// any reference looked up: objects may be put in the place of others (a scene's ground).
  std::function<void(Object& root)> amend{};
};

}  // namespace hookpoint::language
