#include "reference/settings.h"

#include <array>
#include <cstdio>

namespace hookpoint::reference {

const std::string& SettingRow::at(Settings settings) const {
  const auto written = [&]() -> const std::string& {
    switch (settings) {
      case Settings::default_:
        return default_;
      case Settings::recommended:
        return recommended;
      case Settings::matched:
        return matched;
      case Settings::own:
        return own.empty() ? recommended : own;
      case Settings::second_own:
        break;
    }
    return second_own.empty() ? recommended : second_own;
  };
  return written() == same_as_default ? default_ : written();
}

std::string setting_text(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%g", value);
  return buffer.data();
}

}  // namespace hookpoint::reference
