// What may explain an error that is found later at a place of the text.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "language/report.h"

namespace hookpoint::language {

class Hints {
 public:
  /// If an error is found at `position`, `message` at `place` explains it. The first hint at a
  /// position counts.
  void add(const Position& position, const Position& place, const std::string& message) {
    hints_.try_emplace({position.file, position.offset}, place, message);
  }
  /// Adds the hint at `position`, if there is one, to the error that was found there last.
  void explain(const Position& position, Report& report) const {
    const auto found = hints_.find({position.file, position.offset});
    if (found != hints_.end()) report.note(found->second.first, found->second.second);
  }

 private:
  std::map<std::pair<const SourceFile*, std::size_t>, std::pair<Position, std::string>> hints_;
};

}  // namespace hookpoint::language
