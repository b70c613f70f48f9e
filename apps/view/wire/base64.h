// Base64 (RFC 4648, section 4): bytes as letters.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hookpoint::view {

inline constexpr std::string_view base64_alphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string to_base64(std::string_view bytes);

/// The bytes that `text` stands for; none where it has a letter that is not base64.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace hookpoint::view
