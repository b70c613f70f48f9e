// What a file is evaluated with from outside.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace hookpoint::language {

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
};

}  // namespace hookpoint::language
