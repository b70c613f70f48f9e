// The promise behind the plugin ABI's number: what a plugin is compiled against is what it was when
// the number was given.
#include "control/plugin/plugin_abi.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "tests/support/folders.h"
#include "tests/support/text.h"

namespace hookpoint::control {
namespace {

std::string read(const std::string& file) {
  return testing::read_file(testing::source_folder() + "/" + file);
}

/// The headers that the package installs, as cmake/hookpoint_install.cmake lists them.
std::set<std::string> installed_headers() {
  const std::string cmake = read("cmake/hookpoint_install.cmake");
  const std::string begin = "set(HOOKPOINT_CONTROLLER_HEADERS";
  const std::size_t at = cmake.find(begin) + begin.size();
  std::istringstream list(cmake.substr(at, cmake.find(')', at) - at));
  std::set<std::string> headers;
  for (std::string header; list >> header;) headers.insert(header);
  return headers;
}

/// FNV-1a of the code without comments and white space. The headers hold no string with `//`.
std::uint64_t fingerprint(const std::set<std::string>& headers) {
  std::uint64_t state = 14695981039346656037ull;
  for (const std::string& header : headers) {
    for (const char c : std::regex_replace(read(header), std::regex("//[^\n]*|\\s"), "")) {
      state ^= static_cast<unsigned char>(c);
      state *= 1099511628211ull;
    }
  }
  return state;
}

TEST(PluginAbi, InstalledHeadersIncludeInstalledHeadersOnly) {
  const std::set<std::string> headers = installed_headers();
  EXPECT_TRUE(headers.contains("control/component.h"));
  const std::regex include("#include \"([^\"]*)\"");
  for (const std::string& header : headers) {
    const std::string text = read(header);
    EXPECT_FALSE(text.empty()) << header;
    for (std::sregex_iterator found(text.begin(), text.end(), include), end; found != end; ++found)
      EXPECT_TRUE(headers.contains((*found)[1])) << header << " includes " << (*found)[1];
  }
}

TEST(PluginAbi, TheNumberBelongsToTheseHeaders) {
  EXPECT_EQ(plugin_abi_version, 6U);
  EXPECT_EQ(fingerprint(installed_headers()), 4358321410758113037U)
      << "an installed header has changed: if a plugin compiled before would notice (a member, a "
         "virtual function, a signature), raise plugin_abi_version in control/plugin/plugin_abi.h; "
         "then "
         "put the new fingerprint here";
}

}  // namespace
}  // namespace hookpoint::control
