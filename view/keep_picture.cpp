#include "view/keep_picture.h"

#include "output/file.h"

namespace hookpoint::view {

void keep_picture(const Asked& asked, const KeepPicture& picture,
                  const std::filesystem::path& folder, Audience& audience) {
  const std::filesystem::path path = folder / picture.name;
  try {
    if (!path.parent_path().empty()) std::filesystem::create_directories(path.parent_path());
    output::write_file(path, picture.png);
  } catch (const std::exception& error) {
    return audience.refuse(asked, error.what());
  }
  audience.answer(asked, [&](output::JsonWriter& json) { json.member("path", path.string()); });
}

}  // namespace hookpoint::view
