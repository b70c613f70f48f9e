// Text that a test looks into.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "output/files/file.h"

namespace hookpoint::testing {

/// All of a file; "" where there is none.
inline std::string read_file(const std::filesystem::path& path) {
  return output::read_file(path).value_or("");
}

/// Whether `part` stands in `text`.
inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// How often `part` stands in `text`.
inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace hookpoint::testing
