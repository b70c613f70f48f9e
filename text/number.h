// Numbers as text, the same on every machine whatever its locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hookpoint::text {

/// The shortest text that reads back as the same double: 0.1, 1e-09, 3. Non-finite: "nan", "inf",
/// "-inf".
std::string shortest(double value);
/// The same of a value, or `otherwise` where there is none.
std::string shortest(const std::optional<double>& value, std::string_view otherwise = "");

/// 17 significant digits, trailing zeros dropped: 0.10000000000000001. Non-finite as in `shortest`.
std::string seventeen_digits(double value);

/// For readers: `digits` significant digits, scientific outside [1e-4, 1e6): 0.003142, 2.1e-16.
std::string rounded(double value, int digits = 4);
/// The same of a value, or `otherwise` where there is none.
std::string rounded(const std::optional<double>& value, std::string_view otherwise, int digits = 4);

/// Appends shortest(value) to `text` without a temporary; allocates only when `text` must grow.
void append_shortest(std::string& text, double value);

}  // namespace hookpoint::text
