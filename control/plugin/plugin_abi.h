// How a plugin was built, as a constant that the program reads from the file before any code of the
// plugin runs. `hookpoint_add_controller` puts it into every plugin; a build by other means says
// HOOKPOINT_PLUGIN once, at namespace scope.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "control/component.h"
#include "control/registry.h"

namespace hookpoint::control {

/// Raised by every change of an installed header that a compiled plugin would notice
/// (tests/unit/control/plugin_abi_test.cpp holds it to them).
inline constexpr std::uint32_t plugin_abi_version = 6;

/// The first three members stay where they are for good: every version of the program reads them.
struct PluginAbi {
  char magic[16];         ///< plugin_magic
  std::uint32_t size;     ///< of this structure
  std::uint32_t version;  ///< plugin_abi_version
  char library[64];       ///< standard library and its modes, zeros behind it
  char compiler[64];      ///< for messages only: compilers of one C++ ABI may be mixed
  std::uint32_t pointer, string, vector, component, port, component_class, tick;  ///< sizes [byte]
};

inline constexpr std::string_view plugin_magic = "hookpoint plugin";
inline constexpr const char* plugin_symbol = "hookpoint_plugin_abi";

namespace plugin_abi_details {

#define HOOKPOINT_TEXT_OF(x) #x
#define HOOKPOINT_TEXT(x) HOOKPOINT_TEXT_OF(x)
#if defined(_LIBCPP_VERSION)
inline constexpr std::string_view library = "libc++ ABI " HOOKPOINT_TEXT(_LIBCPP_ABI_VERSION);
#elif defined(_GLIBCXX_DEBUG)
inline constexpr std::string_view library = "libstdc++ in debug mode";
#elif defined(_GLIBCXX_USE_CXX11_ABI) && _GLIBCXX_USE_CXX11_ABI
inline constexpr std::string_view library = "libstdc++ with C++11 strings";
#else
inline constexpr std::string_view library = "libstdc++ with strings from before C++11";
#endif
#if defined(__clang__)
inline constexpr std::string_view compiler = "clang " __clang_version__;
#else
inline constexpr std::string_view compiler = "g++ " __VERSION__;
#endif
#undef HOOKPOINT_TEXT
#undef HOOKPOINT_TEXT_OF

template <std::size_t N>
constexpr void fill(char (&field)[N], std::string_view text) {
  for (std::size_t i = 0; i < N; ++i) field[i] = i < text.size() ? text[i] : '\0';
}

}  // namespace plugin_abi_details

/// What this translation unit is built with.
constexpr PluginAbi this_plugin_abi() {
  PluginAbi abi{};
  plugin_abi_details::fill(abi.magic, plugin_magic);
  abi.size = sizeof(PluginAbi);
  abi.version = plugin_abi_version;
  plugin_abi_details::fill(abi.library, plugin_abi_details::library);
  plugin_abi_details::fill(abi.compiler, plugin_abi_details::compiler);
  abi.pointer = sizeof(void*);
  abi.string = sizeof(std::string);
  abi.vector = sizeof(std::vector<double>);
  abi.component = sizeof(Component);
  abi.port = sizeof(PortDescription);
  abi.component_class = sizeof(ComponentClass);
  abi.tick = sizeof(Tick);
  return abi;
}

}  // namespace hookpoint::control

#define HOOKPOINT_PLUGIN                                               \
  extern "C" {                                                         \
  extern const hookpoint::control::PluginAbi hookpoint_plugin_abi      \
      __attribute__((visibility("default")));                          \
  constinit const hookpoint::control::PluginAbi hookpoint_plugin_abi = \
      hookpoint::control::this_plugin_abi();                           \
  }
