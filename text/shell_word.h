// Words of a shell's command.
#pragma once

#include <string>

namespace hookpoint::text {

/// `text` as one word of a shell's command, in quotes whatever is in it.
std::string quoted_shell_word(const std::string& text);

/// The same, in quotes only where the shell would read something else.
std::string shell_word(const std::string& text);

}  // namespace hookpoint::text
