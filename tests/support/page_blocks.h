// The fenced blocks of a page of the manual.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace hookpoint::testing {

/// "```hook leg.hook" has the language `hook` and the name `leg.hook`.
struct PageBlock {
  std::string language, name, text;
};

/// In the page's order.
inline std::vector<PageBlock> blocks_of(const std::string& page) {
  std::vector<PageBlock> blocks;
  std::istringstream lines(page);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (!inside) continue;
      std::istringstream words(line.substr(3));
      PageBlock& block = blocks.emplace_back();
      words >> block.language >> block.name;
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
  }
  return blocks;
}

}  // namespace hookpoint::testing
