// The names of a record's files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::output {

/// The files that a record of that format (output/records/recorder.h) at `file` consists of, itself
/// first.
std::vector<std::string> record_files(std::string_view format, const std::string& file);

/// Beside a CSV record: a line a column, and what belongs to the whole record.
std::filesystem::path csv_channels_file(std::filesystem::path record);
std::filesystem::path csv_about_file(std::filesystem::path record);

}  // namespace hookpoint::output
