// The most contacts that a library makes of a shape on its ground, or makes fast: where so many are
// reached, the library says nothing.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace hookpoint::reference {

/// What the limit of a library that drops contacts means.
inline constexpr std::string_view drops_the_others =
    "its limit, and drops the others: it may sink or be thrown up";

class ContactLimit {
 public:
  ContactLimit(std::string_view library, std::size_t most,
               std::string_view meaning = drops_the_others)
      : library_(library), most_(most), meaning_(meaning) {}

  /// `count` contacts were made in this step, of `what`: "box.base".
  void check(std::size_t count, std::string_view what) {
    if (count < most_ || reached_) return;
    reached_ = true;
    notice_ = fmt::format(
        "{} found {} contacts of {} with the ground, {}; raise the terrain's spacing, give the "
        "body "
        "ContactPoints, or choose another engine; later cases are not repeated",
        library_, count, what, meaning_);
  }
  /// What is to be said of this step; empty where nothing is.
  std::string take_notice() { return std::exchange(notice_, {}); }

 private:
  std::string_view library_;
  std::size_t most_;
  std::string_view meaning_;
  bool reached_ = false;
  std::string notice_;
};

}  // namespace hookpoint::reference
