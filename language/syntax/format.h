// Canonical layout: two blanks a level, one item a line, short blocks and rows of fields that stood
// on one line stay there.
#pragma once

#include <filesystem>
#include <string>

#include "language/diagnostics.h"

namespace hookpoint::language {

/// Canonical layout of a file's text, comments kept; idempotent. `diagnostics` gets the syntax
/// errors; the text is then returned unchanged.
std::string format(const std::filesystem::path& file, const std::string& text,
                   Diagnostics& diagnostics);

}  // namespace hookpoint::language
