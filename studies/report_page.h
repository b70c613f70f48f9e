// What every report page shares: escaping, its style sheet, its script.
#pragma once

#include <string>
#include <string_view>

namespace hookpoint::studies {

/// Text as it may stand in an element or a quoted attribute.
std::string html(std::string_view text);

/// Inline CSS: light and dark, screen and paper.
std::string_view report_style();

/// Inline script: filters and sorts the table of runs. The page is complete without it.
std::string_view report_script();

}  // namespace hookpoint::studies
