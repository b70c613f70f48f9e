// Small helpers for messages that speak about names.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::language {

/// The name of `candidates` nearest to `name` (edit distance at most a third of its length), or ""
/// if none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// "; did you mean `x`?" or "".
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);
bool contains(const std::vector<std::string>& names, std::string_view name);
std::string join(const std::vector<std::string>& words, std::string_view separator);
/// "1 number", "3 numbers".
std::string count_of(std::size_t count, std::string_view noun);

}  // namespace hookpoint::language
