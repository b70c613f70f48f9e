#include "control/plugin/plugin.h"

#include <cxxabi.h>
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include "control/plugin/elf_constant.h"

namespace hookpoint::control {
namespace {

/// A field of fixed length as text.
template <std::size_t N>
std::string text_of(const char (&field)[N]) {
  return {field, std::find(field, field + N, '\0')};
}

std::string read(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// "" or why the library must not be bound to this program.
std::string built_otherwise(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) return "is no shared library";
  const ElfConstant constant = read_constant(read(file), plugin_symbol);
  if (!constant.problem.empty()) return constant.problem;
  PluginAbi abi{};
  std::memcpy(&abi, constant.bytes.data(), std::min(sizeof abi, constant.bytes.size()));
  return abi_problem(abi);
}

/// A mangled name as it is written in C++.
std::string readable(const std::string& symbol) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> name(
      abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status), &std::free);
  return status == 0 ? name.get() : symbol;
}

/// What the dynamic linker said, without the path that the user is told anyway.
std::string binding_problem(const std::filesystem::path& file, std::string said) {
  if (const std::string path = file.string() + ": "; said.starts_with(path))
    said.erase(0, path.size());
  const std::string undefined = "undefined symbol: ";
  if (!said.starts_with(undefined)) return "cannot be loaded: " + said;
  const std::string symbol = said.substr(undefined.size(), said.find(' ', undefined.size()));
  return "needs `" + readable(symbol) +
         "`, which this program does not have: link what defines it, or build the plugin with "
         "the headers of this hookpoint";
}

using ClassProblem = std::function<std::string(const ComponentClass&)>;

/// "" or what is wrong with what the library registered.
std::string registration_problem(const std::string& origin, std::size_t problems_before,
                                 const ClassProblem& class_problem) {
  const Registry& registry = Registry::instance();
  if (registry.problems().size() > problems_before)
    return "cannot join the program: " + registry.problems()[problems_before];
  bool any = false;
  for (const auto& [name, type] : registry.classes()) {
    if (type.origin != origin) continue;
    any = true;
    std::string problem = declaration_problem(type);
    if (problem.empty()) problem = class_problem(type);
    if (!problem.empty()) return "cannot join the program: class '" + name + "': " + problem;
  }
  return any ? "" : "registers no class: HOOKPOINT_REGISTER_COMPONENT is missing";
}

std::string load_once(const std::filesystem::path& file, const ClassProblem& class_problem) {
  if (std::string problem = built_otherwise(file); !problem.empty()) return problem;
  Registry& registry = Registry::instance();
  const std::size_t problems_before = registry.problems().size();
  const std::string origin = file.string();
  registry.set_origin(origin);
  // Everything is bound before anything runs: a missing symbol is found here and not in a step. The
  // library stays until the process ends, since its classes do.
  const void* handle = dlopen(origin.c_str(), RTLD_NOW | RTLD_LOCAL);
  registry.set_origin("");
  if (handle == nullptr) return binding_problem(file, dlerror());
  std::string problem = registration_problem(origin, problems_before, class_problem);
  if (!problem.empty()) registry.remove(origin);
  return problem;
}

}  // namespace

std::string abi_problem(const PluginAbi& plugin) {
  constexpr PluginAbi own = this_plugin_abi();
  const std::string again = ": build it again with this hookpoint's package";
  if (std::string_view(plugin.magic, sizeof plugin.magic) != plugin_magic)
    return "has a symbol `" + std::string(plugin_symbol) + "` of another meaning";
  if (plugin.version != own.version || plugin.size != own.size)
    return "was built for plugin ABI " + std::to_string(plugin.version) + ", this program has " +
           std::to_string(own.version) + again;
  if (text_of(plugin.library) != text_of(own.library))
    return "was built with " + text_of(plugin.library) + ", this program with " +
           text_of(own.library) + again;
  const auto sizes = [](const PluginAbi& abi) {
    return std::array{abi.pointer, abi.string, abi.vector,         abi.component,
                      abi.port,    abi.tick,   abi.component_class};
  };
  if (sizes(plugin) != sizes(own))
    return "was built by " + text_of(plugin.compiler) +
           " with other sizes of hookpoint's classes than this program by " +
           text_of(own.compiler) + again;
  return "";
}

std::string load_plugin(const std::filesystem::path& file, const ClassProblem& class_problem) {
  static std::map<std::filesystem::path, std::string> answers;
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(file, error);
  if (error) return "cannot be read: " + error.message();
  const auto [answer, is_new] = answers.try_emplace(real);
  if (is_new) answer->second = load_once(real, class_problem);
  return answer->second;
}

}  // namespace hookpoint::control
