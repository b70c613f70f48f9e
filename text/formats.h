// Which format a file is in, by its content and then by its name, and what to tell somebody who
// gives a file in a format that is not read there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace hookpoint::text {

/// What a file is read as.
enum class Use : unsigned {
  experiment = 1,  ///< the file of a command or of an Include
  mesh = 2,        ///< of a link of a URDF
  heights = 4,     ///< of a terrain
  series = 8       ///< columns of numbers over time: Data, trajectories, traces
};

/// As many bytes of a file as tell its format.
inline constexpr std::size_t enough_bytes = 8192;

/// The usual ending of the format that a file is in (".urdf"), "" for text of no known format.
/// `content` holds the file's first `enough_bytes`, or all of it.
std::string_view usual_ending(std::string_view content, const std::filesystem::path& name);

/// Why the file cannot be read as `use`, as a sentence without its full stop: which format it is in
/// and what to do. "" when it is in a format that is read there, or in none of the table.
std::string refusal(std::string_view content, const std::filesystem::path& name, Use use);
/// The same of a file on the disk; "" when it cannot be opened.
std::string refusal(const std::filesystem::path& path, Use use);

}  // namespace hookpoint::text
