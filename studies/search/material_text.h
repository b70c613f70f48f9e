// A Material with constants that were found, as a file that any scene can Include.
#pragma once

#include <string>

#include "language/document/document.h"

namespace hookpoint::studies {

/// A comment's line, whatever stands in it.
std::string comment_line(const std::string& text);

/// The block of `material` under another name, its numbers to the last bit but for
/// what the factor of a unit adds (20.2421 kN/m is 20242.1 N/m).
std::string material_block(const language::Object& material, const std::string& name);

}  // namespace hookpoint::studies
