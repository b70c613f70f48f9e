// What every report page shares: escaping, its style sheet, its script.
#pragma once

#include <string>
#include <string_view>

namespace hookpoint::studies {

/// Text as it may stand in an element or a quoted attribute.
std::string html(std::string_view text);

/// From the doctype to where the page's text begins, with its style sheet: light and dark, screen
/// and paper. `title` is the browser's, `more_style` the page's own CSS.
std::string page_start(const std::string& title, std::string_view more_style = {});
/// The end of a page, with the script that sorts its table of class `runs` by a clicked head and
/// filters it by the words and choices of its `filter`, a choice by the rows' data of its name; an
/// element with `data-shows`, an object of such choices, sets them. The page is complete without.
std::string page_end_with_script();

}  // namespace hookpoint::studies
