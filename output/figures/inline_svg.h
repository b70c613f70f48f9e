// A drawing made to stand inside an HTML page.
#pragma once

#include <optional>
#include <string>

namespace hookpoint::output {

/// An .svg of `draw` as an element of a page: no prologue, no background, ids that begin with
/// `prefix`, `description` for who cannot see it, and black turned into the page's own text colour,
/// so that it follows a dark page. Nothing when `svg` is no XML. Cost: linear.
std::optional<std::string> inline_svg(const std::string& svg, const std::string& prefix,
                                      const std::string& description);

}  // namespace hookpoint::output
