// A picture that a page has taken becomes a file.
#pragma once

#include <filesystem>

#include "apps/view/wire/audience.h"

namespace hookpoint::view {

/// Writes it to `folder`, which is made where there is none, and answers with its path or with why
/// there is none. A file that is there already stays: NAME-2.png is free beside NAME.png.
void keep_picture(const PageRequest& request, const KeepPicture& picture,
                  const std::filesystem::path& folder, Audience& audience);

}  // namespace hookpoint::view
