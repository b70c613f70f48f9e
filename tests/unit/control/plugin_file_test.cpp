// A plugin's file is read before it is trusted to fit: whatever its bytes, reading is safe.
#include <elf.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "control/plugin/elf_constant.h"
#include "control/plugin/plugin.h"
#include "tests/support/folders.h"
#include "tests/support/text.h"

namespace hookpoint::control {
namespace {

std::string good_library() {
  return testing::read_file(testing::build_folder() + "/tests/plugins/libplugin_good.so");
}

PluginAbi abi_in(const std::string& library) {
  const ElfConstant constant = read_constant(library, plugin_symbol);
  EXPECT_EQ(constant.problem, "");
  PluginAbi abi{};
  EXPECT_EQ(constant.bytes.size(), sizeof abi);
  std::memcpy(&abi, constant.bytes.data(), std::min(sizeof abi, constant.bytes.size()));
  return abi;
}

TEST(PluginFile, SaysHowItWasBuilt) {
  const PluginAbi abi = abi_in(good_library());
  EXPECT_EQ(std::string(abi.magic, sizeof abi.magic), "hookpoint plugin");
  EXPECT_EQ(abi.version, plugin_abi_version);
  EXPECT_EQ(abi.component, sizeof(Component));
  EXPECT_EQ(abi_problem(abi), "");
}

TEST(PluginFile, EveryDifferenceIsSeen) {
  const PluginAbi good = this_plugin_abi();
  EXPECT_EQ(abi_problem(good), "");
  for (auto size : {&PluginAbi::size, &PluginAbi::version, &PluginAbi::pointer, &PluginAbi::string,
                    &PluginAbi::vector, &PluginAbi::component, &PluginAbi::port, &PluginAbi::tick,
                    &PluginAbi::component_class}) {
    PluginAbi other = good;
    other.*size += 8;
    EXPECT_NE(abi_problem(other), "");
  }
  PluginAbi other = good;
  other.magic[0] = 'H';
  EXPECT_NE(abi_problem(other), "");
  other = good;
  other.library[0] = 'L';
  EXPECT_NE(abi_problem(other), "");
  other = good;
  std::memset(other.library, 'x', sizeof other.library);  // no zero to end it
  EXPECT_NE(abi_problem(other), "");
  other = good;
  std::memset(other.compiler, 'x', sizeof other.compiler);
  EXPECT_EQ(abi_problem(other), "") << "compilers of one ABI may be mixed";
}

TEST(PluginFile, CutOffAnywhereItIsReadSafely) {
  const std::string whole = good_library();
  ASSERT_GT(whole.size(), 1000U);
  const std::size_t stride = whole.size() / 300;
  for (std::size_t size = 0; size < whole.size(); size += size < 256 ? 1 : stride) {
    // A copy of its own, so that a sanitizer sees a read behind its end.
    const std::string cut(whole.data(), size);
    const ElfConstant constant = read_constant(cut, plugin_symbol);
    EXPECT_EQ(constant.problem.empty(), !constant.bytes.empty());
  }
}

TEST(PluginFile, DamagedAnywhereItIsReadSafely) {
  const std::string whole = good_library();
  Elf64_Ehdr header;
  std::memcpy(&header, whole.data(), sizeof header);
  std::mt19937_64 random(1);
  int refused = 0;
  for (int trial = 0; trial < 600; ++trial) {
    std::string damaged = whole;
    // Most of the damage where the structure is: the header and the table of sections at the end.
    for (int k = 0; k < 8; ++k) {
      const std::size_t table = header.e_shoff + random() % (whole.size() - header.e_shoff);
      const std::size_t place = random() % 3 == 0 ? random() % 1024 : table;
      damaged[place] = static_cast<char>(random());
    }
    refused += read_constant(damaged, plugin_symbol).problem.empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 60);
}

TEST(PluginFile, AnotherSymbolIsNotFound) {
  EXPECT_NE(read_constant(good_library(), "hookpoint_plugin_ab").problem, "");
  EXPECT_NE(read_constant(good_library(), "").problem, "");
}

}  // namespace
}  // namespace hookpoint::control
