// Controllers compiled apart: shared libraries whose classes join the registry. Nothing of a
// library runs before its file has shown how it was built.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "control/plugin/plugin_abi.h"

namespace hookpoint::control {

/// Loads the shared library `file` and registers its classes with its real path as origin; the
/// second time in a process nothing happens but the same answer. "" or what is wrong with it, as a
/// predicate: "is no shared library"; none of its classes is registered then. Whether the file may
/// be loaded at all, the caller decides: its static objects run. `class_problem` says "" or what
/// else is wrong with a class.
/// Source of the order (check, bind everything, run): docs/decisions/0009.
std::string load_plugin(const std::filesystem::path& file,
                        const std::function<std::string(const ComponentClass&)>& class_problem);

/// "" or in what `plugin` differs from this program, as a predicate.
std::string abi_problem(const PluginAbi& plugin);

}  // namespace hookpoint::control
