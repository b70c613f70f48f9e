// The desktop's browser.
#pragma once

#include <string>

namespace hookpoint::cli {

/// Opens `url` where there is a desktop, and returns at once. That there is none, or no browser, is
/// no error: the address has been printed.
void open_browser(const std::string& url);

}  // namespace hookpoint::cli
