#include "output/records/matlab_names.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace hookpoint::output {
namespace {

constexpr std::size_t longest = 63;
constexpr std::array<std::string_view, 20> keywords{
    "break",      "case",   "catch",    "classdef", "continue", "else",      "elseif",
    "end",        "for",    "function", "global",   "if",       "otherwise", "parfor",
    "persistent", "return", "spmd",     "switch",   "try",      "while"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string valid_name(std::string_view path) {
  std::string name;
  for (const char c : path) {
    if (is_letter(c) || is_digit(c)) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  if (name.size() > longest) name.erase(0, name.size() - longest);
  while (!name.empty() && name.front() == '_') name.erase(0, 1);
  if (name.empty() || !is_letter(name.front()) ||
      std::find(keywords.begin(), keywords.end(), name) != keywords.end())
    name = "x_" + name.substr(name.size() + 2 > longest ? 2 : 0);
  return name;
}

}  // namespace

std::vector<std::string> matlab_names(std::span<const std::string> paths,
                                      std::span<const std::string> taken) {
  std::set<std::string> used(taken.begin(), taken.end());
  std::vector<std::string> names;
  for (const std::string& path : paths) {
    const std::string base = valid_name(path);
    std::string name = base;
    for (int i = 2; !used.insert(name).second; ++i) {
      const std::string number = "_" + std::to_string(i);
      name = base.substr(0, longest - number.size()) + number;
    }
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace hookpoint::output
