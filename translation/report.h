// Translations as text, as JSON and as the manual's page.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "translation/translate.h"

namespace hookpoint::translation {

/// What `hookpoint translate` answers of one contact.
struct Answer {
  std::string material;  ///< its name
  std::string law;       ///< hookpoint's; "" where constants came from an engine
  std::string robot;     ///< that rests on it; "" where load or mass were given
  Situation at;
  DesiredContact desired;
  std::optional<Behaviour> own;     ///< of the law
  std::optional<Translation> from;  ///< the engine whose parameters were read
  std::vector<Translation> targets;
};

/// For a reader, with line ends.
std::string text_of(std::span<const Answer> answers);
/// An object of one answer, an array of several (docs/translate.md).
std::string json_of(std::span<const Answer> answers);
/// docs/parameters.md: what each parameter of each engine is in N/m, N s/m or m/s.
std::string parameters_page();

}  // namespace hookpoint::translation
