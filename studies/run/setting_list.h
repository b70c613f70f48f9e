// What an experiment's printed text states, setting by setting.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hookpoint::studies {

/// Settings in the order of their file: trail and value.
using SettingList = std::vector<std::pair<std::string, std::string>>;

/// The objects and fields of a text that language::print wrote, by trail: {"world.deltat",
/// "0.001 s"}. An object without a name goes by its type; one of several siblings by that name is
/// numbered, `Patch[1]`, or goes by `name (Type)` where their types differ. An object's own entry
/// is its type; a wire's, under its two ends, what it says of rate, delay and noise. Nothing when
/// the text has syntax errors. Cost: linear.
std::optional<SettingList> settings_of_text(std::string text);

}  // namespace hookpoint::studies
