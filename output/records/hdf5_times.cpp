#include "output/records/hdf5_times.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <fstream>
#include <ios>
#include <string>

#include "output/files/file.h"

namespace hookpoint::output {
namespace {

/// Type, size, flags, reserved; version, reserved. The seconds follow, 4 bytes.
constexpr char header[] = {0x12, 0, 8, 0, 0, 0, 0, 0, 1, 0, 0, 0};
constexpr std::size_t message_size = sizeof header + sizeof(std::uint32_t);
/// A file takes at most this long to be written [s].
constexpr std::uint32_t longest_writing = 24 * 3600;
/// A file of any size is looked through in blocks of this many bytes.
constexpr std::size_t block_size = 1U << 20U;

/// Clears each time in `bytes`; true when there was one.
bool clear_times(std::string& bytes, std::uint32_t now) {
  const std::string wanted(header, sizeof header);
  bool found = false;
  for (std::size_t at = bytes.find(wanted); at != std::string::npos;
       at = bytes.find(wanted, at + 1)) {
    if (at + message_size > bytes.size()) break;
    std::uint32_t seconds = 0;
    std::memcpy(&seconds, bytes.data() + at + sizeof header, sizeof seconds);
    if (now - seconds > longest_writing) continue;
    std::memset(bytes.data() + at + sizeof header, 0, sizeof seconds);
    found = true;
  }
  return found;
}

}  // namespace

void clear_object_times(const std::filesystem::path& file) {
  const auto now = static_cast<std::uint32_t>(std::time(nullptr));
  const std::uintmax_t size = std::filesystem::file_size(file);
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  std::string block;
  // Blocks overlap by a message, so that none is cut in two.
  for (std::uintmax_t start = 0; start < size; start += block_size - message_size) {
    block.resize(static_cast<std::size_t>(std::min<std::uintmax_t>(block_size, size - start)));
    stream.seekg(static_cast<std::streamoff>(start));
    stream.read(block.data(), std::ssize(block));
    if (!clear_times(block, now)) continue;
    stream.seekp(static_cast<std::streamoff>(start));
    stream.write(block.data(), std::ssize(block));
  }
  stream.flush();
  if (!stream) fail_file("write", file);
}

}  // namespace hookpoint::output
