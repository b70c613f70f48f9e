// The block Engine: an engine that is a program. Blocks stand in files of their own, which are read
// before any other: what `engine =` may name must be known then.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "reference/process/definition.h"

namespace hookpoint::application {

inline constexpr const char* engine_class_name = "Engine";

void add_engine_class(language::Schema& schema);

/// The Engine blocks of a file, not of its Includes, without consent to any. Errors go to `tell` and leave
/// nothing. `known` says whether there is an engine of that name already, which is an error.
std::vector<reference::ProgramDefinition> read_engines(
    const std::filesystem::path& file, const std::vector<std::filesystem::path>& search_path,
    const std::function<bool(const std::string&)>& known,
    const std::function<void(const language::Diagnostics&)>& tell);

/// The files of Engine blocks in the folder `engines` of `folder`, by name.
std::vector<std::filesystem::path> engine_files_in(const std::filesystem::path& folder);

}  // namespace hookpoint::application
