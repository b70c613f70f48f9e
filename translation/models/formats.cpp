#include <algorithm>
#include <array>

#include "translation/models/model.h"

namespace hookpoint::translation {

std::span<const ModelFormat* const> model_formats() {
  static const std::array all{&mjcf_format, &urdf_format, &sdf_format};
  return all;
}

const ModelFormat* find_model_format(std::string_view name) {
  const auto found = std::ranges::find(model_formats(), name, &ModelFormat::name);
  return found == model_formats().end() ? nullptr : *found;
}

}  // namespace hookpoint::translation
