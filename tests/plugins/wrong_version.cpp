// Built for a plugin ABI of another hookpoint.
#include "control/plugin/plugin_abi.h"
#include "tests/plugins/leaves_a_mark.h"

namespace {

constexpr hookpoint::control::PluginAbi other_version() {
  hookpoint::control::PluginAbi abi = hookpoint::control::this_plugin_abi();
  abi.version = 999;
  return abi;
}

}  // namespace

extern "C" {
extern const hookpoint::control::PluginAbi hookpoint_plugin_abi;
constinit const hookpoint::control::PluginAbi hookpoint_plugin_abi = other_version();
}
