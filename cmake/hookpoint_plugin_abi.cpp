// Part of every plugin that hookpoint_add_controller builds: says how it was built.
#include "control/plugin/plugin_abi.h"

HOOKPOINT_PLUGIN
