#pragma once

#include <string>

namespace hookpoint::studies {

/// A Param and the text of its value.
struct Assignment {
  std::string parameter;
  std::string text;
};

}  // namespace hookpoint::studies
