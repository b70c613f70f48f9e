#include "language/values/budget.h"

#include <array>
#include <charconv>

namespace hookpoint::language {
namespace {

struct Limit {
  std::size_t most;
  std::string_view noun;
};

/// In the order of Resource.
constexpr std::array<Limit, 3> limits{{{Budget::most_steps, "steps of evaluation"},
                                       {Budget::most_values, "values in lists"},
                                       {Budget::most_objects, "objects and wires"}}};

}  // namespace

bool Budget::take(Resource resource, std::size_t amount, const Position& place, Report& report) {
  if (spent_) return false;
  const auto index = static_cast<std::size_t>(resource);
  const Limit& limit = limits[index];
  if (amount <= limit.most - used_[index]) {
    used_[index] += amount;
    return true;
  }
  spent_ = true;
  report.error(place, "the file requires more than " + std::to_string(limit.most) + " " +
                          std::string(limit.noun));
  return false;
}

std::string too_many(double required, std::size_t most, std::string_view noun) {
  constexpr int digits = 6;
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), required,
                                          std::chars_format::general, digits);
  return std::string(text.data(), end) + " " + std::string(noun) + ", more than the " +
         std::to_string(most) + " allowed";
}

}  // namespace hookpoint::language
