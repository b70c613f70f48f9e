// Words and numbers of messages.
#pragma once

#include <string>
#include <string_view>

namespace hookpoint::language {

/// "a Wire", "an Input": `noun`, a name of the language, behind its article.
std::string with_article(std::string_view noun);
/// At most six significant digits.
std::string rounded_text(double value);

}  // namespace hookpoint::language
