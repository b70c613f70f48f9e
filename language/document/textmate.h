// The words of the language for editors.
#pragma once

#include <string>

#include "language/schema/schema.h"

namespace hookpoint::language {

/// The language's words as a TextMate grammar (JSON), for editors.
std::string describe_textmate(const Schema& schema);

}  // namespace hookpoint::language
