#include "apps/view/session/keep_picture.h"

#include <string>

#include "output/files/file.h"

namespace hookpoint::view {
namespace {

std::filesystem::path free_place(const std::filesystem::path& wanted) {
  std::filesystem::path path = wanted;
  for (int count = 2; std::filesystem::exists(path); ++count)
    path.replace_filename(wanted.stem().string() + "-" + std::to_string(count) +
                          wanted.extension().string());
  return path;
}

}  // namespace

void keep_picture(const PageRequest& request, const KeepPicture& picture,
                  const std::filesystem::path& folder, Audience& audience) {
  std::filesystem::path path;
  try {
    path = free_place(folder / picture.name);
    if (!path.parent_path().empty()) std::filesystem::create_directories(path.parent_path());
    output::write_file(path, picture.png);
  } catch (const std::exception& error) {
    return audience.refuse(request, error.what());
  }
  audience.answer(request, [&](text::JsonWriter& json) { json.member("path", path.string()); });
}

}  // namespace hookpoint::view
